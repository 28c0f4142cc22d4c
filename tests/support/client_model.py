"""What a client library does with the server's messages: the contract that every client keeps, in its shortest form."""

from __future__ import annotations

from dataclasses import dataclass, field

from egotouch_sdk.touch_event import EventType, TouchEvent
from egotouch_sdk.wire import events_from_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

_TRACKS = {EventType.DRAG_START: ("dragging", True), EventType.DRAG_END: ("dragging", False)}
_TRACKS |= {EventType.FORCE_ENTER: ("pressing", True), EventType.FORCE_EXIT: ("pressing", False)}
_AFTER_A_LIFT = {EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING}


@dataclass
class Held:
    """A pointer that is open at the client."""

    contact_id: int = 0
    lifted_id: int = 0
    dragging: bool = False
    pressing: bool = False


@dataclass
class ClientModel:
    """Follows one server through any number of connections and checks that what it hears makes sense.

    `acted` are the events an app would see, `late` those it must not act upon, `heard` both in their order. `local_cancels` counts the
    contacts that the client ended by itself.
    """

    epoch: int = 0
    offset: int = 0
    welcomes: list[pb.Welcome] = field(default_factory=list)
    acted: list[TouchEvent] = field(default_factory=list)
    late: list[TouchEvent] = field(default_factory=list)
    heard: list[TouchEvent] = field(default_factory=list)
    held: dict[int, Held] = field(default_factory=dict)
    local_cancels: int = 0
    others: list[pb.ServerMessage] = field(default_factory=list)

    def hello(self, *, resume: bool = True, **fields: object) -> pb.ClientMessage:
        """The first message; after an earlier connection it asks to go on."""
        message = pb.ClientMessage(hello=pb.Hello(client="test", **fields))  # type: ignore[arg-type]
        if resume and self.welcomes:
            message.hello.resume.epoch, message.hello.resume.offset = self.epoch, self.offset
            for pointer_id, held in self.held.items():
                message.hello.resume.held.add(
                    pointer_id=pointer_id, contact_id=held.contact_id, dragging=held.dragging, pressing=held.pressing
                )
        return message

    def take(self, message: pb.ServerMessage) -> None:
        """Take one message in; `AssertionError` when it breaks the contract."""
        kind = message.WhichOneof("body")
        if kind == "welcome":
            self._welcome(message)
            return
        assert self.welcomes, f"a {kind} came before the Welcome"
        assert message.offset >= self.offset, f"the offset goes back from {self.offset} to {message.offset}"
        self.offset = message.offset
        if kind != "batch":
            self.others.append(message)
            return
        events = events_from_proto(message.batch.events)
        assert events, "an empty batch came"
        for event in events:
            self._step(event)
        self.heard += events
        (self.late if message.batch.late else self.acted).extend(events)

    def disconnect(self, *, silent_for_ms: float = 0.0) -> None:
        """The link is gone; after 300 ms of silence every contact is over."""
        if silent_for_ms > 300:
            self.cancel_all()

    def cancel_all(self) -> None:
        """End everything that is open."""
        self.local_cancels += sum(held.contact_id > 0 for held in self.held.values())
        self.held.clear()

    def take_types(self) -> list[EventType]:
        """Types of the events an app saw since the last call."""
        types = [event.type for event in self.acted]
        self.acted.clear()
        return types

    @property
    def contacts(self) -> set[tuple[int, int]]:
        """Pointer and contact of everything that is down at the client."""
        return {(pointer_id, held.contact_id) for pointer_id, held in self.held.items() if held.contact_id}

    def _welcome(self, message: pb.ServerMessage) -> None:
        welcome = message.welcome
        if welcome.recovered:
            assert welcome.epoch == self.epoch and message.offset == self.offset
        else:
            self.cancel_all()
        self.epoch, self.offset = welcome.epoch, message.offset
        self.welcomes.append(welcome)

    def _step(self, event: TouchEvent) -> None:
        held = self.held.get(event.pointer_id)
        if event.type is EventType.HOVER_ENTER:
            assert held is None, f"a second {event}"
            self.held[event.pointer_id] = Held()
            return
        assert held is not None, f"pointer {event.pointer_id} was never opened: {event}"
        if event.type is EventType.HOVER_EXIT:
            assert not held.contact_id, f"left while down: {event}"
            del self.held[event.pointer_id]
        elif event.type is EventType.HOVER_MOVE:
            assert not held.contact_id, f"hovers while down: {event}"
        elif event.type is EventType.DOWN:
            assert not held.contact_id, f"a second {event}"
            held.contact_id, held.dragging, held.pressing = event.contact_id, False, False
        elif event.type in _AFTER_A_LIFT:
            assert not held.contact_id and held.lifted_id == event.contact_id, f"without its lift: {event}"
        else:
            self._step_contact(held, event)

    def _step_contact(self, held: Held, event: TouchEvent) -> None:
        assert held.contact_id == event.contact_id, f"contact {event.contact_id} is not down: {event}"
        if event.type in _TRACKS:
            track, begins = _TRACKS[event.type]
            assert getattr(held, track) is not begins, f"out of turn: {event}"
            setattr(held, track, begins)
        elif event.type is EventType.DRAG:
            assert held.dragging, f"without its start: {event}"
        elif event.type is EventType.FORCE_CHANGE:
            assert held.pressing, f"without its start: {event}"
        elif event.type in {EventType.UP, EventType.CANCEL}:
            assert not held.dragging and not held.pressing, f"left a drag or press open: {event}"
            held.lifted_id = event.contact_id if event.type is EventType.UP else 0
            held.contact_id = 0
