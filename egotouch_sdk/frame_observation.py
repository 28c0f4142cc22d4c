"""What perception found in one frame: all that the event engine needs, and nothing that shows a picture."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.errors import FrameError
from egotouch_sdk.frame import MIN_SIDE_PX
from egotouch_sdk.observation import Fingertip, GateReason, GateResult, HandObservation, TouchEstimate

CLOSED = GateResult(GateReason.NO_HANDS)


@dataclass(frozen=True, slots=True)
class FrameObservation:
    """One frame below the recogniser, as a camera's pipeline, a recording or the simulator gives it.

    `hands` are those seen in this frame; `gate` may also hold a host that is remembered from shortly before (score 0).
    `fingertips` and `estimates` (as the network gave them) belong together one to one.
    Raises `FrameError` when they do not, for a negative time or an image under 32 px a side.
    """

    index: int
    timestamp_ns: int
    width_px: int
    height_px: int
    hands: tuple[HandObservation, ...] = ()
    gate: GateResult = CLOSED
    fingertips: tuple[Fingertip, ...] = ()
    estimates: tuple[TouchEstimate, ...] = ()

    def __post_init__(self) -> None:
        if self.timestamp_ns < 0 or self.index < 0:
            raise FrameError(f"observation has timestamp_ns={self.timestamp_ns}, index={self.index}; both must be >= 0")
        if min(self.width_px, self.height_px) < MIN_SIDE_PX:
            raise FrameError(f"observation is of a {self.width_px}x{self.height_px} px image, need at least {MIN_SIDE_PX} px a side")
        tips = [(tip.hand_id, tip.finger) for tip in self.fingertips]
        if tips != [(estimate.hand_id, estimate.finger) for estimate in self.estimates]:
            raise FrameError(f"{len(self.fingertips)} fingertips and {len(self.estimates)} estimates do not belong together")
