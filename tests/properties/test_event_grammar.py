"""Whatever the camera shows, the events keep the grammar."""

from __future__ import annotations

import os
import time
from collections import Counter
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from egotouch_sdk.events import GrammarVerifier, verify_events
from egotouch_sdk.events.order import RAW
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.properties.finger_programs import play

#: How many streams hypothesis draws in the long run; set it to 1000000 for the thorough one (about ten minutes on an idle core).
MANY = int(os.environ.get("EGOTOUCH_GRAMMAR_STREAMS", "5000"))
#: Streams to an example: drawing one alone would take as long as checking it.
BATCH = 10
#: Hypothesis remembers every example of a run to avoid repeats, so a long run is cut into blocks with a seed each.
BLOCK = 20_000
PROGRAMS = st.binary(max_size=48)
UNTIL_NOW = settings(max_examples=300, deadline=None)


def events_of(program: bytes) -> list[TouchEvent]:
    return play(program, GrammarVerifier())


def contacts_of(events: list[TouchEvent]) -> dict[tuple[int, int], list[TouchEvent]]:
    """The events of each touch, from DOWN to what its lift meant."""
    contacts: dict[tuple[int, int], list[TouchEvent]] = {}
    for event in events:
        if not event.type.is_hover:
            contacts.setdefault((event.pointer_id, event.contact_id), []).append(event)
    return contacts


@given(PROGRAMS)
@UNTIL_NOW
def test_random_streams_keep_the_grammar(program: bytes) -> None:
    verifier = GrammarVerifier()
    events = play(program, verifier)
    assert verifier.violations == []
    assert verify_events(events) == ()


@given(PROGRAMS)
@UNTIL_NOW
def test_every_down_gets_exactly_one_up_or_cancel(program: bytes) -> None:
    for contact in contacts_of(events_of(program)).values():
        ends = [event.type for event in contact if event.type in (EventType.UP, EventType.CANCEL)]
        assert contact[0].type is EventType.DOWN
        assert len(ends) == 1


@given(PROGRAMS)
@UNTIL_NOW
def test_a_cancelled_touch_means_nothing(program: bytes) -> None:
    for contact in contacts_of(events_of(program)).values():
        if contact[-1].type is EventType.CANCEL:
            kinds = {event.type for event in contact}
            assert kinds.isdisjoint({EventType.UP, EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING})


@given(PROGRAMS)
@UNTIL_NOW
def test_long_clicks_and_drags_keep_out_of_each_others_way(program: bytes) -> None:
    for contact in contacts_of(events_of(program)).values():
        kinds = [event.type for event in contact]
        assert kinds.count(EventType.LONG_CLICK) <= 1
        assert kinds.count(EventType.DRAG_START) == kinds.count(EventType.DRAG_END) <= 1
        assert kinds.count(EventType.FORCE_ENTER) == kinds.count(EventType.FORCE_EXIT)
        if EventType.DRAG_START in kinds:
            assert EventType.CLICK not in kinds
            assert EventType.LONG_CLICK not in kinds[kinds.index(EventType.DRAG_START) :]


@given(PROGRAMS)
@UNTIL_NOW
def test_no_touch_jumps(program: bytes) -> None:
    for contact in contacts_of(events_of(program)).values():
        for before, after in pairwise([event for event in contact if event.type in RAW]):
            way_mm = ((after.x_mm - before.x_mm) ** 2 + (after.y_mm - before.y_mm) ** 2) ** 0.5
            assert way_mm <= 3.0 * (after.timestamp_ns - before.timestamp_ns) / 1e6 + 20.01


@given(PROGRAMS)
@UNTIL_NOW
def test_one_pointer_at_a_time_for_each_finger(program: bytes) -> None:
    owners: dict[tuple[str, str], int] = {}
    for event in events_of(program):
        if event.type is EventType.HOVER_ENTER:
            assert (event.hand, event.finger) not in owners
            owners[event.hand, event.finger] = event.pointer_id
        assert owners[event.hand, event.finger] == event.pointer_id
        if event.type is EventType.HOVER_EXIT:
            del owners[event.hand, event.finger]
    assert owners == {}


@given(PROGRAMS)
@UNTIL_NOW
def test_a_replay_gives_the_same_events(program: bytes) -> None:
    assert events_of(program) == events_of(program)


@pytest.mark.slow
def test_many_random_streams_keep_the_grammar() -> None:
    counts: Counter[EventType] = Counter()
    streams = violations = 0
    start_s = time.perf_counter()

    def check(programs: list[bytes]) -> None:
        nonlocal streams, violations
        for program in programs:
            verifier = GrammarVerifier()
            counts.update(event.type for event in play(program, verifier))
            streams += 1
            violations += len(verifier.violations)
            assert verifier.violations == []

    block = 0
    while streams < MANY:
        options = settings(
            max_examples=-(-min(BLOCK, MANY - streams) // BATCH),
            deadline=None,
            database=None,
            phases=[Phase.generate, Phase.shrink],
            suppress_health_check=[HealthCheck.too_slow],
        )
        seed(block)(options(given(st.lists(PROGRAMS, min_size=BATCH, max_size=BATCH))(check)))()
        block += 1
        if block % 5 == 0:
            print(f"{streams} streams, {counts.total()} events, {violations} violations, {time.perf_counter() - start_s:.0f} s", flush=True)
    print(f"{streams} streams, {counts.total()} events, {violations} violations, {time.perf_counter() - start_s:.0f} s")
    print(", ".join(f"{count} {kind}" for kind, count in counts.most_common()))
    assert set(counts) == set(EventType), "the streams must reach every kind of event"
