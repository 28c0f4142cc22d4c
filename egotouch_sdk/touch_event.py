"""The event that listeners, servers and clients see."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import Finger, Handedness


class EventType(StrEnum):
    """What happened to a pointer; names follow Android's MotionEvent actions."""

    HOVER_ENTER = "hover_enter"
    HOVER_MOVE = "hover_move"
    HOVER_EXIT = "hover_exit"
    DOWN = "down"
    MOVE = "move"
    UP = "up"
    CANCEL = "cancel"


class CancelReason(StrEnum):
    """Why a touch ended without a lift."""

    TRACKING_LOST = "tracking_lost"
    HAND_SWAPPED = "hand_swapped"
    SOURCE_STALLED = "source_stalled"
    SOURCE_ENDED = "source_ended"


@dataclass(frozen=True, slots=True)
class TouchEvent:
    """One event of one pointer (a fingertip, from HOVER_ENTER to HOVER_EXIT).

    `pointer_id` is never reused; `contact_id` counts the pointer's touches from 1 (0 before the first).
    `timestamp_ns` is the capture time of the frame that caused the event; `hand` the touching hand.
    `image_x`, `image_y` are the fingertip in the frame, 0..1 from the top left.
    `x_palms`, `y_palms` are the fingertip in the host's own frame in the image: origin at the wrist,
    +y towards the middle MCP, +x towards the host's thumb side, in lengths wrist to middle MCP.
    `force_n` is 0 on UP, CANCEL and every hover event. `reason` is set on CANCEL only.
    """

    type: EventType
    pointer_id: int
    contact_id: int
    timestamp_ns: int
    hand: Handedness
    finger: Finger
    touch_probability: float
    force_n: float
    image_x: float
    image_y: float
    x_palms: float
    y_palms: float
    reason: CancelReason | None = None

    def __post_init__(self) -> None:
        if (self.type is EventType.CANCEL) != (self.reason is not None):
            raise FrameError(f"event {self.type} has reason {self.reason}; CANCEL needs one and nothing else may have one")
        if not 0.0 <= self.touch_probability <= 1.0 or self.force_n < 0.0:
            raise FrameError(f"event has touch_probability={self.touch_probability}, force_n={self.force_n}")

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields, `reason` left out where there is none."""
        return {k: v for k, v in asdict(self).items() if v is not None}
