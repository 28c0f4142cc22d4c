"""What a finger does to skin views, as data: (state of the finger, input) -> (next state, calls to the view, in order)."""

from __future__ import annotations

from enum import StrEnum


class ViewState(StrEnum):
    """What a finger has to do with a view."""

    AWAY = "away"  # with none: over bare skin, or in a contact that began there
    HOVERING = "hovering"  # above a view, which is highlighted
    PRESSED = "pressed"  # has captured a view and is inside it
    STRAYED = "strayed"  # has captured a view and is outside it


class ViewInput(StrEnum):
    """What one event means to views. Inside and outside are those of the captured view, grown by its slop."""

    HOVER_ON = "hover on"  # hovers over the same view as before
    HOVER_ONTO = "hover onto"  # hovers over a view, and not over the same as before
    HOVER_OFF = "hover off"  # hovers over no view
    GONE = "gone"  # hovers no longer
    PRESS = "press"  # DOWN on a view that no other finger has captured
    PRESS_NOTHING = "press nothing"  # DOWN on no view, or on one that another finger has captured
    INSIDE = "inside"  # MOVE
    OUTSIDE = "outside"
    LIFT_INSIDE = "lift inside"  # UP
    LIFT_OUTSIDE = "lift outside"
    CANCEL = "cancel"
    LONG_CLICK = "long click"
    DERIVED = "derived"  # drag and force events


class Call(StrEnum):
    """A call to a view's listeners; the values are their names."""

    HOVER_ENTER = "onHoverEnter"
    HOVER_MOVE = "onHoverMove"
    HOVER_EXIT = "onHoverExit"
    DOWN = "onTouchDown"
    MOVE = "onTouchMove"
    UP = "onTouchUp"
    CANCEL = "onTouchCancel"
    CLICK = "onClick"  # left out when onLongClick has returned True in this contact
    LONG_CLICK = "onLongClick"
    DERIVED = "derived"  # onDragStart, onDrag, onDragEnd or onForce, as the event says


_AWAY, _HOVERING, _PRESSED, _STRAYED = ViewState
_In = ViewInput

TABLE: dict[tuple[ViewState, ViewInput], tuple[ViewState, tuple[Call, ...]]] = {
    (_AWAY, _In.HOVER_ONTO): (_HOVERING, (Call.HOVER_ENTER,)),
    (_AWAY, _In.HOVER_OFF): (_AWAY, ()),
    (_AWAY, _In.GONE): (_AWAY, ()),
    (_AWAY, _In.PRESS): (_PRESSED, (Call.DOWN,)),
    (_AWAY, _In.PRESS_NOTHING): (_AWAY, ()),
    # The rest of a contact that captured nothing, whatever it slides over.
    (_AWAY, _In.OUTSIDE): (_AWAY, ()),
    (_AWAY, _In.LIFT_OUTSIDE): (_AWAY, ()),
    (_AWAY, _In.CANCEL): (_AWAY, ()),
    (_AWAY, _In.LONG_CLICK): (_AWAY, ()),
    (_AWAY, _In.DERIVED): (_AWAY, ()),
    (_HOVERING, _In.HOVER_ON): (_HOVERING, (Call.HOVER_MOVE,)),
    (_HOVERING, _In.HOVER_ONTO): (_HOVERING, (Call.HOVER_EXIT, Call.HOVER_ENTER)),
    (_HOVERING, _In.HOVER_OFF): (_AWAY, (Call.HOVER_EXIT,)),
    (_HOVERING, _In.GONE): (_AWAY, (Call.HOVER_EXIT,)),
    (_HOVERING, _In.PRESS): (_PRESSED, (Call.HOVER_EXIT, Call.DOWN)),
    (_HOVERING, _In.PRESS_NOTHING): (_AWAY, (Call.HOVER_EXIT,)),
    (_PRESSED, _In.INSIDE): (_PRESSED, (Call.MOVE,)),
    (_PRESSED, _In.OUTSIDE): (_STRAYED, (Call.MOVE,)),
    (_PRESSED, _In.LIFT_INSIDE): (_AWAY, (Call.UP, Call.CLICK)),
    (_PRESSED, _In.LIFT_OUTSIDE): (_AWAY, (Call.UP,)),
    (_PRESSED, _In.CANCEL): (_AWAY, (Call.CANCEL,)),
    (_PRESSED, _In.LONG_CLICK): (_PRESSED, (Call.LONG_CLICK,)),
    (_PRESSED, _In.DERIVED): (_PRESSED, (Call.DERIVED,)),
    # A finger that returns presses again, as UIKit's touchDragEnter does; Android's View would stay released.
    (_STRAYED, _In.INSIDE): (_PRESSED, (Call.MOVE,)),
    (_STRAYED, _In.OUTSIDE): (_STRAYED, (Call.MOVE,)),
    (_STRAYED, _In.LIFT_INSIDE): (_AWAY, (Call.UP, Call.CLICK)),
    (_STRAYED, _In.LIFT_OUTSIDE): (_AWAY, (Call.UP,)),
    (_STRAYED, _In.CANCEL): (_AWAY, (Call.CANCEL,)),
    (_STRAYED, _In.LONG_CLICK): (_STRAYED, ()),
    (_STRAYED, _In.DERIVED): (_STRAYED, (Call.DERIVED,)),
}
