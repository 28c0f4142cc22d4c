"""How a finger moves in one round: knots joined by minimum-jerk paths, force where the path goes below the skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.linalg import Array, Mask

#: Heights between touches in millimetres: where a round starts and ends, and between two taps.
START_MM, _BETWEEN_MM = (30.0, 40.0), (9.0, 26.0)
#: Peak forces in newtons; the study's range is 0 to 3.5 N with soft and hard told apart at 1 N (EgoTouch, UIST'24).
PEAK_N = {TouchType.TAP: (0.35, 2.2), TouchType.LIGHT_PRESS: (0.25, 1.0), TouchType.HARD_PRESS: (1.2, 3.4), TouchType.DRAG: (0.5, 2.2)}
#: Lowest point of a hover in millimetres, drawn so that each factor of height is equally likely.
HOVER_MM = (1.0, 15.0)
#: Below this force the skin is only brushed; such frames count as not touched, `GRAZE_MM` above it.
LEAST_FORCE_N, GRAZE_MM = 0.02, 0.05
#: Duration of an approach and of lifting off, seconds: 0.1 to 0.2 m/s at the skin, as fingers tapping do (our choice).
_APPROACH_S, _LIFT_S, _AGAIN_S = (0.22, 0.36), (0.15, 0.26), (0.14, 0.22)
#: Presses and drags come down slower than taps by this factor (our choice).
_CAREFUL = 1.3
#: Time at the bottom: of a tap, of a press or drag, of a hover.
_TAP_S, _HOLD_S, _HOVER_S = (0.0, 0.06), (0.30, 0.60), (0.25, 0.60)
#: How far below the skin the path aims for 1 N, in mm per N^(2/3): force then rises in 40 to 100 ms, a range
#: of our choice; how far finger and skin really give way is the tissue's own law.
_YIELD_MM = 5.0
#: Length of half a drag; with drift the finger stays within 15 mm of the contact, where the skin mesh is fine.
_DRAG_HALF_MM = (3.0, 8.0)
_TREMOR_HZ = (7.0, 11.0)


@dataclass(frozen=True, slots=True)
class Act:
    """One thing the finger does: `kind`, from `start_s` (first contact, or the hover's lowest point) to `end_s`, `peak` N or mm."""

    kind: TouchType
    start_s: float
    end_s: float
    peak: float

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields; the unit of `peak` is in its name."""
        unit = "lowest_mm" if self.kind is TouchType.HOVER else "peak_n"
        return {"kind": str(self.kind), "start_s": round(self.start_s, 4), "end_s": round(self.end_s, 4), unit: round(self.peak, 3)}


@dataclass(frozen=True, slots=True)
class _Knot:
    """Where the path rests: below the skin (`depth` 1 = at the peak force), or `height_mm` above it; at `at_mm` sideways."""

    time_s: float
    height_mm: float
    at_mm: tuple[float, float]
    peak_n: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class FingerPath:
    """Samples (T,) of a path: gap in mm (0 while touching), force in newtons, sideways place (T, 2) in mm, `tilt_rad` of the finger."""

    touch: Mask
    hover_mm: Array
    force_n: Array
    at_mm: Array
    tilt_rad: Array


class FingerMotion:
    """One round's motion: smooth, exact at any time from 0 to `seconds`, and a list of its acts.

    The axes sideways are the skin's: along the finger's heading, and across it. Every draw comes from `rng`.
    """

    def __init__(self, rng: np.random.Generator, kind: TouchType, seconds: float) -> None:
        self.kind, self.seconds = kind, seconds
        self._aim = rng.normal(0, 1.2, 2)
        self._swing = rng.normal(0, 6.0, 2)
        self._tilt_rad = float(np.radians(rng.uniform(-2, 8)))
        self._drift_hz, self._drift_phase = rng.uniform(0.3, 1.3, (3, 4)), rng.uniform(0, 2 * np.pi, (3, 4))
        self._drift_mm = rng.uniform(0.05, 0.3, (3, 4))
        self._tremor_hz, self._tremor_phase = rng.uniform(*_TREMOR_HZ), rng.uniform(0, 2 * np.pi)
        self._start_mm = float(rng.uniform(*START_MM))
        self._knots: list[_Knot] = []
        acts: list[Act] = []
        time_s = float(rng.uniform(0.0, 0.10))
        self._rest(0.0, self._start_mm, (0.0, 0.0))
        self._rest(time_s, self._start_mm, (0.0, 0.0))
        first = True
        while first or time_s + _APPROACH_S[0] + 0.12 < seconds:
            time_s, act = self._draw_act(rng, time_s, first)
            acts.append(act)
            first = False
        if time_s < seconds:
            self._rest(time_s + float(rng.uniform(*_LIFT_S)), self._start_mm, self._knots[-1].at_mm)
        self.acts: tuple[Act, ...] = tuple(acts)

    def _rest(self, time_s: float, height_mm: float, at_mm: tuple[float, float], peak_n: float = 0.0) -> None:
        self._knots.append(_Knot(time_s, height_mm, at_mm, peak_n))

    def _draw_act(self, rng: np.random.Generator, time_s: float, first: bool) -> tuple[float, Act]:
        """Add the knots of one act that starts above the skin at `time_s`; returns when it is back above it."""
        down_s = float(rng.uniform(*(_APPROACH_S if first else _AGAIN_S)))
        if self.kind not in (TouchType.TAP, TouchType.HOVER):
            down_s *= _CAREFUL
        near = self._aim + rng.normal(0, 0.6, 2)
        here = (float(near[0]), float(near[1]))
        there = here
        between_mm = float(rng.uniform(*_BETWEEN_MM))
        if self.kind is TouchType.HOVER:
            low_mm = float(np.exp(rng.uniform(*np.log(HOVER_MM))))
            hold_s = float(rng.uniform(*_HOVER_S))
            self._rest(time_s + down_s, low_mm, here)
            self._rest(time_s + down_s + hold_s, low_mm * float(rng.uniform(1.0, 1.15)), here)
            act = Act(self.kind, time_s + down_s, time_s + down_s + hold_s, low_mm)
        else:
            peak_n = float(rng.uniform(*PEAK_N[self.kind]))
            depth_mm = _YIELD_MM * peak_n ** (2 / 3)
            hold_s = float(rng.uniform(*(_TAP_S if self.kind is TouchType.TAP else _HOLD_S)))
            if self.kind is TouchType.DRAG:
                angle, half = rng.uniform(0, 2 * np.pi), rng.uniform(*_DRAG_HALF_MM)
                step = half * np.array([np.cos(angle), np.sin(angle)])
                here, there = (float((near - step)[0]), float((near - step)[1])), (float((near + step)[0]), float((near + step)[1]))
            self._rest(time_s + down_s, -depth_mm, here, peak_n)
            self._rest(time_s + down_s + hold_s, -depth_mm * float(rng.uniform(0.94, 1.0)), there, peak_n)
            act = Act(self.kind, time_s + down_s, time_s + down_s + hold_s, peak_n)
        back_s = time_s + down_s + hold_s + float(rng.uniform(*_LIFT_S))
        self._rest(back_s, between_mm, there)
        return back_s, act

    def at(self, time_s: npt.ArrayLike) -> FingerPath:
        """The path at times (T,) in seconds."""
        t = np.atleast_1d(np.asarray(time_s, np.float64))
        signed_mm, at_mm, peak_n, depth_mm = self._along_knots(t)
        below = np.clip(-signed_mm / np.maximum(depth_mm, 1e-9), 0.0, 1.0)
        tremor = 1 + 0.04 * np.sin(2 * np.pi * self._tremor_hz * t + self._tremor_phase)
        force_n = np.clip(peak_n * below**1.5 * tremor, 0.0, 3.5)
        touch = force_n >= LEAST_FORCE_N
        least_mm = HOVER_MM[0] if self.kind is TouchType.HOVER else GRAZE_MM
        drift = (self._drift_mm[..., None] * np.sin(2 * np.pi * self._drift_hz[..., None] * t + self._drift_phase[..., None])).sum(1)
        height_mm = np.maximum(signed_mm + 0.4 * drift[2] * np.clip(signed_mm / 3, 0, 1), least_mm)
        raised = np.clip(signed_mm, 0.0, None) / self._start_mm
        held = 1 - 0.65 * np.clip(1 - signed_mm / 5, 0.0, 1.0)
        at_mm = at_mm + drift[:2].T * held[:, None] + raised[:, None] * self._swing
        return FingerPath(
            touch=touch,
            hover_mm=np.where(touch, 0.0, height_mm),
            force_n=np.where(touch, force_n, 0.0),
            at_mm=at_mm,
            tilt_rad=self._tilt_rad * raised,
        )

    def _along_knots(self, t: Array) -> tuple[Array, Array, Array, Array]:
        """Signed height, sideways place, and the peak force and depth of the touch that is nearest, at times (T,)."""
        times = np.array([k.time_s for k in self._knots])
        heights = np.array([k.height_mm for k in self._knots])
        places = np.array([k.at_mm for k in self._knots])
        peaks = np.array([k.peak_n for k in self._knots])
        after = np.clip(np.searchsorted(times, t, side="right"), 1, len(times) - 1)
        before = after - 1
        share = minimum_jerk((t - times[before]) / np.maximum(times[after] - times[before], 1e-9))
        signed = heights[before] + (heights[after] - heights[before]) * share
        at = places[before] + (places[after] - places[before]) * share[:, None]
        deeper = np.where(heights[before] < heights[after], before, after)
        return signed, at, peaks[deeper], np.where(heights[deeper] < 0, -heights[deeper], 1.0)


def minimum_jerk(x: npt.ArrayLike) -> Array:
    """Minimum-jerk step from 0 to 1 (Flash and Hogan 1985), elementwise; beyond 0..1 it stays."""
    x = np.clip(np.asarray(x, np.float64), 0.0, 1.0)
    return np.asarray(x**3 * (10 - 15 * x + 6 * x * x), np.float64)


def contact_spans(touch: Sequence[bool] | Mask) -> list[tuple[int, int]]:
    """First frame and frame after the last of every touch in a round."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], np.asarray(touch, np.int8), [0]])))
    return [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
