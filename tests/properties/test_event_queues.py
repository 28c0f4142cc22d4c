"""Whatever comes, and whenever it is taken: edges arrive all and in order, and nothing overtakes one."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.listeners import CoalescingBuffer, MergingQueue
from egotouch_sdk.listeners.merging import MAX_COALESCED
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

#: Streams more often than edges, as in a touch.
TYPES = st.sampled_from([*EventType, *[EventType.MOVE, EventType.DRAG, EventType.FORCE_CHANGE, EventType.HOVER_MOVE] * 4])
#: A pushed event (type, pointer), or None: the consumer takes something.
STEPS = st.lists(st.one_of(st.tuples(TYPES, st.integers(1, 3)), st.none()), max_size=80)
CAPACITIES = st.integers(1, 6)


def event(event_type: EventType, pointer_id: int, number: int) -> TouchEvent:
    """The `number`-th event that is pushed; its time is its number."""
    return make_event(event_type, number, pointer_id=pointer_id, contact_id=1)


def check(pushed: list[TouchEvent], taken: Iterable[TouchEvent], merged: int) -> None:
    """The law of slow consumers."""
    taken = list(taken)
    assert len(taken) + merged == len(pushed)
    assert [one for one in taken if one.type.is_edge] == [one for one in pushed if one.type.is_edge]
    assert all(older.timestamp_ns < newer.timestamp_ns for older, newer in pairwise(taken)), "the order of the newest parts is kept"
    edge_ns = -1
    for one in taken:
        history = [older.timestamp_ns for older in one.coalesced]
        assert history == sorted(history)
        assert all(edge_ns < time_ns < one.timestamp_ns for time_ns in history), "no part overtakes an edge or lags behind one"
        assert all(pushed[time_ns].type is one.type and pushed[time_ns].pointer_id == one.pointer_id for time_ns in history)
        assert len(history) <= MAX_COALESCED
        if one.type.is_edge:
            assert history == []
            edge_ns = one.timestamp_ns


@given(STEPS)
def test_merging_queue(steps: list[tuple[EventType, int] | None]) -> None:
    queue: MergingQueue[TouchEvent] = MergingQueue()
    pushed: list[TouchEvent] = []
    batches: list[list[TouchEvent]] = []
    for step in [*steps, None]:
        if step is None:
            batches.append(queue.take())
        else:
            pushed.append(event(*step, len(pushed)))
            queue.push(pushed[-1])
    check(pushed, [one for batch in batches for one in batch], queue.merged)
    for batch in batches:
        since_edge: set[tuple[int, EventType]] = set()
        for one in batch:
            key = one.pointer_id, one.type
            assert key not in since_edge, "between two edges each pointer has one event of a type"
            since_edge = set() if one.type.is_edge else since_edge | {key}


@given(STEPS, CAPACITIES)
def test_coalescing_buffer(steps: list[tuple[EventType, int] | None], capacity: int) -> None:
    buffer = CoalescingBuffer(capacity)
    pushed: list[TouchEvent] = []
    taken: list[TouchEvent] = []
    for step in steps:
        if step is None:
            taken += [buffer.pop()] if len(buffer) else []
        else:
            pushed.append(event(*step, len(pushed)))
            buffer.push(pushed[-1])
    while len(buffer):
        taken.append(buffer.pop())
    check(pushed, taken, buffer.merged)


@given(st.lists(st.tuples(TYPES, st.integers(1, 3)), max_size=80), CAPACITIES)
def test_a_buffer_that_is_emptied_in_time_merges_nothing(steps: list[tuple[EventType, int]], capacity: int) -> None:
    buffer = CoalescingBuffer(capacity)
    pushed = [event(*step, number) for number, step in enumerate(steps)]
    taken = []
    for one in pushed:
        buffer.push(one)
        taken.append(buffer.pop())
    assert taken == pushed
