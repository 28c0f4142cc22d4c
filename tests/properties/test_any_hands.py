"""Whatever landmarks a tracker delivers, the gate and the patches answer and do not depend on the order of the hands."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from egotouch_sdk.config import GateConfig
from egotouch_sdk.errors import FrameError
from egotouch_sdk.frame import Frame
from egotouch_sdk.gate import find_pairs
from egotouch_sdk.host_frame import locate
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.observation import GateReason, HandObservation, TouchEstimate
from egotouch_sdk.patches import extract
from egotouch_sdk.state import FingertipSample
from tests.support.hands import make_hand, with_tip_at

FRAME = Frame(np.random.default_rng(0).integers(0, 256, (64, 96, 3)).astype(np.uint8), 0, 0)
LANDMARKS = st.one_of(
    hnp.arrays(np.float32, (21, 3), elements=st.floats(-200, 300, width=32)),
    hnp.arrays(np.float32, (21, 3), elements=st.sampled_from([0.0, 1.0, 50.0, 1e-30, 1e6, -1e6])),
)
WILD_HANDS = st.builds(HandObservation, st.just(0), st.sampled_from(list(Handedness)), st.floats(0, 1), LANDMARKS, LANDMARKS)


@st.composite
def placed_hands(draw: st.DrawFn) -> HandObservation:
    """An anatomically possible hand anywhere around the frame."""
    hand = make_hand(
        draw(st.sampled_from(list(Handedness))),
        pointing_deg=draw(st.floats(-180, 180)),
        tilt_deg=draw(st.floats(-90, 90)),
        px_per_mm=draw(st.floats(0.05, 5)),
        extended=draw(st.sets(st.sampled_from(FINGERS))),
        palm_up=draw(st.booleans()),
    )
    return with_tip_at(hand, draw(st.sampled_from(FINGERS)), (draw(st.floats(-20, 116)), draw(st.floats(-20, 84))))


def numbered(hands: list[HandObservation]) -> list[HandObservation]:
    return [HandObservation(n, hand.handedness, hand.score, hand.landmarks_px, hand.world_mm) for n, hand in enumerate(hands, 1)]


@given(st.lists(st.one_of(WILD_HANDS, placed_hands()), max_size=3).map(numbered))
@settings(max_examples=300, deadline=None)
def test_gate_and_patches_take_any_hands(hands: list[HandObservation]) -> None:
    result = find_pairs(hands, GateConfig())
    assert result.is_open == bool(result.pairs)
    assert (result.reason is GateReason.NO_HANDS) == (not hands)
    for pair in result.pairs:
        assert pair.active_fingers
        assert pair.touching.hand_id != pair.host.hand_id
        for patch in extract(FRAME, pair):
            assert np.isfinite([patch.r_palms, patch.theta_rad, patch.px_per_mm]).all()
            point = locate(pair, patch.finger)
            if point is not None:
                size_px = FRAME.width_px, FRAME.height_px
                sample = FingertipSample.join(size_px, patch, TouchEstimate(patch.hand_id, patch.finger, 0.5, 1.0), point)
                assert 0.0 <= min(sample.image_xy) <= max(sample.image_xy) <= 1.0


@given(st.lists(placed_hands(), min_size=2, max_size=2).map(numbered))
@settings(max_examples=150, deadline=None)
def test_the_order_of_the_hands_does_not_matter(hands: list[HandObservation]) -> None:
    one, other = find_pairs(hands, GateConfig()), find_pairs(hands[::-1], GateConfig())
    assert one.reason is other.reason
    assert [pair.touching.hand_id for pair in one.pairs] == [pair.touching.hand_id for pair in other.pairs]


@given(st.lists(placed_hands(), min_size=2, max_size=2).map(numbered))
@settings(max_examples=150, deadline=None)
def test_an_open_gate_stays_open_on_the_same_picture(hands: list[HandObservation]) -> None:
    first = find_pairs(hands, GateConfig())
    second = find_pairs(hands, GateConfig(), first)
    assert second.reason is first.reason
    for before, after in zip(first.pairs, second.pairs, strict=True):
        assert before.touching is after.touching
        assert set(before.active_fingers) <= set(after.active_fingers)


@given(hnp.arrays(np.float32, (21, 3), elements=st.sampled_from([0.0, np.nan, np.inf])))
@settings(max_examples=30, deadline=None)
def test_landmarks_that_are_no_numbers_never_get_in(landmarks: np.ndarray) -> None:
    try:
        HandObservation(1, Handedness.LEFT, 1.0, landmarks, np.zeros((21, 3)))
    except FrameError:
        assert not np.isfinite(landmarks).all()
    else:
        assert np.isfinite(landmarks).all()
