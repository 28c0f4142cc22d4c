"""What is republished, and what becomes of touches while nobody can be reached."""

from __future__ import annotations

import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.nats_publisher import NatsAddress
from egotouch_sdk.server.publication import Publication, subject_token
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire import event_from_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.events import make_event

E = EventType
MS = 1_000_000
HOVERS = frozenset({E.HOVER_ENTER, E.HOVER_MOVE, E.HOVER_EXIT})


class PublishedFinger:
    """A finger whose events are republished, on a clock that the test turns."""

    def __init__(self) -> None:
        self.publication = Publication("lab")
        self.now_ns = 1000 * MS
        self.contact_id = 0
        self.reasons: list[CancelReason | None] = []

    def do(self, *types: EventType, after_ms: int = 33) -> None:
        self.now_ns += after_ms * MS
        self.contact_id += E.DOWN in types
        events = tuple(
            make_event(kind, self.now_ns, pointer_id=1, contact_id=self.contact_id, down_time_ns=None if kind in HOVERS else self.now_ns)
            for kind in types
        )
        self.publication.offer(Batch(1, self.now_ns, self.now_ns, 0, events))

    def back(self, after_ms: int = 0) -> None:
        self.now_ns += after_ms * MS
        self.publication.connect(self.now_ns)

    def sent(self, *, confirmed: bool = True) -> list[EventType]:
        events = [event_from_proto(pb.TouchEvent.FromString(data)) for _, data in self.publication.take(self.now_ns)]
        self.reasons = [event.reason for event in events]
        if confirmed:
            self.publication.confirm()
        return [event.type for event in events]


@pytest.fixture
def finger() -> PublishedFinger:
    finger = PublishedFinger()
    finger.back()
    finger.do(E.HOVER_ENTER)
    finger.do(E.DOWN)
    assert finger.sent() == [E.HOVER_ENTER, E.DOWN]
    return finger


def test_a_short_break_in_a_touch_cancels_it_and_the_next_touch_counts(finger: PublishedFinger) -> None:
    finger.publication.disconnect()
    finger.do(E.MOVE)
    finger.back()
    assert finger.sent() == [E.CANCEL] and finger.reasons == [CancelReason.DISCONNECTED]
    finger.do(E.UP, E.CLICK)
    finger.do(E.DOWN)
    finger.do(E.UP, E.CLICK)
    assert finger.sent() == [E.DOWN, E.UP, E.CLICK]


def test_a_long_break_forgets_touches_but_says_that_the_finger_left(finger: PublishedFinger) -> None:
    finger.publication.disconnect()
    finger.do(E.UP, E.CLICK)
    finger.do(E.DOWN)
    finger.do(E.UP, E.CLICK)
    finger.do(E.HOVER_EXIT)
    finger.do(E.HOVER_ENTER, after_ms=10_000)
    finger.back(after_ms=1_000)
    assert finger.sent() == [E.CANCEL, E.HOVER_EXIT]
    assert finger.publication.counts == {"sent": 4, "too_old": 6, "cancelled": 1}


def test_an_end_that_may_not_have_arrived_is_said_again(finger: PublishedFinger) -> None:
    finger.do(E.UP, E.CLICK)
    finger.do(E.HOVER_EXIT)
    assert finger.sent(confirmed=False) == [E.UP, E.CLICK, E.HOVER_EXIT]
    finger.publication.disconnect()
    finger.back()
    assert finger.sent() == [E.CANCEL, E.HOVER_EXIT]
    finger.publication.disconnect()
    finger.back()
    assert finger.sent() == []


def test_a_slow_link_cancels_what_got_too_old(finger: PublishedFinger) -> None:
    finger.do(E.MOVE)
    finger.do(E.UP, E.CLICK)
    finger.now_ns += 300 * MS
    assert finger.sent() == [E.MOVE, E.CANCEL]


def test_what_waits_is_bounded(finger: PublishedFinger) -> None:
    finger.publication.disconnect()
    for _ in range(10_000):
        finger.do(E.DOWN, E.UP, after_ms=0)
    finger.back(after_ms=1_000)
    assert finger.sent() == [E.CANCEL] and finger.publication.counts["too_old"] == 20_000


@pytest.mark.parametrize(("name", "token"), [("lab-1", "lab-1"), ("a.b c>*", "a_b_c__"), ("", "_"), ("Küche", "K_che")])
def test_a_session_is_one_token(name: str, token: str) -> None:
    assert subject_token(name) == token


@pytest.mark.parametrize("url", ["", "localhost", "http://secret@host", "nats://", "nats://secret@host:99999", "nats://secret@host/x"])
def test_an_address_that_is_none_is_refused_without_showing_it(url: str) -> None:
    with pytest.raises(ConfigError, match="nats://host:4222") as error:
        NatsAddress.parse(url)
    assert "secret" not in str(error.value)
