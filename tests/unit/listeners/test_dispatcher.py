"""Real threads; they wait for each other, never for time to pass."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from egotouch_sdk.listeners import Dispatcher, Item
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

PATIENCE_S = 30.0


class Slow:
    """Takes items, and holds on to the first DOWN until it is let go."""

    def __init__(self) -> None:
        self.items: list[Item] = []
        self.threads: set[int] = set()
        self.began, self.go_on = threading.Event(), threading.Event()

    def __call__(self, item: Item) -> None:
        self.threads.add(threading.get_ident())
        self.items.append(item)
        if isinstance(item, TouchEvent) and item.type is EventType.DOWN:
            self.began.set()
            assert self.go_on.wait(PATIENCE_S)

    @property
    def shown(self) -> list[str]:
        return [f"{item.type}@{item.timestamp_ns}" for item in self.items if isinstance(item, TouchEvent)]


@contextmanager
def held_up() -> Iterator[tuple[Slow, Dispatcher]]:
    """A dispatcher whose listener hangs in a DOWN for the block; afterwards all is delivered."""
    slow = Slow()
    dispatcher = Dispatcher(slow)
    dispatcher.start()
    dispatcher.post([make_event(EventType.DOWN, 1)])
    assert slow.began.wait(PATIENCE_S)
    yield slow, dispatcher
    slow.go_on.set()
    dispatcher.stop()


def test_a_slow_listener_gets_merged_moves_and_every_edge_in_order() -> None:
    with held_up() as (slow, dispatcher):
        for timestamp_ns in range(2, 10):
            dispatcher.post([make_event(EventType.MOVE, timestamp_ns)])
        dispatcher.post([make_event(EventType.UP, 10), make_event(EventType.CLICK, 10)])
        assert slow.shown == ["down@1"]
    assert slow.shown == ["down@1", "move@9", "up@10", "click@10"]
    assert dispatcher.merged == 7
    assert len(slow.threads) == 1
    assert threading.get_ident() not in slow.threads


def test_stop_delivers_what_is_queued_and_later_items_are_ignored() -> None:
    with held_up() as (slow, dispatcher):
        dispatcher.post([make_event(EventType.UP, 2)])
    dispatcher.post([make_event(EventType.DOWN, 3)])
    dispatcher.stop()
    assert slow.shown == ["down@1", "up@2"]


def test_items_posted_before_the_start_are_not_lost() -> None:
    items: list[Item] = []
    dispatcher = Dispatcher(items.append)
    dispatcher.post([make_event(EventType.DOWN, 1)])
    dispatcher.start()
    dispatcher.stop()
    assert len(items) == 1


def test_a_listener_may_stop_its_own_dispatcher() -> None:
    stopped = threading.Event()

    def stop(item: Item) -> None:
        dispatcher.stop()
        stopped.set()

    dispatcher = Dispatcher(stop)
    dispatcher.start()
    dispatcher.post([make_event(EventType.DOWN)])
    assert stopped.wait(PATIENCE_S)
    dispatcher.stop()


def test_flush_waits_for_the_listener() -> None:
    slow = Slow()
    slow.go_on.set()
    dispatcher = Dispatcher(slow)
    dispatcher.start()
    for timestamp_ns in range(100):
        dispatcher.post([make_event(EventType.MOVE, timestamp_ns)])
        dispatcher.flush()
    assert len(slow.items) == 100
    assert dispatcher.merged == 0
    dispatcher.stop()


def test_a_listener_that_never_returns_is_reported_once(caplog: pytest.LogCaptureFixture) -> None:
    with held_up() as (_, dispatcher), caplog.at_level(logging.ERROR):
        for timestamp_ns in range(2, 1100):
            dispatcher.post([make_event(EventType.UP, timestamp_ns)])
    assert ["does not return" in record.message for record in caplog.records] == [True]
