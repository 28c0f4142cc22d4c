"""Events for tests, every field with a sensible default."""

from __future__ import annotations

from typing import Any

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent


def make_event(event_type: EventType, timestamp_ns: int = 0, **fields: Any) -> TouchEvent:
    """A right index finger on the left palm; `fields` replace the defaults."""
    is_hover = event_type.is_hover
    defaults: dict[str, Any] = {
        "pointer_id": 1,
        "contact_id": 0 if event_type is EventType.HOVER_ENTER else 1,
        "hand": Handedness.RIGHT,
        "finger": Finger.INDEX,
        "surface": Surface.PALM,
        "touch_probability": 0.1 if is_hover else 0.9,
        "force_n": 0.0,
        "x_mm": 0.0,
        "y_mm": 50.0,
        "pitch_rad": 0.7,
        "yaw_rad": 0.0,
        "image_x": 0.5,
        "image_y": 0.5,
        "down_time_ns": None if is_hover else timestamp_ns,
        "click_count": 1 if event_type is EventType.CLICK else 2 if event_type is EventType.DOUBLE_CLICK else 0,
        "reason": CancelReason.TRACKING_LOST if event_type is EventType.CANCEL else None,
    }
    return TouchEvent(type=event_type, timestamp_ns=timestamp_ns, **{**defaults, **fields})
