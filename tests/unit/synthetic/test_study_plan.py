"""The study's participants and rounds are the paper's, whatever part of them is rendered."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra [synthetic]")

from egotouch_sdk.joints import Finger
from egotouch_sdk.study_data import Hair, TouchType
from egotouch_sdk.synthetic.participants import FIRST_SEED, HAIR_DENSITY, HAND_SCALE, PARTICIPANTS, traits_of
from egotouch_sdk.synthetic.study_plan import LIGHTS, ROUNDS, RoundPlan, plan_study
from egotouch_sdk.synthetic.tracker_error import draw_tracker_error


@pytest.fixture(scope="module")
def plans() -> list[RoundPlan]:
    return plan_study(0, 15, ROUNDS, 1.2)


def test_fifteen_participants_have_the_papers_mix() -> None:
    assert Counter(person.fitzpatrick for person in PARTICIPANTS) == {2: 3, 3: 8, 4: 1, 5: 2, 6: 1}
    assert Counter(person.hair for person in PARTICIPANTS) == {Hair.NIL: 4, Hair.SPARSE: 6, Hair.MODERATE: 2, Hair.DENSE: 3}
    assert len({person.size for person in PARTICIPANTS}) == 2
    assert sum(person.polish_srgb is not None for person in PARTICIPANTS) == 2


@pytest.mark.parametrize("number", range(15))
def test_skin_is_what_the_table_states(number: int) -> None:
    stated, traits = PARTICIPANTS[number], traits_of(number)
    assert traits.fitzpatrick == stated.fitzpatrick
    assert HAIR_DENSITY[stated.hair][0] <= traits.hair <= HAIR_DENSITY[stated.hair][1]
    assert HAND_SCALE[stated.size][0] <= traits.scale <= HAND_SCALE[stated.size][1]
    assert (traits.polish is None) == (stated.polish_srgb is None)
    assert traits == traits_of(number)


def test_hair_steps_do_not_overlap() -> None:
    steps = [HAIR_DENSITY[hair] for hair in Hair]
    assert all(below[1] < above[0] for below, above in pairwise(steps))


def test_nobody_in_the_study_is_in_training() -> None:
    assert FIRST_SEED >= 1000


def test_each_participant_has_32_rounds_of_the_index_finger_and_one_of_every_other(plans: list[RoundPlan]) -> None:
    for who in range(15):
        own = [plan for plan in plans if plan.participant == who]
        assert sorted(plan.number for plan in own) == list(range(36))
        assert Counter(plan.finger for plan in own) == {finger: 32 if finger is Finger.INDEX else 1 for finger in Finger}


def test_the_index_fingers_rounds_cross_place_type_and_daylight(plans: list[RoundPlan]) -> None:
    firm = (TouchType.HARD_PRESS, TouchType.DRAG)
    for who in range(15):
        own = [plan for plan in plans if plan.participant == who and plan.finger is Finger.INDEX]
        cells = Counter((plan.place, "firm" if plan.touch_type in firm else plan.touch_type, plan.outdoors) for plan in own)
        assert len(cells) == 32 and set(cells.values()) == {1}
        assert sum(plan.touch_type is TouchType.DRAG for plan in own) == 2
    drags = Counter((plan.place, plan.outdoors) for plan in plans if plan.touch_type is TouchType.DRAG and plan.finger is Finger.INDEX)
    assert len(drags) == 8 and max(drags.values()) - min(drags.values()) <= 1


def test_light_is_of_the_rounds_kind_and_every_kind_occurs(plans: list[RoundPlan]) -> None:
    assert {plan.light for plan in plans} == set(LIGHTS)
    for plan in plans:
        facts = LIGHTS[plan.light]
        assert plan.outdoors == facts.outdoors
        assert facts.lux[0] <= plan.lux <= facts.lux[1] and facts.exposure_s[0] <= plan.exposure_s <= facts.exposure_s[1] < 1 / plan.fps
    walking = {outdoors: np.mean([plan.walking for plan in plans if plan.outdoors == outdoors]) for outdoors in (False, True)}
    assert 0.05 < walking[False] < walking[True] < 0.7


def test_a_study_that_stops_early_is_balanced(plans: list[RoundPlan]) -> None:
    early = plans[: 15 * 8]
    assert set(Counter(plan.participant for plan in early).values()) == {8}
    assert min(Counter(plan.place for plan in early).values()) >= 15
    assert len({plan.touch_type for plan in early}) == 5


def test_fewer_rounds_or_people_are_the_same_rounds(plans: list[RoundPlan]) -> None:
    few = plan_study(0, 3, 5, 1.2)
    assert len(few) == 15
    assert set(few) <= set(plans)
    assert {plan.seed for plan in plan_study(1, 3, 5, 1.2)}.isdisjoint(plan.seed for plan in few)


@pytest.mark.parametrize(("participants", "rounds", "seconds"), [(0, 1, 1.0), (16, 1, 1.0), (1, 37, 1.0), (1, 0, 1.0), (1, 1, 0.0)])
def test_impossible_numbers_are_refused(participants: int, rounds: int, seconds: float) -> None:
    with pytest.raises(ValueError, match=r"need 1\.\.15"):
        plan_study(0, participants, rounds, seconds)


def test_the_tracker_misses_by_two_millimetres_and_not_anew_in_every_frame() -> None:
    rounds = [draw_tracker_error(np.random.default_rng(seed), 36, 30.0) for seed in range(300)]
    miss_mm = np.concatenate([np.hypot(*one.tip_mm.T) for one in rounds])
    assert np.median(miss_mm) == pytest.approx(1.9, abs=0.25)
    assert 3.0 < np.percentile(miss_mm, 90) < 4.6
    step_mm = np.concatenate([np.hypot(*np.diff(one.tip_mm, axis=0).T) for one in rounds])
    assert np.median(step_mm) < 0.75 * np.median(miss_mm)
    assert all(one.scale.min() >= 0.75 and one.scale.max() <= 1.3 and np.abs(one.turn_rad).max() <= 0.21 for one in rounds)
