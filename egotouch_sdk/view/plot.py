"""Touch state and force over time, drawn as a strip under the video."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import cv2
import numpy as np

from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.view.palette import DOWN, GRID, HOVER, MUTED, PANEL, TEXT, Colour, Image, put_text, put_text_right
from egotouch_sdk.view.timeline import Timeline, TipState, Track

FINGER_COLOUR: dict[Finger, Colour] = {
    Finger.THUMB: (115, 150, 250),
    Finger.INDEX: (90, 210, 245),
    Finger.MIDDLE: (240, 190, 80),
    Finger.RING: (215, 130, 225),
    Finger.PINKY: (180, 220, 130),
}
#: Fingertips drawn at a time, those that touch first.
CURVES = 3
_MARGIN_LEFT = 52
_MARGIN_TOP = 26
_MARGIN_BOTTOM = 34
#: A hole in the samples longer than this is drawn as a hole.
_GAP_NS = 200_000_000


class ForcePlot:
    """Draws the timeline into a canvas region `left, top, width, height` in pixels."""

    def __init__(self, left: int, top: int, width: int, height: int) -> None:
        self._x0, self._x1 = left + _MARGIN_LEFT, left + width - 12
        self._y0, self._y1 = top + _MARGIN_TOP, top + height - _MARGIN_BOTTOM
        self._region = (slice(top, top + height), slice(left, left + width))

    def draw(self, canvas: Image, timeline: Timeline) -> None:
        """Grid, one force curve per fingertip, and a bar of its state below."""
        canvas[self._region] = PANEL
        self._grid(canvas)
        tracks = [(finger, track) for (_, finger), track in timeline.newest(CURVES)]
        self._legend(canvas, timeline, [finger for finger, _ in tracks])
        for row, (finger, track) in enumerate(tracks):
            self._curve(canvas, timeline, track, FINGER_COLOUR[finger])
            self._state_bar(canvas, timeline, track, self._y1 + 8 + 8 * row)
        self._truth(canvas, timeline)

    def _grid(self, canvas: Image) -> None:
        put_text(canvas, "force (N)", (self._x0, self._y0 - 9), 0.42, MUTED)
        put_text_right(canvas, "last 4 s", (self._x1, self._y0 - 9), 0.42, MUTED)
        for force_n in (0.0, 1.0, 2.0, 3.0):
            y = self._y(force_n)
            cv2.line(canvas, (self._x0, y), (self._x1, y), GRID, 1)
            put_text_right(canvas, f"{force_n:.0f}", (self._x0 - 8, y + 4), 0.42, MUTED)

    def _legend(self, canvas: Image, timeline: Timeline, fingers: Sequence[Finger]) -> None:
        words = [(finger.value, FINGER_COLOUR[finger]) for finger in fingers]
        if timeline.true_forces:
            words.append(("truth", TEXT))
        for column, (word, colour) in enumerate(words):
            put_text(canvas, word, (self._x0 + 110 + 80 * column, self._y0 - 9), 0.42, colour)

    def _truth(self, canvas: Image, timeline: Timeline) -> None:
        if timeline.true_forces:
            points = [(self._x(timeline, time_ns), self._y(force_n)) for time_ns, force_n in timeline.true_forces]
            cv2.polylines(canvas, [np.array(points, np.int32)], False, TEXT, 1, cv2.LINE_AA)

    def _curve(self, canvas: Image, timeline: Timeline, track: Track, colour: Colour) -> None:
        run: list[tuple[int, int]] = []
        last_ns = None
        for sample in track.samples:
            if last_ns is not None and sample.timestamp_ns - last_ns > _GAP_NS:
                self._fill(canvas, run, colour)
                run = []
            last_ns = sample.timestamp_ns
            force_n = sample.force_n if sample.state is TipState.DOWN else 0.0
            run.append((self._x(timeline, sample.timestamp_ns), self._y(force_n)))
        self._fill(canvas, run, colour)

    def _fill(self, canvas: Image, run: Sequence[tuple[int, int]], colour: Colour) -> None:
        if len(run) < 2:
            return
        points = np.array(run, np.int32)
        left, right, top = int(points[0, 0]), int(points[-1, 0]), int(points[:, 1].min())
        mask = np.zeros((self._y1 - top + 1, right - left + 1), np.uint8)
        outline = np.vstack([points, [[right, self._y1], [left, self._y1]]]) - (left, top)
        cv2.fillPoly(mask, [outline.astype(np.int32)], 90)
        part = canvas[top : self._y1 + 1, left : right + 1]
        weight = mask[..., None].astype(np.uint16)
        part[:] = ((part * (255 - weight) + np.array(colour, np.uint16) * weight) // 255).astype(np.uint8)
        cv2.polylines(canvas, [points], False, colour, 2, cv2.LINE_AA)

    def _state_bar(self, canvas: Image, timeline: Timeline, track: Track, y: int) -> None:
        for a, b in pairwise(track.samples):
            if b.timestamp_ns - a.timestamp_ns > _GAP_NS:
                continue
            down = a.state is TipState.DOWN
            half = 2 if down else 0
            x0, x1 = self._x(timeline, a.timestamp_ns), self._x(timeline, b.timestamp_ns)
            cv2.rectangle(canvas, (x0, y - half), (x1, y + half), DOWN if down else HOVER, -1)

    def _x(self, timeline: Timeline, timestamp_ns: int) -> int:
        age = (timeline.now_ns - timestamp_ns) / timeline.window_ns
        return round(self._x1 - min(max(age, 0.0), 1.0) * (self._x1 - self._x0))

    def _y(self, force_n: float) -> int:
        return round(self._y1 - min(force_n, FORCE_MAX_N) / FORCE_MAX_N * (self._y1 - self._y0))

