"""Which event may come next, per pointer."""

from __future__ import annotations

from egotouch_sdk.touch_event import EventType

_T = EventType
_HOVERING = frozenset({_T.HOVER_MOVE, _T.DOWN, _T.HOVER_EXIT})
_ENDING = frozenset({_T.DRAG_END, _T.FORCE_EXIT, _T.UP, _T.CANCEL})
_NEXT_FRAME = _ENDING | {_T.MOVE}
_PRESSED = _NEXT_FRAME | {_T.LONG_CLICK}

#: What may follow each type of event in the same pointer.
MAY_FOLLOW: dict[EventType, frozenset[EventType]] = {
    _T.HOVER_ENTER: _HOVERING,
    _T.HOVER_MOVE: _HOVERING,
    _T.DOWN: _NEXT_FRAME | {_T.FORCE_ENTER},
    _T.MOVE: _PRESSED | {_T.DRAG_START, _T.DRAG, _T.FORCE_ENTER, _T.FORCE_CHANGE},
    _T.DRAG_START: _NEXT_FRAME | {_T.FORCE_ENTER, _T.FORCE_CHANGE},
    _T.DRAG: _NEXT_FRAME | {_T.FORCE_ENTER, _T.FORCE_CHANGE},
    _T.FORCE_ENTER: _PRESSED,
    _T.FORCE_CHANGE: _PRESSED,
    _T.FORCE_EXIT: _PRESSED,
    _T.LONG_CLICK: _NEXT_FRAME,
    _T.DRAG_END: frozenset({_T.FORCE_EXIT, _T.UP, _T.CANCEL}),
    _T.UP: _HOVERING | {_T.CLICK, _T.FLING},
    _T.CANCEL: _HOVERING,
    _T.CLICK: _HOVERING | {_T.DOUBLE_CLICK},
    _T.DOUBLE_CLICK: _HOVERING,
    _T.FLING: _HOVERING,
    _T.HOVER_EXIT: frozenset(),
}
#: What a frame of a contact may cause, directly after its DOWN or MOVE; the lift's meaning, directly after its UP.
CAUSED_BY: dict[EventType, frozenset[EventType]] = {
    _T.DRAG_START: frozenset({_T.MOVE}),
    _T.DRAG: frozenset({_T.MOVE}),
    _T.FORCE_ENTER: frozenset({_T.DOWN, _T.MOVE}),
    _T.FORCE_CHANGE: frozenset({_T.MOVE}),
    _T.LONG_CLICK: frozenset({_T.MOVE}),
    _T.CLICK: frozenset({_T.UP}),
    _T.DOUBLE_CLICK: frozenset({_T.UP}),
    _T.FLING: frozenset({_T.UP}),
}
#: Events of a frame in which the finger is on the skin, the only ones with a force.
ON_SKIN = frozenset({_T.DOWN, _T.MOVE, _T.DRAG_START, _T.DRAG, _T.FORCE_ENTER, _T.FORCE_CHANGE, _T.FORCE_EXIT, _T.LONG_CLICK})
#: Events that come from what a frame shows; all others are derived from one of them.
RAW = frozenset({_T.HOVER_ENTER, _T.HOVER_MOVE, _T.HOVER_EXIT, _T.DOWN, _T.MOVE, _T.UP, _T.CANCEL})
