"""Any mixture of touches, stalls, cuts and restarts leaves every client with a stream that makes sense."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.server import CloseCode, Limits, Session
from egotouch_sdk.server.access import TokenAccess
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.subprotocol import SUBPROTOCOLS
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.served import LinkedClient, ServedFinger, ServedWorld

SMALL = Limits(outbox_messages=30, journal_edges=40)
ACTS = {EventType.DOWN, EventType.CLICK, EventType.DOUBLE_CLICK, EventType.LONG_CLICK, EventType.FLING, EventType.DRAG_START}


class Scene:
    """Two fingers, one app that must never act late, and one log that must miss nothing."""

    def __init__(self) -> None:
        self.world = ServedWorld(limits=SMALL)
        self.app, self.log = self.world.join(), self.world.join(late_edges=True)
        self.fingers = [ServedFinger(self.world, 1), ServedFinger(self.world, 2)]
        self.near = [False, False]
        self.epoch = 7
        self.next_pointer_id = 3

    def touch(self, index: int) -> None:
        """The next sensible thing that this finger can begin or end."""
        finger = self.fingers[index]
        if not self.near[index]:
            finger.pointer_id, self.next_pointer_id = self.next_pointer_id, self.next_pointer_id + 1
            finger.contact_id, finger.down_ns = 0, None
            finger.enter()
            self.near[index] = True
        elif finger.down_ns is None:
            finger.press()
        else:
            finger.lift()
            finger.down_ns = None

    def move(self, index: int) -> None:
        finger = self.fingers[index]
        if finger.down_ns is not None:
            finger.move(2)
        elif self.near[index]:
            finger.hover(2)

    def drag(self, index: int) -> None:
        finger = self.fingers[index]
        if finger.down_ns is not None and not finger.is_dragging:
            finger.start_drag()

    def lose(self, index: int) -> None:
        finger = self.fingers[index]
        if finger.down_ns is not None:
            finger.lose()
            finger.down_ns = None
        if self.near[index]:
            finger.leave()
            self.near[index] = False

    def stall(self, client: LinkedClient) -> None:
        client.stalled = not client.stalled
        client.pump()

    def cut(self, client: LinkedClient) -> None:
        if client.session is None or client.session.close is not None:
            client.cut()
            client.stalled = False
            client.reconnect()
        else:
            client.cut()

    def restart(self) -> None:
        for index in (0, 1):
            self.lose(index)
        self.epoch += 1
        self.world.restart(self.epoch)

    def steps(self) -> list[Callable[[], None]]:
        both = [self.app, self.log]
        per_finger = [lambda i=i, act=act: act(i) for act in (self.touch, self.touch, self.move, self.drag, self.lose) for i in (0, 1)]
        per_client = [lambda c=c, act=act: act(c) for act in (self.stall, self.cut, self.cut, LinkedClient.read_one) for c in both]
        return [*per_finger, *per_client, lambda: self.world.wait(90), lambda: self.world.wait(600), self.restart]

    def settle(self) -> None:
        """Everything comes to rest: links are up, fingers are gone."""
        for client in (self.app, self.log):
            client.resume_reading()
            if client.session is None or client.session.close is not None:
                self.cut(client)
                if client.session is None:
                    self.cut(client)
        for index in (0, 1):
            self.lose(index)


@settings(max_examples=300, deadline=None)
@given(st.lists(st.integers(0, 20), max_size=60))
def test_nothing_is_stuck_late_lost_or_doubled(program: list[int]) -> None:
    scene = Scene()
    steps = scene.steps()
    for step in program:
        steps[step]()
    scene.settle()
    assert scene.app.model.held == scene.log.model.held == {}
    assert all(age_ns <= SMALL.input_ttl_ns for event_type, age_ns in scene.app.ages if event_type in ACTS)
    acted = [(event.type, event.pointer_id, event.contact_id) for event in scene.app.model.acted if event.type in ACTS]
    assert len(set(acted)) == len(acted)
    if all(welcome.recovered for welcome in scene.log.model.welcomes[1:]):
        heard = [(e.type, e.pointer_id, e.contact_id) for e in scene.log.model.heard if e.type.is_edge]
        assert heard == [(e.type, e.pointer_id, e.contact_id) for e in scene.world.edges]


MESSAGES = st.one_of(
    st.binary(max_size=60),
    st.builds(
        lambda token, rate: pb.ClientMessage(hello=pb.Hello(token=token, subscribe=pb.Subscribe(max_rate_hz=rate))).SerializeToString(),
        st.text(max_size=8),
        st.floats(width=32),
    ),
    st.builds(lambda kind: pb.ClientMessage(subscribe=pb.Subscribe(types=[kind])).SerializeToString(), st.integers(-5, 300)),
    st.just(pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=1)).SerializeToString()),
    st.text(max_size=60),
)


@settings(max_examples=500, deadline=None)
@given(st.sampled_from(sorted(SUBPROTOCOLS)), st.booleans(), st.lists(MESSAGES, max_size=20))
def test_whatever_comes_only_documented_codes_close(subprotocol: str, needs_token: bool, messages: list[bytes | str]) -> None:
    access = TokenAccess("0" * 32) if needs_token else None
    session = Session(Journal(1), SUBPROTOCOLS[subprotocol], 0, access=access)
    for time_ns, message in enumerate(messages):
        session.receive(message, time_ns)
        while session.next_message(time_ns) is not None:
            pass
    assert session.close is None or session.close.code in {
        CloseCode.MALFORMED, CloseCode.WRONG_ORDER, CloseCode.WRONG_TOKEN, CloseCode.TOO_MANY_COMMANDS
    }  # fmt: skip
