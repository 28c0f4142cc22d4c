"""One act of one finger in time: where it is, how high, and how hard it presses."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import Final

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.simulator.acts import FingerAct, Fling, Hover
from egotouch_sdk.simulator.motion import Point, along, minimum_jerk, speeding_up
from egotouch_sdk.simulator.scene import PALM_SIDE
from egotouch_sdk.simulator.script import Script
from egotouch_sdk.surface import Surface

# All of these are our choice.
#: Height of a finger that is not busy, the time to lift it there, and the time to press to the full force.
REST_MM: Final = 15.0
LIFT_MS: Final = 80.0
RAMP_MS: Final = 60.0
#: Share of the full force with which a touch begins and ends.
FIRST_FORCE: Final = 0.2


@dataclass(frozen=True, slots=True)
class Stroke:
    """One act of one finger with its time, every default filled in."""

    act: FingerAct
    number: int
    start_ms: float
    hand: Handedness
    finger: Finger
    surface: Surface
    force_n: float
    pitch_rad: float
    yaw_rad: float

    @property
    def end_ms(self) -> float:
        """When the act is over."""
        return self.start_ms + self.act.total_ms

    @property
    def palm_side(self) -> bool:
        """True when the limb shows its palm's side."""
        return self.surface in PALM_SIDE

    @property
    def edge_mm(self) -> float:
        """Height of the finger at the act's beginning and end."""
        return self.act.height_mm if isinstance(self.act, Hover) else 0.0

    def place(self, time_ms: float) -> Point:
        """Where the finger is; a flung one goes on while it lifts."""
        share = (time_ms - self.start_ms) / self.act.total_ms
        if not isinstance(self.act, Fling):
            return along(self.act.path, minimum_jerk(share))
        lifted = min(max(time_ms - self.end_ms, 0.0) / LIFT_MS, 1.0)
        # A minimum-jerk movement is 1.875 times as fast in its middle as on average; the rest fades out linearly.
        glide = 1.875 * (lifted - lifted**2 / 2.0) * LIFT_MS / self.act.total_ms
        return along(self.act.path, speeding_up(share) + glide)

    def height_mm(self, time_ms: float) -> float:
        """How high the finger is over the skin, if there were no other act."""
        if time_ms < self.start_ms or time_ms >= self.end_ms:
            away_ms = max(self.start_ms - time_ms, time_ms - self.end_ms)
            return self.edge_mm + (REST_MM - self.edge_mm) * minimum_jerk(away_ms / LIFT_MS)
        spans = self._spans()
        if not spans:
            return self.edge_mm
        if any(start <= time_ms < end for start, end in spans):
            return 0.0
        away_ms = min(max(start - time_ms, time_ms - end) for start, end in spans)
        return REST_MM * minimum_jerk(away_ms / LIFT_MS)

    def pressed_n(self, time_ms: float) -> float:
        """The force on the skin: it rises after a touch begins and falls before it ends."""
        edge_ms = max((min(time_ms - start, end - time_ms) for start, end in self._spans()), default=0.0)
        return self.force_n * (FIRST_FORCE + (1.0 - FIRST_FORCE) * minimum_jerk(edge_ms / RAMP_MS))

    def _spans(self) -> list[tuple[float, float]]:
        return [(self.start_ms + start, self.start_ms + end) for start, end in self.act.contacts_ms]


def stroke_of(script: Script, act: FingerAct, number: int, start_ms: float) -> Stroke:
    """An act at its time, with the script's values where it has none of its own."""
    return Stroke(
        act=act,
        number=number,
        start_ms=start_ms,
        hand=act.hand or script.hand,
        finger=act.finger or script.finger,
        surface=act.surface or script.surface,
        force_n=script.force_n if act.force_n is None else act.force_n,
        pitch_rad=radians(script.pitch_deg if act.pitch_deg is None else act.pitch_deg),
        yaw_rad=radians(script.yaw_deg if act.yaw_deg is None else act.yaw_deg),
    )
