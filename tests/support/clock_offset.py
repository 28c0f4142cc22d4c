"""The clock rule that every client keeps, in its shortest form; `clock_offset.js` of the page is the same in JavaScript."""

from __future__ import annotations

from collections import deque

from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Probes whose bounds hold together.
KEPT = 64


class ClockOffset:
    """Server minus client, in nanoseconds: no message arrives before it was sent, so each probe bounds the offset from both sides."""

    def __init__(self) -> None:
        self._bounds: deque[tuple[int, int]] = deque(maxlen=KEPT)
        self.least_ns = self.most_ns = 0

    def add(self, reply: pb.ClockReply, received_ns: int) -> None:
        """Take one reply, received at this time of the client's clock."""
        least_ns, most_ns = reply.server_send_ns - received_ns, reply.server_receive_ns - reply.client_send_ns
        if least_ns > most_ns:
            return
        self._bounds.append((least_ns, most_ns))
        self.least_ns, self.most_ns = max(least for least, _ in self._bounds), min(most for _, most in self._bounds)
        if self.least_ns > self.most_ns:  # the clocks have drifted or jumped: older bounds hold no more
            self._bounds.clear()
            self._bounds.append((least_ns, most_ns))
            self.least_ns, self.most_ns = least_ns, most_ns

    @property
    def offset_ns(self) -> float:
        """The middle of the bounds."""
        return (self.least_ns + self.most_ns) / 2

    @property
    def uncertainty_ns(self) -> float:
        """The error is at most this."""
        return (self.most_ns - self.least_ns) / 2
