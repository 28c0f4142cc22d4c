"""Sides and lasting hand numbers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.hands.identity import HandIds, assign_sides, log_odds, updated
from egotouch_sdk.joints import Handedness

LEFT, RIGHT = Handedness.LEFT, Handedness.RIGHT


def test_log_odds_sign_and_limit():
    assert log_odds(0.5) == 0
    assert log_odds(0.9) == pytest.approx(-log_odds(0.1))
    assert log_odds(1.0) == log_odds(0.995) == pytest.approx(4.595, abs=1e-3)


def test_a_sure_hand_survives_four_frames_of_the_wrong_look():
    evidence = 0.0
    for _ in range(60):
        evidence = updated(evidence, log_odds(1.0))
    assert evidence == 8.0
    for _ in range(4):
        evidence = updated(evidence, log_odds(0.0))
    assert assign_sides([evidence]) == (RIGHT,)
    for _ in range(10):
        evidence = updated(evidence, log_odds(0.0))
    assert assign_sides([evidence]) == (LEFT,)


@given(st.lists(st.floats(-8, 8), min_size=2, max_size=2))
def test_two_hands_are_always_one_left_and_one_right(evidence):
    assert set(assign_sides(evidence)) == {LEFT, RIGHT}


@pytest.mark.parametrize(
    ("evidence", "sides"), [((3, 1), (RIGHT, LEFT)), ((-3, -1), (LEFT, RIGHT)), ((-2, 2), (LEFT, RIGHT)), ((), ())]
)
def test_the_surer_right_is_the_right(evidence, sides):
    assert assign_sides(evidence) == sides


def test_three_hands_are_refused():
    with pytest.raises(ValueError, match="two hands"):
        assign_sides([1, 2, 3])


def test_a_returning_hand_gets_the_number_of_its_side():
    ids = HandIds()
    right = ids.new(RIGHT, [])
    ids.confirm(right, RIGHT)
    left = ids.new(LEFT, [right])
    ids.confirm(left, LEFT)
    assert left != right
    assert ids.new(RIGHT, [left]) == right
    assert ids.new(LEFT, []) == left


def test_a_hand_mistaken_at_first_keeps_its_number():
    ids = HandIds()
    first = ids.new(RIGHT, [])
    ids.confirm(first, RIGHT)
    ids.confirm(first, LEFT)  # its side turned out to be the other
    assert ids.new(LEFT, []) == first
    assert ids.new(RIGHT, []) == 1 - first


def test_a_number_in_view_is_never_given_twice():
    ids = HandIds()
    assert ids.new(LEFT, [0]) == 1
    assert ids.new(RIGHT, [1]) == 0
