"""Whatever the camera shows, the events keep the grammar."""

from __future__ import annotations

import os
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.config import StateConfig
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.state import FingertipSample, Thresholds, TouchStateMachine
from egotouch_sdk.state.inputs import has_jumped
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.properties.strategies import STREAMS

Stream = list[tuple[int, list[FingertipSample]] | None]
#: How many; set it to 1000000 for the thorough run (half an hour).
MANY = int(os.environ.get("EGOTOUCH_GRAMMAR_STREAMS", "3000"))


def play(stream: Stream, config: StateConfig) -> tuple[list[TouchEvent], GrammarVerifier]:
    """Drive a new machine through a stream; time goes on when a source ends, as with a second camera."""
    machine, verifier, events, time_ns = TouchStateMachine(config, Thresholds(0.6, 0.4)), GrammarVerifier(), [], 0
    for frame in [*stream, None]:
        if frame is None:
            new = machine.finish(time_ns, CancelReason.SOURCE_ENDED)
        else:
            time_ns += frame[0]
            new = machine.step(frame[1], time_ns)
        verifier.feed(new)
        events += new
    verifier.close()
    return events, verifier


@given(STREAMS, st.integers(0, 3))
@settings(max_examples=300, deadline=None)
def test_random_streams_keep_the_grammar(stream: Stream, coast_frames: int) -> None:
    assert play(stream, StateConfig(coast_frames=coast_frames))[1].violations == []


@given(STREAMS)
@settings(max_examples=150, deadline=None)
def test_every_down_gets_exactly_one_up_or_cancel(stream: Stream) -> None:
    events, _ = play(stream, StateConfig())
    downs = sorted((e.pointer_id, e.contact_id) for e in events if e.type is EventType.DOWN)
    ends = sorted((e.pointer_id, e.contact_id) for e in events if e.type in (EventType.UP, EventType.CANCEL))
    assert downs == ends
    assert len(set(downs)) == len(downs)


@given(STREAMS)
@settings(max_examples=150, deadline=None)
def test_a_replay_gives_the_same_events(stream: Stream) -> None:
    assert play(stream, StateConfig())[0] == play(stream, StateConfig())[0]


@given(STREAMS)
@settings(max_examples=150, deadline=None)
def test_no_touch_moves_faster_than_a_finger(stream: Stream) -> None:
    config, places, time_ns = StateConfig(), {}, 0
    machine = TouchStateMachine(config, Thresholds(0.6, 0.4))
    for frame in stream:
        if frame is None:
            machine.finish(time_ns, CancelReason.SOURCE_ENDED)
            continue
        time_ns += frame[0]
        seen = {(sample.handedness, sample.finger): sample for sample in frame[1]}
        for event in machine.step(frame[1], time_ns):
            if event.type in (EventType.DOWN, EventType.MOVE, EventType.UP, EventType.HOVER_MOVE):
                sample, (before, then_ns) = seen[event.hand, event.finger], places[event.pointer_id]
                assert not has_jumped(before, sample, time_ns - then_ns, config)
            if (event.hand, event.finger) in seen:
                places[event.pointer_id] = seen[event.hand, event.finger], time_ns


@pytest.mark.slow
def test_many_random_streams_keep_the_grammar() -> None:
    rng = random.Random(1)
    touches = 0
    for _ in range(MANY):
        stream: Stream = []
        for _ in range(rng.randint(1, 30)):
            if rng.random() < 0.02:
                stream.append(None)
                continue
            slots = [(side, finger) for side in Handedness for finger in FINGERS[:3] if rng.random() < 0.35]
            stream.append((rng.choice([1, 33_000_000, 33_000_000, 90_000_000, 260_000_000]), [random_sample(rng, *slot) for slot in slots]))
        events, verifier = play(stream, StateConfig(coast_frames=rng.randint(0, 3)))
        assert verifier.violations == []
        touches += sum(event.type is EventType.DOWN for event in events)
    assert touches > MANY / 2


def random_sample(rng: random.Random, side: Handedness, finger: str) -> FingertipSample:
    x, y = 500 + rng.choice([0.0, 0.0, 3.0, 600.0]), 500.0
    point = HostPoint(Surface.PALM, x / 2, y / 2, 0.7, 0.0)
    hand_id = 1 + (rng.random() < 0.05)
    return FingertipSample(hand_id, side, finger, rng.choice([0.1, 0.5, 0.9, 0.9]), 1.0, (x, y), 2.0, (x / 2000, 0.5), point)  # type: ignore[arg-type]
