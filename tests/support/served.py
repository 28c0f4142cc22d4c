"""A server without sockets and a clock that tests turn: fingers publish, clients listen, links fail."""

from __future__ import annotations

from collections import Counter
from typing import Any

from egotouch_sdk.joints import Finger
from egotouch_sdk.server import EventHub, Journal, Limits, Session
from egotouch_sdk.server.close_code import CloseCode
from egotouch_sdk.server.subprotocol import SUBPROTOCOLS
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from egotouch_sdk.wire import from_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.client_model import ClientModel
from tests.support.events import make_event

MS = 1_000_000
FRAME_MS = 33
FINGERS = tuple(Finger)


class ServedWorld:
    """One run of a server, with its own time."""

    def __init__(self, epoch: int = 7, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self.now_ns = 1_000_000 * MS
        self.frame = 0
        self.edges: list[TouchEvent] = []
        self.drops: Counter[str] = Counter()
        self.clients: list[LinkedClient] = []
        self.restart(epoch)

    def restart(self, epoch: int) -> None:
        """Kill the server and start it again; every link breaks."""
        for client in self.clients:
            client.cut()
        self.journal = Journal(epoch, self.limits)
        self.hub = EventHub(self.journal)
        self.edges.clear()

    def publish(self, *events: TouchEvent) -> None:
        """One frame with these events."""
        self.frame += 1
        self.edges += (event for event in events if event.type.is_edge)
        self.hub.publish(self.frame, self.now_ns, events, self.now_ns)
        self._pump()

    def wait(self, ms: float) -> None:
        """Let time pass in steps of 20 ms, as the server's own timer does."""
        end_ns = self.now_ns + round(ms * MS)
        while self.now_ns < end_ns:
            self.now_ns = min(self.now_ns + 20 * MS, end_ns)
            for session in self.hub.sessions:
                session.tick(self.now_ns)
            self._pump()

    def connect(self, subprotocol: str = "egotouch.v1.pb", **session: Any) -> LinkedClient:
        """A new client that has not said anything."""
        client = LinkedClient(self, subprotocol, session)
        self.clients.append(client)
        return client

    def join(self, subprotocol: str = "egotouch.v1.pb", **subscribe: Any) -> LinkedClient:
        """A new client that has said Hello with this subscription."""
        client = self.connect(subprotocol)
        client.subscribe = pb.Subscribe(**subscribe)
        client.say_hello()
        return client

    def _pump(self) -> None:
        for client in self.clients:
            client.pump()


class LinkedClient:
    """A client library at the other end of a link that the test can stall and cut; `ages` are those of events as the app got them."""

    def __init__(self, world: ServedWorld, subprotocol: str, session: dict[str, Any]) -> None:
        self.world = world
        self.model = ClientModel()
        self.subscribe = pb.Subscribe()
        self.stalled = False
        self.ages: list[tuple[EventType, int]] = []
        self._spelling = SUBPROTOCOLS[subprotocol]
        self._session_options = {"limits": world.limits, "drops": world.drops} | session
        self.session: Session | None = None
        self.open()

    def open(self) -> None:
        """Connect, without a Hello yet."""
        self.session = Session(self.world.journal, self._spelling, self.world.now_ns, **self._session_options)
        self.world.hub.sessions.add(self.session)

    def say_hello(self, **fields: Any) -> None:
        """The first message, with the client's subscription; asks to go on where an earlier connection ended."""
        self.send(self.model.hello(subscribe=self.subscribe, **fields))

    def reconnect(self) -> bool:
        """Come back after a cut; True when the server had everything that was missed."""
        self.open()
        self.say_hello()
        return self.model.welcomes[-1].recovered

    def cut(self) -> None:
        """Lose the link; what the server had not sent yet is gone with it."""
        if self.session is not None:
            self.world.hub.sessions.discard(self.session)
            self.session = None

    def send(self, message: pb.ClientMessage) -> None:
        """Send one message."""
        from egotouch_sdk.wire import to_json

        assert self.session is not None
        data = to_json(message) if self._spelling.name.endswith("json") else message.SerializeToString()
        self.send_raw(data)

    def send_raw(self, data: bytes | str) -> None:
        """Send anything."""
        assert self.session is not None
        self.session.receive(data, self.world.now_ns)
        self.pump()

    def pump(self) -> None:
        """Read what the server has to say, unless stalled."""
        while not self.stalled and self.read_one():
            pass

    def read_one(self) -> bool:
        """Read one message; False when there is none."""
        data = self.session.next_message(self.world.now_ns) if self.session is not None else None
        if data is None:
            return False
        seen = len(self.model.acted)
        self.model.take(from_json(pb.ServerMessage, data) if isinstance(data, str) else pb.ServerMessage.FromString(data))
        self.ages += ((event.type, self.world.now_ns - event.timestamp_ns) for event in self.model.acted[seen:])
        return True

    def resume_reading(self) -> None:
        """Come out of a stall."""
        self.stalled = False
        self.pump()

    def expect(self, *types: EventType) -> None:
        """Exactly these events reached the app since the last call."""
        assert self.model.take_types() == list(types)

    def expect_nothing(self) -> None:
        """No event reached the app since the last call."""
        self.expect()

    def expect_closed(self, code: CloseCode) -> None:
        """The server closed the connection for this reason."""
        assert self.session is not None and self.session.close is not None, "the connection is open"
        assert self.session.close.code is code, self.session.close

    def expect_open(self) -> None:
        """The connection lives."""
        assert self.session is not None and self.session.close is None, self.session and self.session.close


class ServedFinger:
    """A finger whose events a server publishes; it keeps the grammar."""

    def __init__(self, world: ServedWorld, pointer_id: int = 1, **fields: Any) -> None:
        self.world = world
        self.pointer_id = pointer_id
        self.contact_id = 0
        self.down_ns: int | None = None
        self.is_dragging = False
        self.fields = {"finger": FINGERS[pointer_id % 5]} | fields

    def event(self, event_type: EventType, **fields: Any) -> TouchEvent:
        """An event of this finger now."""
        own = {"pointer_id": self.pointer_id, "contact_id": self.contact_id, **self.fields, **fields}
        if not event_type.is_hover:
            own["down_time_ns"] = self.down_ns
        return make_event(event_type, self.world.now_ns, **own)

    def enter(self) -> None:
        """Come near the skin."""
        self.world.publish(self.event(EventType.HOVER_ENTER))

    def hover(self, frames: int = 1) -> None:
        """Stay near the skin."""
        for _ in range(frames):
            self.world.wait(FRAME_MS)
            self.world.publish(self.event(EventType.HOVER_MOVE))

    def leave(self) -> None:
        """Go away."""
        self.world.publish(self.event(EventType.HOVER_EXIT))

    def press(self) -> None:
        """Touch the skin."""
        self.contact_id += 1
        self.down_ns = self.world.now_ns
        self.world.publish(self.event(EventType.DOWN))

    def move(self, frames: int = 1, **fields: Any) -> None:
        """Stay on the skin for some frames."""
        for _ in range(frames):
            self.world.wait(FRAME_MS)
            moved = [self.event(EventType.MOVE, **fields)]
            if self.is_dragging:
                moved.append(self.event(EventType.DRAG, **fields))
            self.world.publish(*moved)

    def start_drag(self) -> None:
        """Move beyond the slop."""
        self.is_dragging = True
        self.world.publish(self.event(EventType.MOVE), self.event(EventType.DRAG_START))

    def lift(self) -> None:
        """Lift off; a contact that was not dragged clicks."""
        if self.is_dragging:
            events = [self.event(EventType.DRAG_END), self.event(EventType.UP)]
        else:
            events = [self.event(EventType.UP), self.event(EventType.CLICK)]
        self.is_dragging = False
        self.world.publish(*events)

    def lose(self, reason: CancelReason = CancelReason.TRACKING_LOST) -> None:
        """Be lost by the tracker while touching."""
        ends = [self.event(EventType.DRAG_END, reason=reason)] if self.is_dragging else []
        self.is_dragging = False
        self.world.publish(*ends, self.event(EventType.CANCEL, reason=reason))

    def tap(self) -> None:
        """Press and lift."""
        self.press()
        self.lift()
