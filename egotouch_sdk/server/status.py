"""What clients that ask are told about the source once a second, and the landmarks for the debug view."""

from __future__ import annotations

from collections import deque

from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.observation import GateReason
from egotouch_sdk.server.limits import MILLISECOND_NS, SECOND_NS
from egotouch_sdk.wire import enums
from egotouch_sdk.wire.codec import hand_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Frames over which latency is looked at: three seconds at 90 Hz.
WINDOW = 270


class StatusBoard:
    """Frame rate, latency and what the camera sees, from the frames it is told of."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._hands = 0
        self._gate = GateReason.NO_HANDS
        self._latencies_ms: deque[float] = deque(maxlen=WINDOW)
        self._frames_since = 0
        self._since_ns = 0

    def note(self, result: FrameResult, now_ns: int) -> None:
        """Note one frame, worked through at `now_ns`."""
        self._frames_since += 1
        self._hands = len(result.hands)
        self._gate = result.gate.reason
        self._latencies_ms.append((now_ns - result.timestamp_ns) / MILLISECOND_NS)

    def report(self, now_ns: int) -> pb.Status:
        """The state at `now_ns`; the frame rate is that since the last report."""
        elapsed_ns, self._since_ns = now_ns - self._since_ns, now_ns
        frames, self._frames_since = self._frames_since, 0
        ordered = sorted(self._latencies_ms)
        return pb.Status(
            fps=frames * SECOND_NS / elapsed_ns if elapsed_ns > 0 else 0.0,
            capture_to_send_p50_ms=_share(ordered, 0.5),
            capture_to_send_p95_ms=_share(ordered, 0.95),
            hands_in_view=self._hands,
            gate=enums.GATE_REASONS.number(self._gate),
            source=self._source,
        )


def hands_view(result: FrameResult) -> pb.HandsView:
    """The landmarks of one frame."""
    return pb.HandsView(
        timestamp_ns=result.timestamp_ns,
        width_px=result.observation.width_px,
        height_px=result.observation.height_px,
        hands=[hand_to_proto(hand) for hand in result.hands],
    )


def _share(ordered: list[float], share: float) -> float:
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else 0.0
