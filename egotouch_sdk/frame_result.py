"""What the pipeline found out about one frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.observation import Fingertip, GateResult, HandObservation, HostPoint, TouchEstimate
from egotouch_sdk.touch_event import TouchEvent

#: Names of the timed stages, in the order in which they run.
STAGES = ("hands", "gate", "patches", "touch", "events")


@dataclass(frozen=True, slots=True)
class FrameResult:
    """Everything seen in one frame, stage by stage.

    `observation` is what perception found. `filtered` are its estimates after the filter and `points` the fingertips on the host
    limb (None where the host has no usable axis), one for each of its fingertips; on them `events` are based.
    `stage_ms` holds the wall-clock milliseconds of each of `STAGES`, empty when there was no camera frame.
    """

    observation: FrameObservation
    filtered: tuple[TouchEstimate, ...] = ()
    points: tuple[HostPoint | None, ...] = ()
    events: tuple[TouchEvent, ...] = ()
    stage_ms: Mapping[str, float] = field(default_factory=dict)

    @property
    def index(self) -> int:
        """Number of the frame in its source, from 0."""
        return self.observation.index

    @property
    def timestamp_ns(self) -> int:
        """Capture time of the frame."""
        return self.observation.timestamp_ns

    @property
    def hands(self) -> tuple[HandObservation, ...]:
        """The hands seen in this frame."""
        return self.observation.hands

    @property
    def gate(self) -> GateResult:
        """Which hands are near each other, or why none are."""
        return self.observation.gate

    @property
    def fingertips(self) -> tuple[Fingertip, ...]:
        """Fingertips that were looked at; with a camera each one is a `FingertipPatch`."""
        return self.observation.fingertips

    @property
    def estimates(self) -> tuple[TouchEstimate, ...]:
        """What the network said about each of `fingertips`."""
        return self.observation.estimates

    @property
    def total_ms(self) -> float:
        """Milliseconds spent on the frame in all stages."""
        return sum(self.stage_ms.values())
