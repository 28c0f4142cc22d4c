"""The rules that every client keeps, in their shortest form: messages in, callback log out. See README.md."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import floor

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.listeners.touch_listener import METHODS
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from egotouch_sdk.wire import events_from_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

_ENDS_CONTACT = (EventType.UP, EventType.CANCEL)


@dataclass
class HeldPointer:
    """A pointer that is open at the client: its last event, and what its contact has begun."""

    last: TouchEvent
    contact_id: int = 0
    is_dragging: bool = False
    is_pressing: bool = False


@dataclass
class ReferenceClient:
    """Follows one server over any number of connections; `log` is what its app was told, one line for each callback."""

    log: list[str] = field(default_factory=list)
    held: dict[int, HeldPointer] = field(default_factory=dict)
    epoch: int = 0
    offset: int = 0
    is_welcome: bool = False

    def receive(self, message: pb.ServerMessage) -> None:
        """Take one message; raises `ProtocolError`, and tells the app nothing of it, when it is malformed or comes before a Welcome."""
        kind = message.WhichOneof("body")
        if kind == "welcome":
            if not message.welcome.recovered:
                self.cancel_all()
            self.epoch, self.is_welcome = message.welcome.epoch, True
        elif not self.is_welcome:
            raise ProtocolError(f"a {kind} came before the Welcome")
        elif kind == "batch":
            for event in events_from_proto(message.batch.events):
                self._note(event)
                self.log.append(("late " if message.batch.late else "") + log_line(event))
        self.offset = message.offset

    def lose_connection(self) -> None:
        """The link is gone. Within 300 ms a new one may go on where this one stopped."""
        self.is_welcome = False

    def cancel_all(self) -> None:
        """End everything that is open: after 300 ms of silence, and when a Welcome says that nothing was recovered."""
        for pointer in self.held.values():
            self.log += [log_line(event) for event in _endings(pointer)]
        self.held.clear()

    def resume(self) -> pb.Resume:
        """What to say in the next Hello."""
        held = [
            pb.HeldPointer(pointer_id=number, contact_id=pointer.contact_id, dragging=pointer.is_dragging, pressing=pointer.is_pressing)
            for number, pointer in self.held.items()
        ]
        return pb.Resume(epoch=self.epoch, offset=self.offset, held=held)

    def _note(self, event: TouchEvent) -> None:
        if event.type is EventType.HOVER_EXIT:
            self.held.pop(event.pointer_id, None)
            return
        pointer = self.held.setdefault(event.pointer_id, HeldPointer(event))
        pointer.last = event
        if event.type is EventType.DOWN:
            pointer.contact_id, pointer.is_dragging, pointer.is_pressing = event.contact_id, False, False
        elif event.type in _ENDS_CONTACT:
            pointer.contact_id = 0
        elif event.type in (EventType.DRAG_START, EventType.DRAG_END):
            pointer.is_dragging = event.type is EventType.DRAG_START
        elif event.type in (EventType.FORCE_ENTER, EventType.FORCE_EXIT):
            pointer.is_pressing = event.type is EventType.FORCE_ENTER


def _endings(pointer: HeldPointer) -> list[TouchEvent]:
    """What a client tells its app when it ends a pointer by itself: the pointer's last event with another type and reason."""
    end = replace(pointer.last, force_n=0.0, force_sigma_n=None, coalesced=(), click_count=0, type=EventType.MOVE, reason=None)
    kinds = [
        *([EventType.DRAG_END] if pointer.is_dragging else []),
        *([EventType.FORCE_EXIT] if pointer.is_pressing else []),
        EventType.CANCEL,
    ]
    cancelled = [replace(end, type=kind, reason=CancelReason.DISCONNECTED) for kind in kinds] if pointer.contact_id else []
    return [*cancelled, replace(end, type=EventType.HOVER_EXIT, down_time_ns=None)]


def log_line(event: TouchEvent) -> str:
    """One callback: the listener's method, the event's type, pointer/contact, and numbers in whole nanoseconds, µm and mN."""
    return (
        f"{METHODS[event.type]} {event.type} {event.pointer_id}/{event.contact_id} t_ns={event.timestamp_ns}"
        f" x_um={_thousandths(event.x_mm)} y_um={_thousandths(event.y_mm)} force_mn={_thousandths(event.force_n)}"
        f" clicks={event.click_count} reason={event.reason or '-'} merged={len(event.coalesced)}"
    )


def _thousandths(value: float) -> int:
    return floor(value * 1000 + 0.5)
