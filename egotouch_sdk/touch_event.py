"""The event that listeners, servers and clients see."""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import StrEnum
from math import degrees, isfinite, pi
from typing import Any

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.surface import Surface


class EventType(StrEnum):
    """What happened to a pointer; names follow Android's MotionEvent actions and View listeners."""

    HOVER_ENTER = "hover_enter"
    HOVER_MOVE = "hover_move"
    HOVER_EXIT = "hover_exit"
    DOWN = "down"
    MOVE = "move"
    UP = "up"
    CANCEL = "cancel"
    CLICK = "click"
    DOUBLE_CLICK = "double_click"
    LONG_CLICK = "long_click"
    DRAG_START = "drag_start"
    DRAG = "drag"
    DRAG_END = "drag_end"
    FORCE_ENTER = "force_enter"
    FORCE_CHANGE = "force_change"
    FORCE_EXIT = "force_exit"
    FLING = "fling"

    @property
    def is_hover(self) -> bool:
        """True for the three hover events, which lie outside a contact."""
        return self in _HOVER

    @property
    def is_edge(self) -> bool:
        """True for an event that must never be lost; False for those a slow consumer may see merged."""
        return self not in _STREAM


_HOVER = frozenset({EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT})
_STREAM = frozenset({EventType.HOVER_MOVE, EventType.MOVE, EventType.DRAG, EventType.FORCE_CHANGE})
_CLICKS = frozenset({EventType.CLICK, EventType.DOUBLE_CLICK})
#: Events that a CANCEL forces carry its reason too, so that a listener can tell an aborted drag from a finished one.
_MAY_HAVE_REASON = frozenset({EventType.CANCEL, EventType.DRAG_END, EventType.FORCE_EXIT})


class CancelReason(StrEnum):
    """Why a touch ended without a lift."""

    TRACKING_LOST = "tracking_lost"
    HAND_SWAPPED = "hand_swapped"
    SOURCE_STALLED = "source_stalled"
    SOURCE_ENDED = "source_ended"
    DISCONNECTED = "disconnected"
    SERVER_STOPPED = "server_stopped"


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchEvent:
    """One event of one pointer (a fingertip, from HOVER_ENTER to HOVER_EXIT).

    `pointer_id` is never reused; `contact_id` counts the pointer's touches from 1 (0 before the first).
    `timestamp_ns` is the capture time of the frame that caused the event; `down_time_ns` that of the contact's DOWN, None on
    hover events. `hand` is the touching hand; `finger` its finger; `surface` the skin under it on the other hand's limb.
    `touch_probability` is 0..1. `force_n` is in newtons, 0 on UP, CANCEL and every event after them, and while hovering;
    `force_sigma_n` its standard error, None when the model gives none.
    `x_mm`, `y_mm` are the touch point in the host frame: origin at the host's wrist, +y to the middle MCP, +x to the thumb side.
    `dx_mm`, `dy_mm` are the way since the contact's DOWN, `velocity_x_mm_s`, `velocity_y_mm_s` the speed, all 0 while hovering.
    `pitch_rad` is 0 for a finger flat on the skin and pi/2 for one perpendicular to it; `yaw_rad` in (-pi, pi] is 0 for a finger
    that points along +y and positive towards +x. `image_x`, `image_y` are the fingertip in the frame, 0..1 from the top left.
    `click_count` is 1 on the first CLICK and 2 on the second one and on its DOUBLE_CLICK, 0 on all others.
    `reason` is set on CANCEL, and on a DRAG_END or FORCE_EXIT that the CANCEL brings about.
    `coalesced` holds the older events of the same kind that were merged into this one for a slow consumer, oldest first.
    Raises `FrameError` for a value out of its range.
    """

    type: EventType
    pointer_id: int
    contact_id: int
    timestamp_ns: int
    hand: Handedness
    finger: Finger
    surface: Surface
    touch_probability: float
    force_n: float
    x_mm: float
    y_mm: float
    pitch_rad: float
    yaw_rad: float
    image_x: float
    image_y: float
    down_time_ns: int | None = None
    force_sigma_n: float | None = None
    dx_mm: float = 0.0
    dy_mm: float = 0.0
    velocity_x_mm_s: float = 0.0
    velocity_y_mm_s: float = 0.0
    click_count: int = 0
    reason: CancelReason | None = None
    coalesced: tuple[TouchEvent, ...] = ()

    def __post_init__(self) -> None:
        if self.type is EventType.CANCEL and self.reason is None:
            raise FrameError("a CANCEL has no reason", hint=f"Give one of {', '.join(CancelReason)}")
        if self.reason is not None and self.type not in _MAY_HAVE_REASON:
            raise FrameError(f"a {self.type} has the reason {self.reason}, which only CANCEL and what it ends may have")
        if not 0.0 <= self.touch_probability <= 1.0 or not 0.0 <= self.force_n < float("inf"):
            raise FrameError(f"event has touch_probability={self.touch_probability}, force_n={self.force_n}")
        if (self.down_time_ns is None) != self.type.is_hover:
            raise FrameError(f"a {self.type} has down_time_ns={self.down_time_ns}; every event of a contact has one, a hover has none")
        if (self.click_count > 0) != (self.type in _CLICKS):
            raise FrameError(f"a {self.type} has click_count={self.click_count}")
        place = (self.x_mm, self.y_mm, self.dx_mm, self.dy_mm, self.velocity_x_mm_s, self.velocity_y_mm_s, self.image_x, self.image_y)
        if not all(map(isfinite, place)) or not 0.0 <= self.pitch_rad <= pi / 2 or not -pi <= self.yaw_rad <= pi:
            raise FrameError(f"event lies at {place}, pitch_rad={self.pitch_rad}, yaw_rad={self.yaw_rad}")

    @property
    def host_hand(self) -> Handedness:
        """The wearer's hand whose limb is touched."""
        return self.hand.other

    @property
    def pitch_deg(self) -> float:
        """`pitch_rad` in degrees, 0..90."""
        return degrees(self.pitch_rad)

    @property
    def yaw_deg(self) -> float:
        """`yaw_rad` in degrees, -180..180."""
        return degrees(self.yaw_rad)

    @property
    def duration_ms(self) -> float:
        """Milliseconds since the contact's DOWN, 0 while hovering."""
        return 0.0 if self.down_time_ns is None else (self.timestamp_ns - self.down_time_ns) / 1e6

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields; those that are None or empty are left out."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        values["coalesced"] = [event.to_dict() for event in self.coalesced]
        return {name: value for name, value in values.items() if value is not None and value != []}
