"""Views on skin as one listener of touch events."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from difflib import get_close_matches
from typing import TypeVar

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.listeners.touch_listener import TouchListener
from egotouch_sdk.skin.calling import call_listeners, raise_all
from egotouch_sdk.skin.fingers import FingerState, Fingers, ViewCall
from egotouch_sdk.skin.handles import KeypadHandle, SliderChange, SliderHandle, ViewHandle
from egotouch_sdk.skin.keypad import SkinKeypad
from egotouch_sdk.skin.layout import SkinItem, SkinLayout
from egotouch_sdk.skin.snapshot import FingerSnapshot, SkinSnapshot, ViewSnapshot
from egotouch_sdk.skin.table import Call, ViewState
from egotouch_sdk.skin.views import SkinSlider
from egotouch_sdk.touch_event import EventType, TouchEvent

HandleT = TypeVar("HandleT", ViewHandle, SliderHandle, KeypadHandle)


class SkinViewGroup(TouchListener):
    """Brings a layout to life: `et.addListener(group)` is all that an app needs to do with it.

    `view(name)`, `slider(name)` and `keypad(name)` give the handles to register listeners on; `snapshot()` what to draw. The group
    changes only when it is told of an event, has no thread and reads no clock. Its state is up to date before a listener is called.
    Listeners are called on the thread that delivers events; snapshots may be taken on any thread.

    A view captures the finger that comes down on it until UP or CANCEL. Several views can be held by several fingers at once; a further
    finger on a held view is ignored until it is lifted. Clicks are the views' own: a finger that slides within a button still clicks
    it, which the event CLICK (no farther than `GestureConfig.touch_slop_mm`) would not; and each of the two clicks of a DOUBLE_CLICK
    is one of the view. A slider keeps its value when a touch on it is cancelled.
    """

    def __init__(self, layout: SkinLayout | Iterable[SkinItem]) -> None:
        self.layout = layout if isinstance(layout, SkinLayout) else SkinLayout(tuple(layout))
        views = self.layout.views
        self._fingers = Fingers(views)
        self._looks = {
            view.name: ViewSnapshot(
                view.name, view.text, view.region, value=view.stepped(view.value) if isinstance(view, SkinSlider) else None
            )
            for view in views
        }
        self._snapshot = SkinSnapshot(0, tuple(self._looks.values()))
        self._handles = {
            view.name: SliderHandle(view, self.snapshot) if isinstance(view, SkinSlider) else ViewHandle(view, self.snapshot)
            for view in views
        }
        self._keypads = {
            item.name: KeypadHandle(item, {button.text: self._handles[button.name] for button in item.buttons})
            for item in self.layout.items
            if isinstance(item, SkinKeypad)
        }

    def view(self, name: str) -> ViewHandle:
        """The view of that name, a keypad's key as `<keypad>/<key>`; raises `LayoutError` when there is none."""
        return _find(name, self._handles, "view")

    def slider(self, name: str) -> SliderHandle:
        """The slider of that name; raises `LayoutError` when there is none."""
        return _find(name, {key: handle for key, handle in self._handles.items() if isinstance(handle, SliderHandle)}, "slider")

    def keypad(self, name: str) -> KeypadHandle:
        """The keypad of that name; raises `LayoutError` when there is none."""
        return _find(name, self._keypads, "keypad")

    def snapshot(self) -> SkinSnapshot:
        """How all views look now; it never changes afterwards."""
        return self._snapshot

    def handle(self, event: TouchEvent) -> bool:
        """Take in any touch event; True when a view's `onLongClick` has consumed it.

        Raises what listeners throw, after all of them were called, and `GrammarError` for an event that cannot follow the ones before.
        """
        calls = self._fingers.step(event)
        change = self._update_value(event)
        self._update_looks(event)
        return self._call(calls, change, event)

    def _update_value(self, event: TouchEvent) -> SliderChange | None:
        if event.type not in (EventType.DOWN, EventType.MOVE):
            return None
        slider = self._fingers.captured_by(event)
        if not isinstance(slider, SkinSlider):
            return None
        value, look = slider.value_for(event), self._looks[slider.name]
        if value is None or value == look.value:
            return None
        self._looks[slider.name] = replace(look, value=value)
        return SliderChange(slider, value, event)

    def _update_looks(self, event: TouchEvent) -> None:
        states = self._fingers.states
        over = {state.view.name: state for state in states if state.view is not None and state.state is ViewState.HOVERING}
        pressing = {state.view.name: state for state in states if state.view is not None and state.state is ViewState.PRESSED}
        for name, look in self._looks.items():
            force_n = pressing[name].event.force_n if name in pressing else 0.0
            if (look.is_hovered, look.is_pressed, look.force_n) != (name in over, name in pressing, force_n):
                self._looks[name] = replace(look, is_hovered=name in over, is_pressed=name in pressing, force_n=force_n)
        self._snapshot = SkinSnapshot(event.timestamp_ns, tuple(self._looks.values()), tuple(map(_finger_look, states)))

    def _call(self, calls: tuple[ViewCall, ...], change: SliderChange | None, event: TouchEvent) -> bool:
        is_consumed, errors = False, list[Exception]()
        for call in calls:
            try:
                result = call_listeners(self._handles[call.view.name].registry, call.name, event, event)
            except Exception as error:
                errors.append(error)
                continue
            if call.name == Call.LONG_CLICK and result:
                self._fingers.consume(event.pointer_id)
                is_consumed = True
        if change is not None:
            try:
                call_listeners(self._handles[change.slider.name].registry, "onChange", change, event)
            except Exception as error:
                errors.append(error)
        raise_all(errors)
        return is_consumed

    def onTouchDown(self, event: TouchEvent) -> None:
        """Passes the event to the views."""
        self.handle(event)

    onTouchUp = onTouchMove = onTouchCancel = onDragStart = onDrag = onDragEnd = onForce = onTouchDown
    onHoverEnter = onHoverMove = onHoverExit = onTouchDown

    def onLongClick(self, event: TouchEvent) -> bool:
        """Passes the event to the views; True keeps the contact from becoming a click for any listener."""
        return self.handle(event)


def _finger_look(state: FingerState) -> FingerSnapshot:
    event = state.event
    is_touching = not event.type.is_hover and event.type not in (EventType.UP, EventType.CANCEL)
    return FingerSnapshot(
        event.pointer_id, event.finger, event.host_hand, event.surface, event.x_mm, event.y_mm, event.force_n, is_touching
    )


def _find(name: str, handles: dict[str, HandleT], kind: str) -> HandleT:
    if name in handles:
        return handles[name]
    close = get_close_matches(name, handles, n=1)
    raise LayoutError(f"there is no {kind} {name!r}", hint=f"Did you mean {close[0]}?" if close else f"There are: {', '.join(handles)}")
