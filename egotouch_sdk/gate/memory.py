"""A short memory for the host hand, which the touching hand often hides from the tracker."""

from __future__ import annotations

from dataclasses import replace

from egotouch_sdk.observation import GateResult, HandObservation

#: Hands below this score were not seen but carried on (the tracker's presence threshold).
SEEN_SCORE = 0.5


class HostMemory:
    """Adds the last seen host to a frame in which only the touching hand was found.

    `hold_ns` is how long a host is taken to stay where it was. Only the host of an open gate is remembered, only while its
    own touching hand is in view, and never beside another hand of the same side. Holds no more than one hand.
    """

    def __init__(self, hold_ns: int) -> None:
        self._hold_ns = hold_ns
        self._host: HandObservation | None = None
        self._touching_id = -1
        self._seen_ns = 0

    def complete(self, hands: tuple[HandObservation, ...], timestamp_ns: int) -> tuple[HandObservation, ...]:
        """`hands` as they are, or with the remembered host appended at score 0."""
        host = self._host
        if host is None:
            return hands
        if timestamp_ns - self._seen_ns > self._hold_ns:
            self.reset()
            return hands
        hidden = all(hand.handedness is not host.handedness and hand.hand_id != host.hand_id for hand in hands)
        if hidden and any(hand.hand_id == self._touching_id for hand in hands):
            return (*hands, replace(host, score=0.0))
        return hands

    def note(self, result: GateResult, timestamp_ns: int) -> None:
        """Remember the host of an open gate, if it was seen in this very frame."""
        for pair in result.pairs:
            if pair.host.score >= SEEN_SCORE:
                self._host, self._touching_id, self._seen_ns = pair.host, pair.touching.hand_id, timestamp_ns

    def reset(self) -> None:
        """Forget the host."""
        self._host = None
