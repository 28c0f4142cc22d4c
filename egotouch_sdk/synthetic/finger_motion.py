"""How a finger moves in one round: knots joined by minimum-jerk paths, force where the path goes below the skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.linalg import Array, Mask

#: Below this force the skin is only brushed; such frames count as not touched, `GRAZE_MM` above it.
LEAST_FORCE_N, GRAZE_MM = 0.02, 0.05
#: How far below the skin the path aims for 1 N, in mm per N^(2/3): force then rises in 40 to 100 ms, a range
#: of our choice; how far finger and skin really give way is the tissue's own law.
_YIELD_MM = 5.0
#: Length of half a drag; with drift the finger stays within 15 mm of the contact, where the skin mesh is fine.
_DRAG_HALF_MM = (3.0, 8.0)
_TREMOR_HZ = (7.0, 11.0)
#: Time that the next act needs at least, after its approach.
_LEAST_ACT_S = 0.12

Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Pace:
    """How people move in a round: durations in seconds, heights in millimetres, forces in newtons, each a range to draw from.

    The defaults are the study's. Peak forces lie in its 0 to 3.5 N with soft and hard told apart at 1 N (EgoTouch, UIST'24). Holds make
    touches 22 frames long in the mean; the paper's were 45 (125,656 touched frames between 5,566 edges). Fingers come down at 0.1 to
    0.2 m/s as in tapping, presses slower by `careful` (our choice). `hover_mm` is a hover's lowest point, each factor of height equally
    likely; `between_mm` the height between two touches, `start_mm` where a round begins. `hover_slides` is the share of hovers that
    move sideways like a drag.
    """

    approach_s: Range = (0.22, 0.36)
    again_s: Range = (0.16, 0.26)
    lift_s: Range = (0.15, 0.26)
    careful: float = 1.3
    wait_s: Range = (0.15, 0.5)
    tap_s: Range = (0.03, 0.25)
    hold_s: Range = (1.2, 1.9)
    hover_s: Range = (0.8, 1.6)
    start_mm: Range = (30.0, 40.0)
    between_mm: Range = (9.0, 26.0)
    hover_mm: Range = (1.0, 15.0)
    hover_slides: float = 0.0
    tap_n: Range = (0.35, 2.2)
    light_press_n: Range = (0.25, 1.0)
    hard_press_n: Range = (1.2, 3.4)
    drag_n: Range = (0.5, 2.2)

    def peak_n(self, kind: TouchType) -> Range:
        """Range of the peak force of an act that touches."""
        peaks = {
            TouchType.TAP: self.tap_n,
            TouchType.LIGHT_PRESS: self.light_press_n,
            TouchType.HARD_PRESS: self.hard_press_n,
            TouchType.DRAG: self.drag_n,
        }
        return peaks[kind]


STUDY_PACE = Pace()
#: Training sees slower and faster fingers, lighter and shorter touches, and hovers that move like drags.
TRAINING_PACE = Pace(
    approach_s=(0.15, 0.7),
    again_s=(0.12, 0.4),
    lift_s=(0.12, 0.5),
    careful=1.2,
    wait_s=(0.0, 0.4),
    tap_s=(0.0, 0.3),
    hold_s=(0.2, 1.4),
    hover_s=(0.1, 1.4),
    between_mm=(4.0, 30.0),
    hover_slides=0.35,
    tap_n=(0.25, 2.6),
    light_press_n=(0.2, 1.1),
    hard_press_n=(1.0, 3.5),
    drag_n=(0.3, 2.6),
)


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

    def __init__(self, rng: np.random.Generator, kind: TouchType, seconds: float, pace: Pace = STUDY_PACE) -> None:
        self.kind, self.seconds, self._pace = kind, seconds, pace
        self._aim = rng.normal(0, 1.2, 2)
        self._swing = rng.normal(0, 6.0, 2)
        self._tilt_rad = float(np.radians(rng.uniform(-2, 8)))
        self._drift_hz, self._drift_phase = rng.uniform(0.3, 1.3, (3, 4)), rng.uniform(0, 2 * np.pi, (3, 4))
        self._drift_mm = rng.uniform(0.05, 0.3, (3, 4))
        self._tremor_hz, self._tremor_phase = rng.uniform(*_TREMOR_HZ), rng.uniform(0, 2 * np.pi)
        self._start_mm = float(rng.uniform(*pace.start_mm))
        self._knots: list[_Knot] = []
        acts: list[Act] = []
        time_s = float(rng.uniform(0.0, 0.10))
        self._rest(0.0, self._start_mm, (0.0, 0.0))
        self._rest(time_s, self._start_mm, (0.0, 0.0))
        first = True
        while first or time_s + pace.again_s[0] + _LEAST_ACT_S < seconds:
            time_s, act = self._draw_act(rng, time_s, first)
            acts.append(act)
            first = False
        if time_s < seconds:
            self._rest(time_s + float(rng.uniform(*pace.lift_s)), self._start_mm, self._knots[-1].at_mm)
        self.acts: tuple[Act, ...] = tuple(acts)

    def _rest(self, time_s: float, height_mm: float, at_mm: tuple[float, float], peak_n: float = 0.0) -> None:
        self._knots.append(_Knot(time_s, height_mm, at_mm, peak_n))

    def _draw_act(self, rng: np.random.Generator, time_s: float, first: bool) -> tuple[float, Act]:
        """Add the knots of one act that starts above the skin at `time_s`; returns when the next one may start."""
        pace = self._pace
        down_s = float(rng.uniform(*(pace.approach_s if first else pace.again_s)))
        if self.kind not in (TouchType.TAP, TouchType.HOVER):
            down_s *= pace.careful
        near = self._aim + rng.normal(0, 0.6, 2)
        slides = self.kind is TouchType.DRAG or (self.kind is TouchType.HOVER and rng.random() < pace.hover_slides)
        angle, half = rng.uniform(0, 2 * np.pi), rng.uniform(*_DRAG_HALF_MM) * slides
        step = half * np.array([np.cos(angle), np.sin(angle)])
        (x0, y0), (x1, y1) = (near - step).tolist(), (near + step).tolist()
        here, there = (x0, y0), (x1, y1)
        if self.kind is TouchType.HOVER:
            peak = float(np.exp(rng.uniform(*np.log(pace.hover_mm))))
            hold_s = float(rng.uniform(*pace.hover_s))
            self._rest(time_s + down_s, peak, here)
            self._rest(time_s + down_s + hold_s, peak * float(rng.uniform(1.0, 1.15)), there)
        else:
            peak = float(rng.uniform(*pace.peak_n(self.kind)))
            depth_mm = _YIELD_MM * peak ** (2 / 3)
            hold_s = float(rng.uniform(*(pace.tap_s if self.kind is TouchType.TAP else pace.hold_s)))
            self._rest(time_s + down_s, -depth_mm, here, peak)
            self._rest(time_s + down_s + hold_s, -depth_mm * float(rng.uniform(0.94, 1.0)), there, peak)
        act = Act(self.kind, time_s + down_s, time_s + down_s + hold_s, peak)
        back_s = act.end_s + float(rng.uniform(*pace.lift_s))
        between_mm = float(rng.uniform(*pace.between_mm))
        self._rest(back_s, between_mm, there)
        again_s = back_s + float(rng.uniform(*pace.wait_s))
        self._rest(again_s, between_mm, there)
        return again_s, act

    def at(self, time_s: npt.ArrayLike) -> FingerPath:
        """The path at times (T,) in seconds."""
        t = np.atleast_1d(np.asarray(time_s, np.float64))
        signed_mm, at_mm, peak_n, depth_mm = self._along_knots(t)
        below = np.clip(-signed_mm / np.maximum(depth_mm, 1e-9), 0.0, 1.0)
        tremor = 1 + 0.04 * np.sin(2 * np.pi * self._tremor_hz * t + self._tremor_phase)
        force_n = np.clip(peak_n * below**1.5 * tremor, 0.0, 3.5)
        touch = force_n >= LEAST_FORCE_N
        least_mm = self._pace.hover_mm[0] if self.kind is TouchType.HOVER else GRAZE_MM
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
