"""Fingers in front of the state machine and the gestures, and short names for their events."""

from __future__ import annotations

from egotouch_sdk.config import GestureConfig, StateConfig
from egotouch_sdk.touch_event import EventType
from tests.support.finger import ScriptedFinger

ENTER, HOVER, EXIT = EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT
DOWN, MOVE, UP, CANCEL = EventType.DOWN, EventType.MOVE, EventType.UP, EventType.CANCEL
CLICK, DOUBLE_CLICK, LONG_CLICK = EventType.CLICK, EventType.DOUBLE_CLICK, EventType.LONG_CLICK
DRAG_START, DRAGGED, DRAG_END, FLING = EventType.DRAG_START, EventType.DRAG, EventType.DRAG_END, EventType.FLING
FORCE_ENTER, FORCE_CHANGE, FORCE_EXIT = EventType.FORCE_ENTER, EventType.FORCE_CHANGE, EventType.FORCE_EXIT


def new_finger(fps: float = 30.0, state: StateConfig | None = None, gestures: GestureConfig | None = None) -> ScriptedFinger:
    return ScriptedFinger(state, gestures or GestureConfig(), fps)


def pressed(finger: ScriptedFinger, force_n: float = 1.0) -> ScriptedFinger:
    finger.hover()
    finger.touch_down(force_n)
    finger.expect(ENTER, DOWN)
    return finger


def clicked(finger: ScriptedFinger) -> ScriptedFinger:
    finger.hover()
    finger.tap()
    finger.expect(ENTER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    return finger
