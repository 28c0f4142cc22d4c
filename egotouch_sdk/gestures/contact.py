"""One contact: what each of its frames means to the three tracks, and where they stand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.gestures.table import DRAG, FORCE, PRESS, DragInput, DragState, ForceInput, ForceState, PressInput, PressState
from egotouch_sdk.gestures.velocity import VelocityTracker
from egotouch_sdk.touch_event import EventType, TouchEvent

#: A timer is due this much early: 12 frames of 33333333 ns are 400 ms.
ROUNDING_NS = 1_000


@dataclass(frozen=True, slots=True)
class GestureStates:
    """Where one contact is in each of its three tracks."""

    press: PressState = PressState.NONE
    drag: DragState = DragState.STILL
    force: ForceState = ForceState.SOFT


class Contact:
    """A touch from DOWN to UP or CANCEL. `follows_click` says that it begins in time and place for a double click, `was_found` that
    nobody saw the finger land."""

    def __init__(self, config: GestureConfig, down: TouchEvent, *, follows_click: bool, was_found: bool) -> None:
        self.down = down
        self.states = GestureStates()
        self.was_long = False
        self._config = config
        self._follows_click = follows_click
        self._was_found = was_found
        self._velocity = VelocityTracker(config)
        self._told_force_n = 0.0
        self._deep_since_ns: int | None = None

    def with_velocity(self, event: TouchEvent) -> TouchEvent:
        """The next raw event, with the contact's velocity; a lift and a cancel have that of the last frame on the skin."""
        if event.type in (EventType.DOWN, EventType.MOVE):
            self._velocity.add(event.timestamp_ns, event.x_mm, event.y_mm)
        elif self._velocity.has_gap(event.timestamp_ns):
            return event
        x_mm_s, y_mm_s = self._velocity.velocity_mm_s()
        return replace(event, velocity_x_mm_s=x_mm_s, velocity_y_mm_s=y_mm_s) if x_mm_s or y_mm_s else event

    def advance(self, event: TouchEvent) -> tuple[EventType, ...]:
        """Take the next raw event, with its velocity, and say what it causes: of the drag, the force and the press, in this order."""
        before = self.states
        drag, drag_events = DRAG[before.drag, self._read_drag(event)]
        force, force_events = FORCE[before.force, self._read_force(event)]
        press, press_events = PRESS[before.press, self._read_press(event)]
        self.states = GestureStates(press, drag, force)
        if EventType.FORCE_ENTER in force_events or EventType.FORCE_CHANGE in force_events:
            self._told_force_n = event.force_n
        self.was_long = self.was_long or EventType.LONG_CLICK in press_events
        return drag_events + force_events + press_events

    def _read_drag(self, event: TouchEvent) -> DragInput:
        if event.type is EventType.CANCEL:
            return DragInput.CANCELLED
        if event.type is EventType.UP:
            return DragInput.LIFTED_FAST if self._is_fast(event) else DragInput.LIFTED
        return DragInput.FAR if hypot(event.dx_mm, event.dy_mm) > self._config.touch_slop_mm else DragInput.NEAR

    def _is_fast(self, up: TouchEvent) -> bool:
        speed_mm_s = hypot(up.velocity_x_mm_s, up.velocity_y_mm_s)
        return min(speed_mm_s, self._velocity.latest_speed_mm_s()) >= self._config.fling_min_mm_s

    def _read_force(self, event: TouchEvent) -> ForceInput:
        if event.type is EventType.CANCEL:
            return ForceInput.CANCELLED
        if event.type is EventType.UP:
            return ForceInput.LIFTED
        if event.force_n < self._config.force_exit_n:
            return ForceInput.WEAK
        if self.states.force is ForceState.HARD and abs(event.force_n - self._told_force_n) < self._config.force_step_n:
            return ForceInput.STEADY
        return ForceInput.STRONG if event.force_n >= self._config.force_enter_n else ForceInput.MIDDLE

    def _read_press(self, event: TouchEvent) -> PressInput:
        if event.type is EventType.CANCEL:
            return PressInput.CANCELLED
        way_mm = hypot(event.dx_mm, event.dy_mm)
        if event.type is EventType.UP:
            if way_mm > self._config.double_click_slop_mm:
                return PressInput.LIFTED_AWAY
            return PressInput.LIFTED_AGAIN if self._follows_click else PressInput.LIFTED
        is_deep = self._is_deep(event)
        if event.type is EventType.DOWN:
            return PressInput.FOUND if self._was_found else PressInput.LANDED
        if way_mm > self._config.touch_slop_mm:
            return PressInput.LEFT_SLOP
        is_held = is_due(self.down.timestamp_ns, event.timestamp_ns, self._config.long_press_timeout_ms)
        return PressInput.DUE if is_held or is_deep else PressInput.STAYED

    def _is_deep(self, event: TouchEvent) -> bool:
        """True when the finger has pressed deep for the tap timeout; every frame counts, so call it for each of them once."""
        if event.force_n < self._config.deep_press_n:
            self._deep_since_ns = None
            return False
        if self._deep_since_ns is None:
            self._deep_since_ns = event.timestamp_ns
        return is_due(self._deep_since_ns, event.timestamp_ns, self._config.tap_timeout_ms)


def is_due(since_ns: int, now_ns: int, timeout_ms: float) -> bool:
    """True when `timeout_ms` have passed, but for rounding."""
    return now_ns - since_ns >= timeout_ms * 1e6 - ROUNDING_NS
