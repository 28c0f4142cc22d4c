import pytest

from egotouch_sdk.joints import Handedness
from egotouch_sdk.listeners import CoalescingBuffer, MergingQueue, TrackingState
from egotouch_sdk.observation import GateReason
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

DOWN, MOVE, UP, DRAG = EventType.DOWN, EventType.MOVE, EventType.UP, EventType.DRAG


def shown(items: list[TouchEvent | TrackingState]) -> list[str]:
    """`move@2(1)` is a move at time 2 with one older one in it."""
    return [
        f"{item.type}@{item.timestamp_ns}" + (f"({len(item.coalesced)})" if item.coalesced else "")
        if isinstance(item, TouchEvent)
        else f"tracking@{item.timestamp_ns}"
        for item in items
    ]


def filled(*items: tuple[EventType, int] | tuple[EventType, int, int] | TrackingState) -> MergingQueue[TrackingState]:
    queue: MergingQueue[TrackingState] = MergingQueue()
    for item in items:
        queue.push(item if isinstance(item, TrackingState) else make_event(*item[:2], pointer_id=item[2] if len(item) > 2 else 1))
    return queue


def test_moves_merge_and_edges_stay_between_them() -> None:
    queue = filled((DOWN, 1), (MOVE, 2), (MOVE, 3), (UP, 4), (DOWN, 5), (MOVE, 6), (MOVE, 7))
    assert len(queue) == 5
    assert queue.merged == 2
    assert shown(queue.take()) == ["down@1", "move@3(1)", "up@4", "down@5", "move@7(1)"]
    assert (len(queue), queue.take()) == (0, [])


def test_a_derived_event_still_follows_the_one_that_caused_it() -> None:
    assert shown(filled((MOVE, 1), (DRAG, 1), (MOVE, 2), (DRAG, 2)).take()) == ["move@2(1)", "drag@2(1)"]


def test_pointers_do_not_merge_with_each_other() -> None:
    assert shown(filled((MOVE, 1, 1), (MOVE, 1, 2), (MOVE, 2, 1), (MOVE, 2, 2)).take()) == ["move@2(1)", "move@2(1)"]


def test_the_edge_of_one_pointer_is_passed_by_no_other() -> None:
    assert shown(filled((MOVE, 1, 1), (DOWN, 2, 2), (MOVE, 3, 1)).take()) == ["move@1", "down@2", "move@3"]


def test_what_is_no_touch_event_is_an_edge() -> None:
    state = TrackingState(2, (Handedness.LEFT,), GateReason.NO_HOST)
    assert shown(filled((MOVE, 1), state, (MOVE, 3)).take()) == ["move@1", "tracking@2", "move@3"]


def test_a_buffer_merges_only_what_does_not_fit() -> None:
    buffer = CoalescingBuffer(2)
    for timestamp_ns in range(1, 6):
        buffer.push(make_event(MOVE, timestamp_ns))
    buffer.push(make_event(UP, 6))
    assert (len(buffer), buffer.merged) == (4, 2)
    assert shown([buffer.pop() for _ in range(4)]) == ["move@1", "move@2", "move@5(2)", "up@6"]
    with pytest.raises(IndexError):
        buffer.pop()
