from __future__ import annotations

from typing import Any

import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.joints import Finger
from egotouch_sdk.server import CloseCode, Limits
from egotouch_sdk.server.access import TokenAccess
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.served import MS, ServedFinger, ServedWorld

E = EventType
CLICKED = (E.UP, E.CLICK)


@pytest.fixture
def world() -> ServedWorld:
    return ServedWorld()


@pytest.fixture
def finger(world: ServedWorld) -> ServedFinger:
    return ServedFinger(world)


@pytest.mark.parametrize("subprotocol", ["egotouch.v1.pb", "egotouch.v1.json"])
def test_a_client_hears_a_tap_frame_by_frame(world: ServedWorld, finger: ServedFinger, subprotocol: str) -> None:
    client = world.join(subprotocol)
    finger.enter()
    client.expect(E.HOVER_ENTER)
    finger.press()
    client.expect(E.DOWN)
    finger.move(2)
    client.expect(E.MOVE, E.MOVE)
    finger.lift()
    client.expect(*CLICKED)
    finger.leave()
    client.expect(E.HOVER_EXIT)
    assert client.model.offset == world.journal.offset == 5
    client.expect_nothing()


def test_the_welcome_tells_what_a_client_needs(world: ServedWorld, finger: ServedFinger) -> None:
    finger.enter()
    welcome = world.join().model.welcomes[0]
    assert welcome.epoch == 7 and not welcome.resume_requested and not welcome.recovered
    assert (welcome.heartbeat_ms, welcome.active_heartbeat_ms, welcome.input_ttl_ms) == (2000, 100, 250)
    assert [pointer.type for pointer in welcome.snapshot.pointers] == [pb.EVENT_TYPE_HOVER_ENTER]
    assert welcome.server_now_ns == world.now_ns and {"resume", "late_edges"} <= set(welcome.features) and not welcome.token


