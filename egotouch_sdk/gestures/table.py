"""The three tracks of a contact, as data: (state, input) -> (next state, events to send).

A contact runs through all three side by side. Every track begins in its first state with the DOWN and is back there after the
UP or the CANCEL.
"""

from __future__ import annotations

from enum import StrEnum

from egotouch_sdk.touch_event import EventType


class PressState(StrEnum):
    """What the contact can still become."""

    NONE = "none"
    HELD = "held"
    HELD_LONG = "held_long"
    SPENT = "spent"


class PressInput(StrEnum):
    """What one frame of a contact means for clicks."""

    LANDED = "landed"  # the DOWN
    FOUND = "found"  # the DOWN of a finger that was lost while it touched, and did not hover long enough since to land anew
    STAYED = "stayed"  # still there, nothing new
    DUE = "due"  # still there, and held for the long press timeout, or pressed deep for the tap timeout
    LEFT_SLOP = "left_slop"  # farther from the DOWN than the slop
    LIFTED = "lifted"  # the UP
    LIFTED_AGAIN = "lifted_again"  # the UP of a touch that follows a click in time and place
    LIFTED_AWAY = "lifted_away"  # the UP, seen too far from the DOWN to mean this place
    CANCELLED = "cancelled"  # the CANCEL


class DragState(StrEnum):
    """Whether the contact is a drag."""

    STILL = "still"
    DRAGGING = "dragging"


class DragInput(StrEnum):
    """What one frame of a contact means for drags."""

    NEAR = "near"  # within the slop around the DOWN
    FAR = "far"  # outside of it
    LIFTED = "lifted"  # the UP
    LIFTED_FAST = "lifted_fast"  # the UP of a finger that was moving at least at the fling speed
    CANCELLED = "cancelled"  # the CANCEL


class ForceState(StrEnum):
    """Whether the contact is a force press."""

    SOFT = "soft"
    HARD = "hard"


class ForceInput(StrEnum):
    """What one frame of a contact means for force presses."""

    WEAK = "weak"  # below the exit force
    MIDDLE = "middle"  # from the exit force up to the enter force
    STRONG = "strong"  # at or above the enter force
    STEADY = "steady"  # not weak, and less than one step from the force last told
    LIFTED = "lifted"  # the UP
    CANCELLED = "cancelled"  # the CANCEL


_P, _PI = PressState, PressInput
_CLICK, _CLICKS = (EventType.CLICK,), (EventType.CLICK, EventType.DOUBLE_CLICK)

PRESS: dict[tuple[PressState, PressInput], tuple[PressState, tuple[EventType, ...]]] = {
    (_P.NONE, _PI.LANDED): (_P.HELD, ()),
    (_P.NONE, _PI.FOUND): (_P.SPENT, ()),
    (_P.HELD, _PI.STAYED): (_P.HELD, ()),
    (_P.HELD, _PI.DUE): (_P.HELD_LONG, (EventType.LONG_CLICK,)),
    (_P.HELD, _PI.LEFT_SLOP): (_P.SPENT, ()),
    (_P.HELD, _PI.LIFTED): (_P.NONE, _CLICK),
    (_P.HELD, _PI.LIFTED_AGAIN): (_P.NONE, _CLICKS),
    (_P.HELD, _PI.LIFTED_AWAY): (_P.NONE, ()),
    (_P.HELD, _PI.CANCELLED): (_P.NONE, ()),
    (_P.HELD_LONG, _PI.STAYED): (_P.HELD_LONG, ()),
    (_P.HELD_LONG, _PI.DUE): (_P.HELD_LONG, ()),
    (_P.HELD_LONG, _PI.LEFT_SLOP): (_P.SPENT, ()),
    # As on Android a click follows the long click, unless a listener consumed that. It is never half of a double click.
    (_P.HELD_LONG, _PI.LIFTED): (_P.NONE, _CLICK),
    (_P.HELD_LONG, _PI.LIFTED_AGAIN): (_P.NONE, _CLICK),
    (_P.HELD_LONG, _PI.LIFTED_AWAY): (_P.NONE, ()),
    (_P.HELD_LONG, _PI.CANCELLED): (_P.NONE, ()),
    (_P.SPENT, _PI.STAYED): (_P.SPENT, ()),
    (_P.SPENT, _PI.DUE): (_P.SPENT, ()),
    (_P.SPENT, _PI.LEFT_SLOP): (_P.SPENT, ()),
    (_P.SPENT, _PI.LIFTED): (_P.NONE, ()),
    (_P.SPENT, _PI.LIFTED_AGAIN): (_P.NONE, ()),
    (_P.SPENT, _PI.LIFTED_AWAY): (_P.NONE, ()),
    (_P.SPENT, _PI.CANCELLED): (_P.NONE, ()),
}

_D, _DI = DragState, DragInput
_DRAG, _DRAG_END = (EventType.DRAG,), (EventType.DRAG_END,)

DRAG: dict[tuple[DragState, DragInput], tuple[DragState, tuple[EventType, ...]]] = {
    (_D.STILL, _DI.NEAR): (_D.STILL, ()),
    (_D.STILL, _DI.FAR): (_D.DRAGGING, (EventType.DRAG_START,)),
    (_D.STILL, _DI.LIFTED): (_D.STILL, ()),
    (_D.STILL, _DI.LIFTED_FAST): (_D.STILL, ()),
    (_D.STILL, _DI.CANCELLED): (_D.STILL, ()),
    # Coming back to where it began does not end a drag.
    (_D.DRAGGING, _DI.NEAR): (_D.DRAGGING, _DRAG),
    (_D.DRAGGING, _DI.FAR): (_D.DRAGGING, _DRAG),
    (_D.DRAGGING, _DI.LIFTED): (_D.STILL, _DRAG_END),
    (_D.DRAGGING, _DI.LIFTED_FAST): (_D.STILL, (EventType.DRAG_END, EventType.FLING)),
    (_D.DRAGGING, _DI.CANCELLED): (_D.STILL, _DRAG_END),
}

_F, _FI = ForceState, ForceInput
_CHANGE, _EXIT = (EventType.FORCE_CHANGE,), (EventType.FORCE_EXIT,)

FORCE: dict[tuple[ForceState, ForceInput], tuple[ForceState, tuple[EventType, ...]]] = {
    (_F.SOFT, _FI.WEAK): (_F.SOFT, ()),
    (_F.SOFT, _FI.MIDDLE): (_F.SOFT, ()),
    (_F.SOFT, _FI.STRONG): (_F.HARD, (EventType.FORCE_ENTER,)),
    (_F.SOFT, _FI.LIFTED): (_F.SOFT, ()),
    (_F.SOFT, _FI.CANCELLED): (_F.SOFT, ()),
    (_F.HARD, _FI.WEAK): (_F.SOFT, _EXIT),
    (_F.HARD, _FI.MIDDLE): (_F.HARD, _CHANGE),
    (_F.HARD, _FI.STRONG): (_F.HARD, _CHANGE),
    (_F.HARD, _FI.STEADY): (_F.HARD, ()),
    (_F.HARD, _FI.LIFTED): (_F.SOFT, _EXIT),
    (_F.HARD, _FI.CANCELLED): (_F.SOFT, _EXIT),
}

#: What a lift or a cancel brings to an end: sent before the UP or the CANCEL, not after it.
CLOSING = frozenset({EventType.DRAG_END, EventType.FORCE_EXIT})
