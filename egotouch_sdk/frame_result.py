"""What the pipeline found out about one frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from egotouch_sdk.observation import FingertipPatch, GateResult, HandObservation, TouchEstimate
from egotouch_sdk.touch_event import TouchEvent

#: Names of the timed stages, in the order in which they run.
STAGES = ("hands", "gate", "patches", "touch", "filters", "state")


@dataclass(frozen=True, slots=True)
class FrameResult:
    """Everything seen in one frame, stage by stage.

    `hands` are those seen in this frame; `gate` may also hold a host that is remembered from shortly before (score 0).
    `patches` and `estimates` (as the network gave them) belong together one to one; `filtered` are the estimates after the
    filter, on which `events` are based. `stage_ms` holds the wall-clock milliseconds of each of `STAGES`.
    """

    index: int
    timestamp_ns: int
    hands: tuple[HandObservation, ...]
    gate: GateResult
    patches: tuple[FingertipPatch, ...]
    estimates: tuple[TouchEstimate, ...]
    filtered: tuple[TouchEstimate, ...]
    events: tuple[TouchEvent, ...]
    stage_ms: Mapping[str, float]

    @property
    def total_ms(self) -> float:
        """Milliseconds spent on the frame in all stages."""
        return sum(self.stage_ms.values())
