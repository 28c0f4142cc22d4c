from __future__ import annotations

import pytest

from egotouch_sdk.filters import MedianFilter
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate


def estimate(probability: float, force_n: float = 0.0, hand_id: int = 1, finger: Finger = Finger.INDEX) -> TouchEstimate:
    return TouchEstimate(hand_id, finger, probability, force_n)


def run(median: MedianFilter, *probabilities: float | None) -> list[float | None]:
    """Filter one finger's probabilities; None is a frame without it."""
    outputs = [median.apply([] if p is None else [estimate(p)]) for p in probabilities]
    return [out[0].touch_probability if out else None for out in outputs]


def test_a_single_wrong_frame_never_shows() -> None:
    assert run(MedianFilter(), 0.1, 0.1, 0.9, 0.1, 0.1) == [0.0, 0.1, 0.1, 0.1, 0.1]


def test_touch_and_lift_show_one_frame_late() -> None:
    assert run(MedianFilter(), 0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.1, 0.1) == [0.0, 0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.1]


def test_a_finger_that_appears_touching_needs_two_frames() -> None:
    assert run(MedianFilter(), 0.9, 0.9) == [0.0, 0.9]


def test_force_is_filtered_on_its_own() -> None:
    median = MedianFilter()
    forces = [median.apply([estimate(0.9, force)])[0].force_n for force in (1.0, 3.5, 1.2, 1.1)]
    assert forces == [0.0, 1.0, 1.2, 1.2]


def test_fingers_do_not_mix() -> None:
    median = MedianFilter()
    keys = [(1, Finger.INDEX), (1, Finger.RING), (2, Finger.INDEX)]
    for _ in range(3):
        out = median.apply([estimate(0.2 * (n + 1), n, hand_id, finger) for n, (hand_id, finger) in enumerate(keys)])
    assert [(e.hand_id, e.finger) for e in out] == keys
    assert [e.touch_probability for e in out] == [0.2, 0.4, pytest.approx(0.6)]
    assert [e.force_n for e in out] == [0.0, 1.0, 2.0]


def test_a_short_gap_keeps_the_history() -> None:
    assert run(MedianFilter(max_gap_frames=2), 0.9, 0.9, None, None, 0.9)[-1] == 0.9


def test_a_long_gap_starts_afresh() -> None:
    assert run(MedianFilter(max_gap_frames=2), 0.9, 0.9, None, None, None, 0.9)[-1] == 0.0


def test_reset_equals_new() -> None:
    used = MedianFilter()
    run(used, 0.9, 0.9, 0.9)
    used.reset()
    probabilities = (0.7, 0.2, 0.9, None, 0.4)
    assert run(used, *probabilities) == run(MedianFilter(), *probabilities)
