"""How a study's finger moves: smooth, exact, touching only where it is asked to."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra [synthetic]")

from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.finger_motion import (
    LEAST_FORCE_N,
    STUDY_PACE,
    TRAINING_PACE,
    FingerMotion,
    FingerPath,
    Pace,
    contact_spans,
    minimum_jerk,
)
from egotouch_sdk.synthetic.head_motion import HeadMotion

SECONDS = 3.0
FINE_S = np.arange(0.0, SECONDS, 0.001)
TOUCHING = [kind for kind in TouchType if kind is not TouchType.HOVER]


def moves(kind: TouchType, seeds: int = 25, seconds: float = SECONDS, pace: Pace = STUDY_PACE) -> list[tuple[FingerMotion, FingerPath]]:
    motions = [FingerMotion(np.random.default_rng([7, seed]), kind, seconds, pace) for seed in range(seeds)]
    return [(motion, motion.at(np.arange(0.0, seconds, 0.001))) for motion in motions]


@pytest.mark.parametrize("kind", list(TouchType))
def test_a_frame_touches_or_hovers_never_both(kind: TouchType) -> None:
    for _, path in moves(kind):
        assert (path.force_n[path.touch] >= LEAST_FORCE_N).all() and (path.hover_mm[path.touch] == 0).all()
        assert (path.force_n[~path.touch] == 0).all() and (path.hover_mm[~path.touch] > 0).all()
        assert path.force_n.max() <= 3.5


@pytest.mark.parametrize("kind", TOUCHING)
def test_every_act_is_one_touch_with_its_peak_and_nothing_else_touches(kind: TouchType) -> None:
    for motion, path in moves(kind):
        acts = [act for act in motion.acts if act.start_s < SECONDS]
        spans = contact_spans(path.touch)
        assert len(spans) in (len(acts), len(motion.acts))
        for (first, last), act in zip(spans, motion.acts, strict=False):
            if last < len(FINE_S):
                assert path.force_n[first:last].max() == pytest.approx(act.peak, rel=0.1)
                assert FINE_S[first] <= act.start_s <= act.end_s <= FINE_S[last]
            low_n, high_n = STUDY_PACE.peak_n(kind)
            assert low_n <= act.peak <= high_n


def test_a_hover_comes_down_to_its_height_and_never_touches() -> None:
    lowest = []
    for motion, path in moves(TouchType.HOVER, 60):
        assert not path.touch.any()
        assert path.hover_mm.min() == pytest.approx(min(act.peak for act in motion.acts if act.start_s < SECONDS), rel=0.25, abs=0.6)
        lowest.append(float(path.hover_mm.min()))
    assert STUDY_PACE.hover_mm[0] <= min(lowest) < 1.6
    assert max(lowest) > 6


@pytest.mark.parametrize("kind", list(TouchType))
def test_a_round_starts_high_and_moves_without_jumps(kind: TouchType) -> None:
    for _, path in moves(kind):
        low_mm, high_mm = STUDY_PACE.start_mm
        assert low_mm - 2 < path.hover_mm[0] < high_mm + 2
        step_mm = np.hypot(*np.diff(path.at_mm, axis=0).T)
        assert step_mm.max() < 0.2
        assert np.abs(np.diff(path.hover_mm)).max() < 0.6
        assert np.abs(path.at_mm[path.touch]).max(initial=0) < 15


def test_only_a_drag_slides_over_the_skin() -> None:
    slid = {
        kind: max(float(np.ptp(path.at_mm[path.touch], axis=0).max()) for _, path in moves(kind))
        for kind in (TouchType.DRAG, TouchType.TAP)
    }
    assert slid[TouchType.DRAG] > 8 > 4 > slid[TouchType.TAP]


def test_in_training_some_hovers_slide_like_a_drag_and_touches_vary_more() -> None:
    hovers = [path for _, path in moves(TouchType.HOVER, 40, pace=TRAINING_PACE)]
    slid = [float(np.ptp(path.at_mm[path.hover_mm < 1.2 * path.hover_mm.min()], axis=0).max()) for path in hovers]
    assert 0.15 < np.mean(np.array(slid) > 6) < 0.6
    lengths = {
        pace: [end - start for _, path in moves(TouchType.TAP, 40, pace=pace) for start, end in contact_spans(path.touch)]
        for pace in (STUDY_PACE, TRAINING_PACE)
    }
    assert np.std(lengths[TRAINING_PACE]) > 1.1 * np.std(lengths[STUDY_PACE])
    assert not any(path.touch.any() for path in hovers)


def test_force_rises_within_a_tenth_of_a_second() -> None:
    for kind in (TouchType.TAP, TouchType.HARD_PRESS):
        for motion, path in moves(kind):
            first, last = contact_spans(path.touch)[0]
            rise_ms = int(np.argmax(path.force_n[first:last] > 0.9 * motion.acts[0].peak))
            assert 20 <= rise_ms <= 130


def test_longer_rounds_have_more_acts_and_the_same_seed_the_same_path() -> None:
    short, long = (FingerMotion(np.random.default_rng(3), TouchType.TAP, seconds) for seconds in (0.6, 4.0))
    assert len(long.acts) > len(short.acts) >= 1
    again = FingerMotion(np.random.default_rng(3), TouchType.TAP, 4.0)
    np.testing.assert_array_equal(again.at(FINE_S).force_n, long.at(FINE_S).force_n)
    assert again.acts == long.acts


def test_minimum_jerk_starts_and_ends_at_rest() -> None:
    assert minimum_jerk([-1.0, 0.0, 0.5, 1.0, 2.0]).tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]
    assert np.diff(minimum_jerk(np.linspace(0, 1, 1000))).max() < 0.002


def test_walking_shakes_the_camera_far_more_than_standing() -> None:
    speed = {
        walking: [np.abs(np.diff(HeadMotion(np.random.default_rng(seed), walking).at(FINE_S), axis=0)).max() * 1000 for seed in range(20)]
        for walking in (False, True)
    }
    assert max(speed[False]) < 25
    assert 40 < np.median(speed[True]) < 300
