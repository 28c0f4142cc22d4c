"""Whatever perception finds, the whole engine keeps the grammar: filter, host frame, touch state and gestures together."""

from __future__ import annotations

from functools import lru_cache

from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.config import StateConfig, TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.events import verify_events
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import FINGERS, Finger, Handedness
from egotouch_sdk.observation import Fingertip, GateReason, GateResult, HandObservation, TouchEstimate, TouchPair
from egotouch_sdk.state import FingertipSample
from egotouch_sdk.touch_event import CancelReason, TouchEvent
from tests.properties.finger_programs import frames_of
from tests.support.hands import make_hand, with_tip_at


@lru_cache(maxsize=4096)
def hand_at(side: Handedness, hand_id: int, finger: Finger, tip_px: tuple[float, float]) -> HandObservation:
    """A hand of one side with one of its fingertips in a given place."""
    pointing_deg = 120.0 if side is Handedness.RIGHT else 60.0
    return with_tip_at(make_hand(side, extended=FINGERS, pointing_deg=pointing_deg, hand_id=hand_id), finger, tip_px)


def observed(index: int, time_ns: int, samples: list[FingertipSample]) -> FrameObservation:
    """What perception would have found where the fingertips are; each hand is the other one's host."""
    first = {sample.handedness: sample for sample in reversed(samples)}
    hands = {side: hand_at(side, tip.hand_id, tip.finger, tip.tip_px) for side, tip in first.items()}
    for side in Handedness:
        hands.setdefault(side, hand_at(side, 90, Finger.RING, (450.0, 470.0)))
    pairs, tips, estimates = [], [], []
    for side in first:
        mine = [sample for sample in samples if sample.handedness is side and sample.hand_id == hands[side].hand_id]
        pairs.append(TouchPair(hands[side], hands[side.other], 0.5, tuple(sample.finger for sample in mine)))
        for sample in mine:
            tips.append(Fingertip(hand_id=sample.hand_id, handedness=side, finger=sample.finger, tip_px=sample.tip_px, px_per_mm=2.0))
            estimates.append(TouchEstimate(sample.hand_id, sample.finger, sample.touch_probability, sample.force_n))
    gate = GateResult(GateReason.OPEN if pairs else GateReason.NO_ACTIVE_FINGER, tuple(pairs))
    return FrameObservation(index, time_ns, 1000, 1000, tuple(hands.values()), gate, tuple(tips), tuple(estimates))


def run(program: bytes, coast_frames: int) -> list[TouchEvent]:
    """Events of a whole engine in debug mode, which raises at the first breach of the grammar."""
    engine = EventEngine(TouchConfig(debug=True, state=StateConfig(coast_frames=coast_frames)))
    events: list[TouchEvent] = []
    time_ns = 0
    for index, frame in enumerate(frames_of(program)):
        if isinstance(frame, CancelReason):
            events += engine.finish(time_ns, frame)
            continue
        time_ns += frame[0]
        events += engine.process(observed(index, time_ns, frame[1])).events
        assert {pointer.pointer_id for pointer in engine.pointers} == open_pointers(events)
    return [*events, *engine.finish(time_ns)]


def open_pointers(events: list[TouchEvent]) -> set[int]:
    ended = {event.pointer_id for event in events if event.type == "hover_exit"}
    return {event.pointer_id for event in events} - ended


@given(st.binary(max_size=40), st.integers(0, 3))
@settings(max_examples=150, deadline=None)
def test_random_observations_keep_the_grammar(program: bytes, coast_frames: int) -> None:
    events = run(program, coast_frames)
    assert verify_events(events) == ()
    assert open_pointers(events) == set()


@given(st.binary(max_size=40))
@settings(max_examples=50, deadline=None)
def test_the_same_observations_give_the_same_events(program: bytes) -> None:
    assert run(program, 2) == run(program, 2)
