import pytest

from egotouch_sdk.errors import FrameError
from egotouch_sdk.listeners import merge
from egotouch_sdk.listeners.merging import MAX_COALESCED
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event


def move(timestamp_ns: int, **fields: object) -> TouchEvent:
    return make_event(EventType.MOVE, timestamp_ns, **fields)


def times(event: TouchEvent) -> list[int]:
    return [older.timestamp_ns for older in event.coalesced] + [event.timestamp_ns]


def test_the_newer_one_carries_the_older_one() -> None:
    merged = merge(move(1, x_mm=1.0), move(2, x_mm=2.0))
    assert merged.x_mm == 2.0
    assert merged.coalesced == (move(1, x_mm=1.0),)


def test_histories_are_joined_and_flat() -> None:
    merged = merge(merge(move(1), move(2)), merge(move(3), move(4)))
    assert times(merged) == [1, 2, 3, 4]
    assert all(older.coalesced == () for older in merged.coalesced)


def test_the_oldest_history_is_forgotten() -> None:
    merged = move(0)
    for timestamp_ns in range(1, 20):
        merged = merge(merged, move(timestamp_ns))
    assert times(merged) == list(range(19 - MAX_COALESCED, 20))


@pytest.mark.parametrize(
    ("older", "newer"),
    [
        (make_event(EventType.DOWN), make_event(EventType.DOWN)),
        (move(1), make_event(EventType.DRAG, 2)),
        (move(1), move(2, pointer_id=2)),
        (move(1), move(2, contact_id=2)),
    ],
    ids=["edges", "types", "pointers", "contacts"],
)
def test_what_does_not_belong_together_is_refused(older: TouchEvent, newer: TouchEvent) -> None:
    with pytest.raises(FrameError, match="cannot be merged"):
        merge(older, newer)
