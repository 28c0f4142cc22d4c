"""The side panel: one card per fingertip with its patch, then the newest events."""

from __future__ import annotations

from collections.abc import Iterable

import cv2

from egotouch_sdk.touch_event import EventType, TouchEvent
from egotouch_sdk.view.palette import DOWN, GRID, MUTED, PANEL, STATE_COLOUR, TEXT, Image, put_text, put_text_right
from egotouch_sdk.view.plot import FINGER_COLOUR
from egotouch_sdk.view.timeline import Tip, TipState, Track

PATCH_SIDE_PX = 120
CARD_HEIGHT_PX = PATCH_SIDE_PX + 16
_BAR_HEIGHT_PX = 10


def draw_card(canvas: Image, left: int, top: int, width: int, tip: Tip, track: Track, fresh: bool) -> None:
    """Patch, name, state, touch probability (a bar) and force of one fingertip; muted when it was not seen just now."""
    cv2.rectangle(canvas, (left, top), (left + width, top + CARD_HEIGHT_PX - 6), PANEL, -1)
    state = track.state if fresh else TipState.AWAY
    colour = STATE_COLOUR[state]
    if track.patch is not None:
        patch = cv2.resize(track.patch.image[:, :, ::-1], (PATCH_SIDE_PX, PATCH_SIDE_PX), interpolation=cv2.INTER_CUBIC)
        canvas[top + 5 : top + 5 + PATCH_SIDE_PX, left + 5 : left + 5 + PATCH_SIDE_PX] = patch if fresh else patch // 2
        cv2.rectangle(canvas, (left + 4, top + 4), (left + 5 + PATCH_SIDE_PX, top + 5 + PATCH_SIDE_PX), colour, 2)
    x = left + PATCH_SIDE_PX + 20
    right = left + width - 14
    side, finger = tip
    put_text(canvas, f"{side.value} {finger.value}", (x, top + 26), 0.55, FINGER_COLOUR[finger] if fresh else MUTED)
    put_text(canvas, state.value.upper(), (x, top + 56), 0.7, colour, bold=state is TipState.DOWN)
    sample = track.samples[-1]
    put_text(canvas, "touch", (x, top + 82), 0.42, MUTED)
    put_text_right(canvas, f"{sample.touch_probability:.2f}", (right, top + 82), 0.42, TEXT)
    filled = round((right - x) * sample.touch_probability)
    cv2.rectangle(canvas, (x, top + 88), (right, top + 88 + _BAR_HEIGHT_PX), GRID, -1)
    cv2.rectangle(canvas, (x, top + 88), (x + filled, top + 88 + _BAR_HEIGHT_PX), colour, -1)
    put_text(canvas, "force", (x, top + 120), 0.42, MUTED)
    force_n = sample.force_n if state is TipState.DOWN else 0.0
    put_text_right(canvas, f"{force_n:.1f} N", (right, top + 120), 0.5, TEXT)


def draw_ticker(canvas: Image, left: int, top: int, width: int, events: Iterable[TouchEvent], line_px: int = 22) -> None:
    """The newest events, newest first."""
    put_text(canvas, "events", (left, top), 0.5, MUTED)
    for row, event in enumerate(reversed(list(events)), start=1):
        y = top + 4 + row * line_px
        colour = DOWN if event.type is EventType.DOWN else TEXT if event.type in (EventType.UP, EventType.CANCEL) else MUTED
        put_text(canvas, f"{event.timestamp_ns / 1e9:7.2f} s", (left, y), 0.42, MUTED)
        put_text(canvas, event.type.value.replace("_", " "), (left + 82, y), 0.45, colour)
        put_text_right(canvas, f"{event.hand.value} {event.finger.value}", (left + width, y), 0.42, MUTED)
