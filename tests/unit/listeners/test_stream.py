"""Asynchronous consumers; the producer is a thread of its own."""

from __future__ import annotations

import asyncio
import threading

import pytest

from egotouch_sdk.errors import ConfigError, QueueFullError, SourceError
from egotouch_sdk.listeners.stream import EventStream
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

PATIENCE_S = 30.0


async def nothing() -> None:
    """The source runs already."""


def make_stream(types: object = None, capacity: int = 256, overflow: str = "coalesce") -> EventStream:
    return EventStream(types, capacity, overflow, nothing)  # type: ignore[arg-type]


def moves(count: int, first: int = 1) -> list[TouchEvent]:
    return [make_event(EventType.MOVE, timestamp_ns) for timestamp_ns in range(first, first + count)]


async def taken(stream: EventStream) -> list[int]:
    return [event.timestamp_ns async for event in stream]


def test_events_of_another_thread_arrive_in_order_and_end() -> None:
    async def consume() -> list[int]:
        stream = make_stream()

        def produce() -> None:
            for event in moves(100):
                stream.push([event])
            stream.end()

        thread = threading.Thread(target=produce)
        thread.start()
        times = await asyncio.wait_for(taken(stream), PATIENCE_S)
        thread.join()
        return times

    assert asyncio.run(consume()) == list(range(1, 101))


def test_a_consumer_waits_without_blocking_its_loop() -> None:
    async def consume() -> list[int]:
        stream = make_stream()
        waiting = asyncio.create_task(taken(stream))
        await asyncio.sleep(0)
        stream.push(moves(1))
        stream.end()
        return await asyncio.wait_for(waiting, PATIENCE_S)

    assert asyncio.run(consume()) == [1]


@pytest.mark.parametrize("types", ["move", EventType.MOVE, ["move", "down"], {EventType.MOVE}])
def test_only_the_types_asked_for_arrive(types: object) -> None:
    stream = make_stream(types)
    stream.push([make_event(EventType.UP, 1), *moves(2, first=2)])
    stream.end()
    assert asyncio.run(taken(stream)) == [2, 3]


def test_coalesce_merges_moves_and_keeps_edges() -> None:
    stream = make_stream(capacity=2)
    stream.push([*moves(5), make_event(EventType.UP, 6)])
    stream.end()
    assert len(stream) == 4
    assert asyncio.run(taken(stream)) == [1, 2, 5, 6]


def test_drop_oldest_keeps_the_newest() -> None:
    stream = make_stream(capacity=2, overflow="drop_oldest")
    stream.push(moves(5))
    stream.end()
    assert asyncio.run(taken(stream)) == [4, 5]


def test_raise_tells_the_consumer_after_what_it_could_keep() -> None:
    async def consume() -> list[int]:
        stream = make_stream(capacity=2, overflow="raise")
        stream.push(moves(5))
        times = [(await anext(stream)).timestamp_ns for _ in range(2)]
        with pytest.raises(QueueFullError, match="2 events wait"):
            await anext(stream)
        with pytest.raises(StopAsyncIteration):
            await anext(stream)
        return times

    assert asyncio.run(consume()) == [1, 2]


def test_an_error_comes_after_the_events_before_it() -> None:
    async def consume() -> None:
        stream = make_stream()
        stream.push(moves(1))
        stream.end(SourceError("unplugged"))
        assert (await anext(stream)).timestamp_ns == 1
        with pytest.raises(SourceError, match="unplugged"):
            await anext(stream)

    asyncio.run(consume())


def test_a_closed_stream_keeps_nothing() -> None:
    async def consume() -> None:
        async with make_stream() as stream:
            stream.push(moves(3))
            assert (await anext(stream)).timestamp_ns == 1
        stream.push(moves(3))
        assert len(stream) == 0
        with pytest.raises(StopAsyncIteration):
            await anext(stream)

    asyncio.run(consume())


def test_pushing_after_the_loop_has_gone_harms_nobody() -> None:
    stream = make_stream()

    async def give_up() -> None:
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(anext(stream), 0)

    asyncio.run(give_up())
    stream.push(moves(1))
    assert len(stream) == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"types": "clik"}, "Did you mean click"),
        ({"capacity": 0}, "need at least 1"),
        ({"overflow": "drop_old"}, "Did you mean drop_oldest"),
    ],
)
def test_wrong_arguments_are_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        make_stream(**arguments)  # type: ignore[arg-type]
    assert message in str(caught.value)