def test_nothing_comes_before_the_hello(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.connect()
    finger.enter()
    finger.tap()
    assert client.model.welcomes == []
    client.expect_nothing()


def test_a_client_that_joins_in_the_middle_sees_only_what_begins(world: ServedWorld, finger: ServedFinger) -> None:
    finger.enter()
    finger.press()
    client = world.join()
    assert [pointer.type for pointer in client.model.welcomes[0].snapshot.pointers] == [pb.EVENT_TYPE_DOWN]
    finger.move(2)
    finger.lift()
    client.expect_nothing()
    finger.hover()
    client.expect(E.HOVER_ENTER)
    finger.tap()
    client.expect(E.DOWN, *CLICKED)


# ------------------------------------------------------------------------------------------------------------ coming back


def test_five_resumes_in_a_row_lose_and_double_nothing(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(late_edges=True)
    finger.enter()
    for _ in range(5):
        finger.press()
        client.cut()
        finger.move(3)
        finger.lift()
        assert client.reconnect()
    assert [event.type for event in client.model.heard if event.type.is_edge] == [event.type for event in world.edges]
    assert client.model.contacts == set()


def test_resume_with_no_event_ever(world: ServedWorld) -> None:
    client = world.join()
    client.cut()
    world.wait(50)
    assert client.reconnect()
    client.expect_nothing()


def test_resume_on_a_quiet_link_after_eleven_minutes(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.tap()
    finger.leave()
    world.wait(11 * 60 * 1000)
    client.cut()
    client.model.take_types()
    assert client.reconnect()
    client.expect_nothing()


def test_a_client_that_hears_only_heartbeats_can_resume(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(fingers=[pb.FINGER_PINKY])
    finger.enter()
    for _ in range(600):
        finger.tap()
    world.wait(2100)
    client.cut()
    assert client.reconnect()
    client.expect_nothing()


@pytest.mark.parametrize("read", range(8))
def test_a_cut_in_the_middle_of_a_backlog(world: ServedWorld, finger: ServedFinger, read: int) -> None:
    client = world.join(late_edges=True)
    client.stalled = True
    finger.enter()
    finger.tap()
    finger.press()
    finger.move(2)
    finger.lift()
    for _ in range(read):
        client.read_one()
    client.cut()
    client.stalled = False
    assert client.reconnect()
    assert [event.type for event in client.model.heard if event.type.is_edge] == [event.type for event in world.edges]


def test_a_log_gets_a_replayed_click_in_its_frame_and_marked(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(late_edges=True)
    finger.enter()
    finger.press()
    client.cut()
    finger.lift()
    assert client.reconnect()
    client.expect(E.HOVER_ENTER, E.DOWN)
    assert [event.type for event in client.model.late] == [*CLICKED]


def test_a_short_cut_goes_unnoticed(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    client.cut()
    finger.move(2)
    assert client.reconnect()
    finger.lift()
    client.expect(E.HOVER_ENTER, E.DOWN, *CLICKED)


def test_a_click_is_never_replayed(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    client.cut()
    finger.lift()
    assert client.reconnect()
    client.expect(E.HOVER_ENTER, E.DOWN, E.UP)


def test_a_late_lift_cancels(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    finger.start_drag()
    client.cut()
    finger.lift()
    world.wait(251)
    assert client.reconnect()
    client.expect(E.HOVER_ENTER, E.DOWN, E.MOVE, E.DRAG_START, E.DRAG_END, E.CANCEL)
    assert client.model.contacts == set()


def test_a_press_that_was_missed_long_ago_never_acts(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    client.cut()
    finger.press()
    world.wait(260)
    assert client.reconnect()
    finger.move(2)
    finger.lift()
    client.expect(E.HOVER_ENTER)
    finger.hover()
    finger.tap()
    client.expect(E.HOVER_MOVE, E.DOWN, *CLICKED)


def test_a_log_gets_late_edges_marked(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(late_edges=True)
    finger.enter()
    client.cut()
    finger.press()
    world.wait(260)
    assert client.reconnect()
    finger.lift()
    client.expect(E.HOVER_ENTER)
    assert [event.type for event in client.model.late] == [E.DOWN, *CLICKED]


def test_another_run_of_the_server_cancels_everything(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    world.restart(epoch=8)
    assert not client.reconnect()
    assert client.model.local_cancels == 1 and client.model.contacts == set()
    assert client.model.epoch == 8 and client.model.offset == 0


@pytest.mark.parametrize(("taps", "wait_ms", "recovered"), [(3, 0, True), (200, 0, False), (3, 10_100, False)])
def test_a_gap_is_filled_wholly_or_not_at_all(
    world: ServedWorld, finger: ServedFinger, taps: int, wait_ms: float, recovered: bool
) -> None:
    client = world.join()
    finger.enter()
    client.cut()
    for _ in range(taps):
        finger.tap()
    world.wait(wait_ms)
    assert client.reconnect() is recovered


def test_an_offset_from_the_future_is_not_recovered(world: ServedWorld) -> None:
    client = world.connect()
    client.send(pb.ClientMessage(hello=pb.Hello(resume=pb.Resume(epoch=7, offset=5))))
    assert not client.model.welcomes[0].recovered


def test_a_contact_that_nobody_knows_is_not_recovered(world: ServedWorld) -> None:
    client = world.connect()
    client.send(pb.ClientMessage(hello=pb.Hello(resume=pb.Resume(epoch=7, offset=0, held=[pb.HeldPointer(pointer_id=4, contact_id=2)]))))
    assert not client.model.welcomes[0].recovered


# ------------------------------------------------------------------------------------------------------------ slow clients


def test_moves_merge_while_a_client_stalls_and_edges_do_not(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    client.expect(E.HOVER_ENTER, E.DOWN)
    client.stalled = True
    finger.move(3)
    finger.lift()
    client.resume_reading()
    merged = client.model.acted[0]
    assert len(merged.coalesced) == 2
    client.expect(E.MOVE, *CLICKED)
    assert client.session is not None and client.session.merged == 2
    assert world.drops.total() == world.drops["move"] == 2


def test_history_is_left_out_on_request(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(latest_only=True)
    finger.enter()
    finger.press()
    client.stalled = True
    finger.move(3)
    client.resume_reading()
    assert [event.coalesced for event in client.model.acted] == [()] * 3


def test_an_edge_that_waited_too_long_cancels_its_contact(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    client.stalled = True
    finger.lift()
    world.wait(300)
    client.resume_reading()
    client.expect(E.HOVER_ENTER, E.DOWN, E.CANCEL)
    assert world.drops.total() == world.drops["late_edge"] == 1
    finger.tap()
    client.expect(E.DOWN, *CLICKED)
    assert world.drops.total() == 1


def test_what_a_finger_does_after_a_late_touch_is_not_late(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(late_edges=True)
    finger.enter()
    client.stalled = True
    finger.tap()
    world.wait(300)
    client.resume_reading()
    client.expect(E.HOVER_ENTER)
    assert [event.type for event in client.model.late] == [E.DOWN, *CLICKED]
    finger.hover()
    finger.tap()
    finger.leave()
    client.expect(E.HOVER_MOVE, E.DOWN, *CLICKED, E.HOVER_EXIT)


def test_a_touch_that_waited_too_long_is_left_out_as_a_whole(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    client.stalled = True
    finger.tap()
    world.wait(300)
    client.resume_reading()
    client.expect(E.HOVER_ENTER)
    assert world.drops.total() == world.drops["late_edge"] == 1


def test_a_status_is_left_out_while_something_waits(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(status=True)
    assert client.session is not None
    for hands_in_view in (1, 2):
        client.session.offer_status(pb.Status(hands_in_view=hands_in_view))
    client.pump()
    assert [message.status.hands_in_view for message in client.model.others if message.HasField("status")] == [1]
    assert world.drops.total() == world.drops["status"] == 1


def test_a_client_that_reads_nothing_is_closed(world: ServedWorld, finger: ServedFinger) -> None:
    client, other = world.join(), world.join()
    finger.enter()
    client.stalled = True
    world.wait(4900)
    client.expect_open()
    world.wait(200)
    client.expect_closed(CloseCode.TOO_SLOW)
    other.expect_open()


@pytest.mark.parametrize("limits", [Limits(outbox_messages=20), Limits(outbox_bytes=5000)])
def test_a_client_with_too_many_edges_waiting_is_closed(limits: Limits) -> None:
    world = ServedWorld(limits=limits)
    finger = ServedFinger(world)
    client = world.join()
    finger.enter()
    client.stalled = True
    for _ in range(8):
        finger.tap()
    client.expect_open()
    for _ in range(8):
        finger.tap()
    client.expect_closed(CloseCode.TOO_SLOW)
    assert CloseCode.TOO_SLOW.reconnect


def test_a_rate_holds_moves_back_but_no_edge(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(max_rate_hz=10)
    finger.enter()
    finger.press()
    finger.move(9)
    finger.lift()
    types = client.model.take_types()
    assert [event_type for event_type in types if event_type.is_edge] == [E.HOVER_ENTER, E.DOWN, *CLICKED]
    assert 3 <= types.count(E.MOVE) <= 4


def test_a_slow_rate_does_not_silence_the_heartbeat(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(max_rate_hz=1)
    finger.enter()
    finger.press()
    before = len(client.model.others)
    finger.move(15)
    beats = [message for message in client.model.others[before:] if message.HasField("heartbeat")]
    assert len(beats) >= 3


# ------------------------------------------------------------------------------------------------------------ filters


def test_a_client_of_one_finger_hears_no_other(world: ServedWorld) -> None:
    index, ring = ServedFinger(world, 1, finger=Finger.INDEX), ServedFinger(world, 2, finger=Finger.RING)
    client = world.join(fingers=[pb.FINGER_RING])
    for finger in (index, ring):
        finger.enter()
        finger.tap()
        finger.leave()
    client.expect(E.HOVER_ENTER, E.DOWN, *CLICKED, E.HOVER_EXIT)
    assert client.model.offset == world.journal.offset


def test_asking_for_clicks_brings_what_clicks_lie_in(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(types=[pb.EVENT_TYPE_CLICK])
    finger.enter()
    finger.hover(2)
    finger.press()
    finger.move(3)
    finger.lift()
    finger.press()
    finger.start_drag()
    finger.lift()
    finger.leave()
    client.expect(E.HOVER_ENTER, E.DOWN, *CLICKED, E.DOWN, E.UP, E.HOVER_EXIT)


def test_a_contact_belongs_to_the_surface_where_it_began(world: ServedWorld) -> None:
    finger = ServedFinger(world, surface=Surface.BACK_OF_HAND)
    client = world.join(surfaces=[pb.SURFACE_PALM])
    finger.enter()
    finger.tap()
    client.expect_nothing()
    finger.fields["surface"] = Surface.PALM
    finger.press()
    client.expect(E.HOVER_ENTER, E.DOWN)
    finger.fields["surface"] = Surface.BACK_OF_HAND
    finger.move()
    finger.lift()
    finger.hover()
    finger.leave()
    client.expect(E.MOVE, *CLICKED, E.HOVER_EXIT)


def test_a_new_subscription_ends_nothing_and_begins_nothing_in_the_middle(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join(types=[pb.EVENT_TYPE_CLICK])
    finger.enter()
    finger.press()
    finger.start_drag()
    client.send(pb.ClientMessage(subscribe=pb.Subscribe()))
    finger.move()
    client.send(pb.ClientMessage(subscribe=pb.Subscribe(fingers=[pb.FINGER_PINKY])))
    finger.lift()
    finger.tap()
    finger.leave()
    client.expect(E.HOVER_ENTER, E.DOWN, E.MOVE, E.UP, E.HOVER_EXIT)


# ------------------------------------------------------------------------------------------------------------ keeping in touch


def test_heartbeats_are_slow_when_idle_and_fast_while_touching(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    world.wait(6100)
    assert [message.WhichOneof("body") for message in client.model.others] == ["heartbeat"] * 3
    finger.enter()
    finger.press()
    client.model.others.clear()
    world.wait(1000)
    assert 8 <= len(client.model.others) <= 10
    assert {message.heartbeat.active_contacts for message in client.model.others} == {1}


def test_the_clock_reply_has_all_its_times(world: ServedWorld) -> None:
    client = world.join()
    client.stalled = True
    received_ns = world.now_ns
    client.send(pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=-5)))
    world.now_ns += 3 * MS
    client.resume_reading()
    reply = client.model.others[-1].clock_reply
    assert (reply.client_send_ns, reply.server_receive_ns, reply.server_send_ns) == (-5, received_ns, received_ns + 3 * MS)


def test_a_tracker_that_loses_the_finger_cancels(world: ServedWorld, finger: ServedFinger) -> None:
    client = world.join()
    finger.enter()
    finger.press()
    finger.lose()
    finger.leave()
    assert client.model.acted[2].reason is CancelReason.TRACKING_LOST
    client.expect(E.HOVER_ENTER, E.DOWN, E.CANCEL, E.HOVER_EXIT)


# ------------------------------------------------------------------------------------------------------------ bad clients


def test_a_missing_hello_is_noticed(world: ServedWorld) -> None:
    client = world.connect()
    world.wait(4900)
    client.expect_open()
    world.wait(200)
    client.expect_closed(CloseCode.HELLO_TIMEOUT)


@pytest.mark.parametrize("fields", [{}, {"subscribe": pb.Subscribe()}, {"frame": pb.ClientFrame()}, {"clock_request": pb.ClockRequest()}])
def test_the_hello_comes_first(world: ServedWorld, fields: dict[str, Any]) -> None:
    client = world.connect()
    client.send(pb.ClientMessage(**fields))
    client.expect_closed(CloseCode.WRONG_ORDER)


def test_a_second_hello_is_one_too_many(world: ServedWorld) -> None:
    client = world.join()
    client.say_hello()
    client.expect_closed(CloseCode.WRONG_ORDER)


@pytest.mark.parametrize(
    ("subprotocol", "data"),
    [
        ("egotouch.v1.pb", b"\xff\xff\xff"),
        ("egotouch.v1.pb", "{}"),
        ("egotouch.v1.json", "{"),
        ("egotouch.v1.json", b"{}"),
        ("egotouch.v1.json", "[" * 100_000),
        ("egotouch.v1.json", '{"hello": {"token": 5}}'),
        ("egotouch.v1.json", '{"hello": {"subscribe": {"max_rate_hz": -1}}}'),
        ("egotouch.v1.json", '{"hello": {"subscribe": {"max_rate_hz": "NaN"}}}'),
    ],
)
def test_a_malformed_message_closes_only_its_connection(world: ServedWorld, subprotocol: str, data: bytes | str) -> None:
    client, other = world.connect(subprotocol), world.join()
    client.send_raw(data)
    client.expect_closed(CloseCode.MALFORMED)
    other.expect_open()


def test_a_huge_message_is_refused(world: ServedWorld) -> None:
    client = world.join()
    client.send_raw(b"\x00" * ((1 << 20) + 1))
    client.expect_closed(CloseCode.TOO_LARGE)


def test_a_newer_client_is_told_what_it_cannot_have(world: ServedWorld) -> None:
    client = world.connect()
    client.say_hello(protocol_minor=9)
    client.send_raw(b"\xf2\x06\x00")
    assert [message.warning.code for message in client.model.others] == ["older_server", "unknown_message"]
    client.expect_open()


def test_too_many_commands_close(world: ServedWorld) -> None:
    client = world.join()
    for _ in range(20):
        client.send(pb.ClientMessage(heartbeat=pb.Heartbeat()))
        world.wait(50)
    client.expect_open()
    for _ in range(60):
        client.send(pb.ClientMessage(heartbeat=pb.Heartbeat()))
    client.expect_closed(CloseCode.TOO_MANY_COMMANDS)


class PushedFrames:
    """Takes pictures from clients."""

    kinds = frozenset({"frame"})

    def __init__(self) -> None:
        self.frames: list[object] = []

    def take(self, client: object, pushed: object, now_ns: int) -> tuple[pb.Warning, ...]:
        self.frames.append(pushed)
        return ()

    def leave(self, client: object) -> None:
        self.frames.clear()


def test_pushed_frames_go_to_a_server_that_wants_them(world: ServedWorld) -> None:
    camera = PushedFrames()
    client, refused = world.connect(push=camera), world.join()
    client.say_hello()
    pushed = pb.ClientMessage(frame=pb.ClientFrame(jpeg=b"jpeg", timestamp_ns=3))
    for _ in range(100):
        client.send(pushed)
    refused.send(pushed)
    client.expect_open()
    assert camera.frames == [pushed.frame] * 100
    assert refused.model.others[-1].warning.code == "not_a_source"


# ------------------------------------------------------------------------------------------------------------ who may come in

TOKEN = "0123456789abcdef" * 2


def test_a_token_opens_the_door(world: ServedWorld) -> None:
    access = TokenAccess(TOKEN)
    for token in ("", "0" * 32, TOKEN[:-1]):
        client = world.connect(access=access)
        client.say_hello(token=token)
        client.expect_closed(CloseCode.WRONG_TOKEN)
        assert token not in client.session.close.reason or not token
    client = world.connect(access=access)
    client.say_hello(token=TOKEN)
    client.expect_open()
    assert client.model.welcomes[0].token == ""


def test_a_pairing_code_is_exchanged_once(world: ServedWorld) -> None:
    access = TokenAccess(TOKEN, new_code=lambda: "123456")
    access.offer_code(world.now_ns)
    client = world.connect(access=access)
    client.say_hello(pairing_code="123456")
    assert client.model.welcomes[0].token == TOKEN
    second = world.connect(access=access)
    second.say_hello(pairing_code="123456")
    second.expect_closed(CloseCode.WRONG_TOKEN)


def test_a_pairing_code_survives_four_wrong_tries_and_not_five(world: ServedWorld) -> None:
    for wrong, admitted in ((4, True), (5, False)):
        access = TokenAccess(TOKEN, new_code=lambda: "123456")
        for _ in range(wrong):
            assert not access.admit("", "654321", world.now_ns).admitted
        assert access.admit("", "123456", world.now_ns).admitted is admitted


def test_a_pairing_code_expires_and_a_new_one_is_shown(world: ServedWorld) -> None:
    codes, shown = iter(["111111", "222222"]), []
    access = TokenAccess(TOKEN, new_code=lambda: next(codes), announce=shown.append)
    access.offer_code(world.now_ns)
    later_ns = world.now_ns + 120_000 * MS
    assert not access.admit("", "111111", later_ns).admitted
    assert shown == ["111111", "222222"]
    assert access.admit("", "222222", later_ns).admitted


def test_a_short_token_is_refused() -> None:
    with pytest.raises(ConfigError, match="at least 32"):
        TokenAccess("secret")
