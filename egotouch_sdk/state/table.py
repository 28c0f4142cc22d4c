"""The touch state machine of one fingertip, as data: (state, input) -> (next state, events to send, in order)."""

from __future__ import annotations

from enum import StrEnum

from egotouch_sdk.touch_event import CancelReason, EventType


class PointerState(StrEnum):
    """Where a fingertip is in the event grammar."""

    ABSENT = "absent"
    HOVER = "hover"
    TOUCH = "touch"


class Input(StrEnum):
    """What one frame says about a fingertip."""

    CONTACT = "contact"  # seen, touch probability at or above the down threshold
    BETWEEN = "between"  # seen, probability between the two thresholds
    LIFTED = "lifted"  # seen, probability below the up threshold
    MISSING = "missing"  # not seen, for no longer than the coasting limit
    LOST = "lost"  # not seen for longer
    SWAPPED = "swapped"  # seen, but cannot be the same fingertip
    STALLED = "stalled"  # too much time since the frame before
    ENDED = "ended"  # the source has no more frames


_ENTER, _MOVE, _EXIT = EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT
_ABSENT, _HOVER, _TOUCH = PointerState.ABSENT, PointerState.HOVER, PointerState.TOUCH
_CANCELLED = (_ABSENT, (EventType.CANCEL, _EXIT))
_LEFT = (_ABSENT, (_EXIT,))

TABLE: dict[tuple[PointerState, Input], tuple[PointerState, tuple[EventType, ...]]] = {
    # A finger that is first seen touching hovers for one frame: a press must be seen to begin.
    (_ABSENT, Input.CONTACT): (_HOVER, (_ENTER,)),
    (_ABSENT, Input.BETWEEN): (_HOVER, (_ENTER,)),
    (_ABSENT, Input.LIFTED): (_HOVER, (_ENTER,)),
    (_HOVER, Input.CONTACT): (_TOUCH, (EventType.DOWN,)),
    (_HOVER, Input.BETWEEN): (_HOVER, (_MOVE,)),
    (_HOVER, Input.LIFTED): (_HOVER, (_MOVE,)),
    (_HOVER, Input.MISSING): (_HOVER, ()),
    (_HOVER, Input.LOST): _LEFT,
    (_HOVER, Input.SWAPPED): _LEFT,
    (_HOVER, Input.STALLED): _LEFT,
    (_HOVER, Input.ENDED): _LEFT,
    (_TOUCH, Input.CONTACT): (_TOUCH, (EventType.MOVE,)),
    (_TOUCH, Input.BETWEEN): (_TOUCH, (EventType.MOVE,)),
    (_TOUCH, Input.LIFTED): (_HOVER, (EventType.UP,)),
    (_TOUCH, Input.MISSING): (_TOUCH, ()),
    (_TOUCH, Input.LOST): _CANCELLED,
    (_TOUCH, Input.SWAPPED): _CANCELLED,
    (_TOUCH, Input.STALLED): _CANCELLED,
    (_TOUCH, Input.ENDED): _CANCELLED,
}

#: The reason a CANCEL carries, by the input that caused it.
REASONS: dict[Input, CancelReason] = {
    Input.LOST: CancelReason.TRACKING_LOST,
    Input.SWAPPED: CancelReason.HAND_SWAPPED,
    Input.STALLED: CancelReason.SOURCE_STALLED,
    Input.ENDED: CancelReason.SOURCE_ENDED,
}
#: The input that ends everything for a given reason.
INPUT_OF_REASON: dict[CancelReason, Input] = {reason: cause for cause, reason in REASONS.items()}
