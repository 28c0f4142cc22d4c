"""What one client wants to be told."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import TypeVar

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent
from egotouch_sdk.wire import enums
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

E = TypeVar("E", bound=StrEnum)

_POINTER = frozenset({EventType.HOVER_ENTER, EventType.HOVER_EXIT})
_CONTACT = _POINTER | {EventType.DOWN, EventType.UP, EventType.CANCEL}
_DRAGGING = _CONTACT | {EventType.DRAG_START, EventType.DRAG_END}
_PRESSING = _CONTACT | {EventType.FORCE_ENTER, EventType.FORCE_EXIT}

#: A type brings the brackets it lies in, so that whatever a client asks for follows the event grammar.
BRINGS: dict[EventType, frozenset[EventType]] = {
    EventType.HOVER_ENTER: _POINTER,
    EventType.HOVER_MOVE: _POINTER,
    EventType.HOVER_EXIT: _POINTER,
    EventType.DOWN: _CONTACT,
    EventType.MOVE: _CONTACT,
    EventType.UP: _CONTACT,
    EventType.CANCEL: _CONTACT,
    EventType.CLICK: _CONTACT,
    EventType.DOUBLE_CLICK: _CONTACT | {EventType.CLICK},
    EventType.LONG_CLICK: _CONTACT,
    EventType.DRAG_START: _DRAGGING,
    EventType.DRAG: _DRAGGING,
    EventType.DRAG_END: _DRAGGING,
    EventType.FLING: _DRAGGING,
    EventType.FORCE_ENTER: _PRESSING,
    EventType.FORCE_CHANGE: _PRESSING,
    EventType.FORCE_EXIT: _PRESSING,
}


@dataclass(frozen=True, slots=True)
class Subscription:
    """A client's filters; None stands for everything.

    `types` already hold what they bring along (`BRINGS`). `surfaces` decide on a contact by the place of its DOWN, and on a pointer
    by the first of its events that lies on one of them. `max_rate_hz` bounds batches without edges, 0 is every frame.
    """

    types: frozenset[EventType] | None = None
    fingers: frozenset[Finger] | None = None
    hands: frozenset[Handedness] | None = None
    surfaces: frozenset[Surface] | None = None
    max_rate_hz: float = 0.0
    latest_only: bool = False
    status: bool = False
    late_edges: bool = False
    landmarks: bool = False

    @classmethod
    def from_proto(cls, message: pb.Subscribe) -> Subscription:
        """The filters in a message; numbers that a newer schema may have are left out. `ProtocolError` for an impossible rate."""
        rate = message.max_rate_hz
        if not isfinite(rate) or rate < 0:
            raise ProtocolError(f"max_rate_hz is {rate}", hint="Give 0 for every frame, or batches per second")
        types = _members(message.types, enums.EVENT_TYPES)
        return cls(
            None if types is None else types.union(*(BRINGS[event_type] for event_type in types)),
            _members(message.fingers, enums.FINGERS),
            _members(message.hands, enums.HANDEDNESS),
            _members(message.surfaces, enums.SURFACES),
            rate,
            message.latest_only,
            message.status,
            message.late_edges,
            message.landmarks,
        )

    def wants_type(self, event_type: EventType) -> bool:
        """True when events of this type are asked for or brought along."""
        return self.types is None or event_type in self.types

    def wants_place(self, event: TouchEvent) -> bool:
        """True when finger, hand and surface of the event are asked for."""
        return (
            (self.fingers is None or event.finger in self.fingers)
            and (self.hands is None or event.hand in self.hands)
            and (self.surfaces is None or event.surface in self.surfaces)
        )


def _members(numbers: Iterable[int], table: enums.EnumTable[E]) -> frozenset[E] | None:
    listed = list(numbers)
    return frozenset(member for number in listed if (member := table.get(number))) if listed else None
