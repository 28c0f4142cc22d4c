from __future__ import annotations

import logging

import pytest

from egotouch_sdk.listeners import Delivery, ErrorEvent, Listeners
from egotouch_sdk.listeners.delivery import SLOW_MS
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

DOWN, LONG, CLICK, DOUBLE, EXIT = (
    EventType.DOWN,
    EventType.LONG_CLICK,
    EventType.CLICK,
    EventType.DOUBLE_CLICK,
    EventType.HOVER_EXIT,
)


class Desk(Listeners):
    """Listeners without a source, and a clock that only listeners move."""

    def __init__(self) -> None:
        super().__init__()
        self.now_ns = 0
        self.delivery = Delivery(self._registry, lambda: self.now_ns)

    def happens(self, event_type: EventType, **fields: object) -> TouchEvent:
        event = make_event(event_type, **fields)
        self.delivery.deliver(event)
        return event


def throw(event: object) -> None:
    raise ValueError("listener")


def test_a_throwing_listener_is_counted_reported_and_harms_nobody(caplog: pytest.LogCaptureFixture) -> None:
    desk, seen, errors = Desk(), [], []
    desk.onTouchDown(throw)
    desk.onTouchDown(seen.append)
    desk.onError(errors.append)
    event = desk.happens(DOWN)
    desk.happens(DOWN)
    assert len(seen) == desk.delivery.errors == len(errors) == 2
    assert isinstance(errors[0], ErrorEvent)
    assert (str(errors[0].error), errors[0].event) == ("listener", event)
    assert errors[0].site.startswith("onTouchDown of throw (") and "test_delivery.py:" in errors[0].site
    assert [record.levelname for record in caplog.records] == ["ERROR"]


def test_sys_exit_in_a_listener_ends_nothing(caplog: pytest.LogCaptureFixture) -> None:
    desk, seen = Desk(), []

    @desk.onTouchDown
    def leave(event: TouchEvent) -> None:
        raise SystemExit(3)

    desk.onTouchDown(seen.append)
    desk.happens(DOWN)
    assert (len(seen), desk.delivery.errors) == (1, 1)


def test_an_on_error_that_throws_is_not_told_about_itself(caplog: pytest.LogCaptureFixture) -> None:
    desk, seen = Desk(), []
    desk.onTouchDown(throw)
    desk.onError(throw)
    desk.onError(seen.append)
    desk.happens(DOWN)
    assert desk.delivery.errors == 2
    assert len(seen) == 1
    assert len(caplog.records) == 2


def test_a_slow_listener_is_named_once(caplog: pytest.LogCaptureFixture) -> None:
    desk = Desk()

    @desk.onTouchDown
    def slow(event: TouchEvent) -> None:
        desk.now_ns += round(SLOW_MS * 1e6) + 1

    @desk.onTouchDown
    def fast_enough(event: TouchEvent) -> None:
        desk.now_ns += round(SLOW_MS * 1e6)

    with caplog.at_level(logging.WARNING):
        desk.happens(DOWN)
        desk.happens(DOWN)
    assert [("slow" in record.message, "fast_enough" in record.message) for record in caplog.records] == [(True, False)]


def clicks_after(*results: object) -> list[tuple[EventType, int]]:
    """The clicks that are delivered after a long click of contact 1 whose listeners returned `results`."""
    desk, seen = Desk(), []
    for result in results:
        desk.onLongClick(lambda event, result=result: result)
    desk.onClick(lambda event: seen.append((event.type, event.contact_id)))
    desk.onDoubleClick(lambda event: seen.append((event.type, event.contact_id)))
    desk.happens(LONG)
    desk.happens(CLICK)
    desk.happens(DOUBLE)
    desk.happens(CLICK, contact_id=2)
    return seen


EVERY_CLICK = [(CLICK, 1), (DOUBLE, 1), (CLICK, 2)]


@pytest.mark.parametrize("results", [(), (None,), (False,), (1, "yes")])
def test_a_long_click_that_is_not_consumed_is_also_a_click(results: tuple[object, ...]) -> None:
    assert clicks_after(*results) == EVERY_CLICK


@pytest.mark.parametrize("results", [(True,), (False, True), (True, False)])
def test_true_consumes_this_contacts_clicks_for_everybody(results: tuple[object, ...]) -> None:
    assert clicks_after(*results) == [(CLICK, 2)]


def test_a_consumed_contact_is_forgotten_when_its_pointer_leaves() -> None:
    desk, seen = Desk(), []
    desk.onLongClick(lambda event: True)
    desk.onClick(seen.append)
    desk.happens(LONG)
    desk.happens(EXIT)
    desk.happens(CLICK)
    assert len(seen) == 1
