"""What the finger does in a clip: acts in order, turned into place, height and force at any time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import Finger

Kind = Literal["tap", "press", "drag", "hover"]
#: Height between acts in millimetres, and the time to come down, to rise, and between (seconds; measured taps take 0.2-0.4 s).
_CRUISE_MM, _DOWN_S, _UP_S, _TRAVEL_S = 24.0, 0.30, 0.24, 0.26
_RAMP_S = 0.12
#: Frame rate of clips.
FPS = 30


@dataclass(frozen=True, slots=True)
class Act:
    """One thing the finger does at `at_mm` (x thumbwards, z elbowwards, from the wrist); `peak` in newtons, in mm for a hover."""

    kind: Kind
    at_mm: tuple[float, float]
    duration_s: float
    peak: float
    to_mm: tuple[float, float] | None = None

    @property
    def is_touch(self) -> bool:
        """True unless the finger only hovers."""
        return self.kind != "hover"


@dataclass(frozen=True, slots=True)
class Shot:
    """One take with fixed people, place, camera and light; angles in degrees, lengths in metres, light weights for key, windows, room."""

    place: str
    finger: Finger
    participant: int
    acts: tuple[Act, ...]
    arm_azimuth_deg: float
    heading_deg: float
    pitch_deg: float
    roll_deg: float
    tilt_deg: tuple[float, float]
    distance_m: float
    centre_m: tuple[float, float]
    light_weights: tuple[float, float, float]
    light_colours: tuple[tuple[float, float, float], ...]
    backdrop_srgb: tuple[int, int, int]
    stiffness_mm: float
    skin_share: float
    seed: int

    @property
    def duration_s(self) -> float:
        """Length of the take."""
        return self._start_s(len(self.acts)) + 0.1

    @property
    def frames(self) -> int:
        """Number of frames at 30 per second."""
        return int(np.ceil(self.duration_s * FPS))

    @property
    def light_gains(self) -> npt.NDArray[np.float64]:
        """RGB gain of the key, windows and room layers, (3, 3)."""
        return np.array(self.light_colours) * np.array(self.light_weights)[:, None]

    def _start_s(self, index: int) -> float:
        return 0.15 + sum(_TRAVEL_S + _DOWN_S + a.duration_s + _UP_S for a in self.acts[:index])


@dataclass(frozen=True, slots=True)
class Moment:
    """The finger at one time: skin position (mm), height (mm, 0 when touching), force (N) and the act it belongs to."""

    at_mm: tuple[float, float]
    hover_mm: float
    force_n: float
    act: int


def _ease(x: float) -> float:
    """Minimum-jerk step (Flash and Hogan 1985)."""
    x = min(max(x, 0.0), 1.0)
    return x * x * x * (10 - 15 * x + 6 * x * x)


def _force(act: Act, since_s: float) -> float:
    if act.kind == "tap":
        return act.peak * float(np.sin(np.pi * since_s / act.duration_s)) ** 1.2
    hold = min(_ease(since_s / _RAMP_S), _ease((act.duration_s - since_s) / _RAMP_S))
    return act.peak * hold * (1 + 0.06 * float(np.sin(9 * since_s)))


def _end_mm(act: Act) -> tuple[float, float]:
    return act.to_mm or act.at_mm


def moment(shot: Shot, time_s: float) -> Moment:
    """Where the finger is at `time_s`, 0 .. `shot.duration_s`."""
    index = max(i for i in range(len(shot.acts)) if i == 0 or shot._start_s(i) <= time_s)
    act = shot.acts[index]
    before = _end_mm(shot.acts[index - 1]) if index else act.at_mm
    low = 0.0 if act.is_touch else act.peak
    t = time_s - shot._start_s(index)
    travel = _ease((t + 0.06) / (_TRAVEL_S + 0.5 * _DOWN_S))
    here = np.array(before) * (1 - travel) + np.array(act.at_mm) * travel
    contact_at, lift_at = _TRAVEL_S + _DOWN_S, _TRAVEL_S + _DOWN_S + act.duration_s
    force = 0.0
    if t < contact_at:
        height = low + (_CRUISE_MM - low) * (1 - _ease((t - _TRAVEL_S) / _DOWN_S))
    elif t <= lift_at:
        height = low + (0.0 if act.is_touch else 0.25 * float(np.sin(7 * t)))
        force = max(_force(act, t - contact_at), 0.0) if act.is_touch else 0.0
        if act.to_mm:
            slide = _ease((t - contact_at - _RAMP_S) / (act.duration_s - 2 * _RAMP_S))
            here = np.array(act.at_mm) * (1 - slide) + np.array(act.to_mm) * slide
    else:
        height = low + (_CRUISE_MM - low) * _ease((t - lift_at) / _UP_S)
        here = np.array(_end_mm(act))
    if act.is_touch and height < 0.05 and force <= 0.02:
        height = 0.3
    return Moment((float(here[0]), float(here[1])), 0.0 if force > 0.02 else float(max(height, 0.3)), force if force > 0.02 else 0.0, index)
