"""From the acts of a script to the scene at any time."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Final

import numpy as np

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.joints import FINGERS, Finger, Handedness
from egotouch_sdk.simulator.acts import Act, FingerAct, Stall, Swap, Vanish
from egotouch_sdk.simulator.motion import Point, minimum_jerk
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedScene
from egotouch_sdk.simulator.script import Script
from egotouch_sdk.simulator.stroke import Stroke, stroke_of
from egotouch_sdk.surface import surface_at

# All of these are our choice.
#: Acts follow one another at this distance: more than a double tap's 300 ms, so that two taps are two.
GAP_MS: Final = 400.0
#: A finger comes into view this long before its first act and stays as long after its last.
APPEAR_MS: Final = 250.0
#: Between two acts a finger stays in view for up to this long.
LINGER_MS: Final = 1500.0


class Timeline:
    """The scene of a script at any time, in milliseconds from its start. Raises `ConfigError` for acts that contradict each other."""

    def __init__(self, script: Script, name: str) -> None:
        self._script = script
        self._strokes: dict[tuple[Handedness, Finger], list[Stroke]] = {}
        self._vanished_ms: list[tuple[float, float]] = []
        self._stalled_ms: list[tuple[float, float]] = []
        self._swaps_ms: list[float] = []
        self._schedule(name)
        self._check(name)

    def scene(self, time_ms: float, index: int = 0) -> SimulatedScene | None:
        """What is seen at this time in picture number `index` (it seeds the noise); None while the camera stalls."""
        if self.is_stalled(time_ms):
            return None
        generation = sum(at_ms <= time_ms for at_ms in self._swaps_ms)
        if _within(time_ms, self._vanished_ms):
            return SimulatedScene(hosts=(), generation=generation)
        present = [
            stroke for strokes in self._strokes.values() if (stroke := _nearest(strokes, time_ms)) and self._is_seen(stroke, time_ms)
        ]
        sides = {hand: _nearest([s for s in self._all() if s.hand is hand], time_ms) for hand in Handedness}
        fingers = tuple(
            self._finger(stroke, time_ms, index)
            for stroke in present
            if (side := sides[stroke.hand]) and side.palm_side == stroke.palm_side
        )
        nearest = _nearest(self._all(), time_ms)
        host = (nearest.hand if nearest else self._script.hand).other
        return SimulatedScene(fingers, hosts=(host,), palm_side=nearest.palm_side if nearest else True, generation=generation)

    def is_stalled(self, time_ms: float) -> bool:
        """True while the camera gives no pictures."""
        return _within(time_ms, self._stalled_ms)

    def _schedule(self, name: str) -> None:
        leader_ms = end_ms = 0.0
        for number, act in enumerate(self._script.acts, 1):
            if act.with_ms is None:
                leader_ms = end_ms + (GAP_MS if act.after_ms is None else act.after_ms)
            start_ms = leader_ms + (act.with_ms or 0.0)
            end_ms = max(end_ms, start_ms + act.total_ms)
            self._add(act, number, start_ms, name)
        self.duration_ms = end_ms + GAP_MS

    def _add(self, act: Act, number: int, start_ms: float, name: str) -> None:
        if isinstance(act, FingerAct):
            stroke = stroke_of(self._script, act, number, start_ms)
            if surface_at(act.at[1], palm_side=stroke.palm_side) is not stroke.surface:
                raise ConfigError(
                    f"{name}: act {number} ({act.word}): at = {list(act.at)} is not on the {stroke.surface}",
                    hint="The hand has y_mm >= 0, the forearm y_mm < 0",
                )
            self._strokes.setdefault((stroke.hand, stroke.finger), []).append(stroke)
        elif isinstance(act, Stall):
            self._stalled_ms.append((start_ms, start_ms + act.total_ms))
        elif isinstance(act, Vanish):
            self._vanished_ms.append((start_ms, start_ms + act.total_ms))
        elif isinstance(act, Swap):
            self._swaps_ms.append(start_ms)

    def _check(self, name: str) -> None:
        for strokes in self._strokes.values():
            strokes.sort(key=lambda stroke: stroke.start_ms)
            for a, b in pairwise(strokes):
                if b.start_ms <= a.end_ms:
                    raise ConfigError(
                        f"{name}: act {b.number} ({b.act.word}) begins before act {a.number} of the same {b.hand} {b.finger} has ended",
                        hint="Use another finger or a longer after_ms",
                    )
        for a, b in pairwise(sorted(self._all(), key=lambda stroke: (stroke.hand, stroke.start_ms))):
            if a.hand is b.hand and a.palm_side != b.palm_side and b.start_ms < a.end_ms:
                raise ConfigError(
                    f"{name}: act {b.number} ({b.act.word}) touches the {b.surface} while act {a.number} touches the {a.surface}",
                    hint="A limb shows one side at a time",
                )

    def _all(self) -> Iterable[Stroke]:
        return [stroke for strokes in self._strokes.values() for stroke in strokes]

    def _is_seen(self, stroke: Stroke, time_ms: float) -> bool:
        if stroke.start_ms - APPEAR_MS <= time_ms <= stroke.end_ms + APPEAR_MS:
            return True
        strokes = self._strokes[stroke.hand, stroke.finger]
        return any(a.end_ms <= time_ms <= b.start_ms and b.start_ms - a.end_ms <= LINGER_MS for a, b in pairwise(strokes))

    def _finger(self, stroke: Stroke, time_ms: float, index: int) -> SimulatedFinger:
        strokes = self._strokes[stroke.hand, stroke.finger]
        x_mm, y_mm = self._place(strokes, time_ms, stroke)
        if self._script.jitter_mm > 0.0:
            slot = 5 * (stroke.hand is Handedness.LEFT) + FINGERS.index(stroke.finger)
            noise = np.random.default_rng((self._script.seed, index, slot)).normal(0.0, self._script.jitter_mm, 2)
            x_mm, y_mm = x_mm + float(noise[0]), y_mm + float(noise[1])
        hover_mm = min(each.height_mm(time_ms) for each in strokes)
        return SimulatedFinger(
            surface_at(y_mm, palm_side=stroke.palm_side),
            x_mm,
            y_mm,
            hover_mm,
            stroke.pressed_n(time_ms) if hover_mm == 0.0 else 0.0,
            stroke.pitch_rad,
            stroke.yaw_rad,
            stroke.finger,
            stroke.hand,
        )

    @staticmethod
    def _place(strokes: list[Stroke], time_ms: float, nearest: Stroke) -> Point:
        """On its act's path, or on the way from the end of one act to the beginning of the next."""
        for a, b in pairwise(strokes):
            if a.end_ms < time_ms < b.start_ms and b.start_ms - a.end_ms <= LINGER_MS:
                share = minimum_jerk((time_ms - a.end_ms) / (b.start_ms - a.end_ms))
                (x0, y0), (x1, y1) = a.place(time_ms), b.place(time_ms)
                return x0 + share * (x1 - x0), y0 + share * (y1 - y0)
        return nearest.place(time_ms)


def _nearest(strokes: Iterable[Stroke], time_ms: float) -> Stroke | None:
    """The stroke that is under way at this time or closest to it."""
    return min(strokes, key=lambda stroke: max(stroke.start_ms - time_ms, time_ms - stroke.end_ms), default=None)


def _within(time_ms: float, spans_ms: list[tuple[float, float]]) -> bool:
    return any(start <= time_ms < end for start, end in spans_ms)
