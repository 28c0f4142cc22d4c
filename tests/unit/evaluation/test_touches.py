from __future__ import annotations

from itertools import combinations, permutations
from math import isnan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.evaluation.confusion import Matches
from egotouch_sdk.evaluation.touches import TOLERANCES, Candidates, average_precision, candidates, match_times, meetings


def frames(text: str) -> np.ndarray:
    return np.array([letter == "#" for letter in text], bool)


def clicks(true: str, told: str, gate: str | None = None) -> tuple[list[bool], int]:
    pairs, false = meetings(frames(true), frames(told), frames(gate or "#" * len(true)))
    return [pair.is_click for pair in pairs], len(false)


def test_a_touch_met_once_is_a_click() -> None:
    assert clicks("..###...###.", "...###..##..") == ([True, True], 0)


def test_a_touch_met_never_or_twice_is_none() -> None:
    assert clicks("..######....###", "..##..##.......") == ([False, False], 0)


def test_two_touches_told_as_one_are_none() -> None:
    assert clicks("..###.###..", "..########.") == ([False, False], 0)


def test_a_told_touch_that_meets_none_is_false() -> None:
    assert clicks("..###......", "..###..##..") == ([True], 1)


def test_a_touch_behind_a_closed_gate_is_not_counted() -> None:
    assert clicks("..###..##..", ".......##..", ".....######") == ([True], 0)


def most_matches(true: list[int], told: list[int], tolerance: int) -> int:
    """The most pairs of any one-to-one matching, by trying all."""
    for size in range(min(len(true), len(told)), 0, -1):
        for chosen in combinations(true, size):
            if any(all(abs(a - b) <= tolerance for a, b in zip(chosen, order, strict=True)) for order in permutations(told, size)):
                return size
    return 0


times = st.lists(st.integers(0, 25), max_size=5, unique=True).map(sorted)


@given(times, times, st.sampled_from(TOLERANCES))
def test_matching_in_order_finds_as_many_as_any_matching(true: list[int], told: list[int], tolerance: int) -> None:
    found = most_matches(true, told, tolerance)
    assert match_times(true, told, tolerance) == Matches(found, len(true) - found, len(told) - found)


def test_the_steepest_rise_is_the_onset() -> None:
    offered = candidates([4], np.array([0.1, 0.1, 0.1, 0.3, 0.9, 0.95, 0.9, 0.2, 0.1, 0.5]))
    assert offered.score == pytest.approx([0.6, 0.4, 0.1]) and offered.true_onsets == 1
    assert offered.hit[0].tolist() == [True, False, False]


def test_no_true_onset_is_won_twice() -> None:
    offered = candidates([5], np.array([0, 0, 0, 0.4, 0.4, 0.4, 0.9, 0.9]))
    assert offered.score == pytest.approx([0.5, 0.4])
    assert offered.hit[2].tolist() == [True, False] and offered.hit[0].tolist() == [False, False]


def test_frames_that_were_not_seen_propose_nothing() -> None:
    offered = candidates([], np.array([np.nan, np.nan, 0.7, np.nan, 0.0]))
    assert offered.score == pytest.approx([0.7]) and not offered.hit[4].any()


def test_average_precision_of_perfect_and_of_missing_answers() -> None:
    assert average_precision(np.array([True, True]), np.array([0.9, 0.8]), 2) == 1.0
    assert average_precision(np.array([True]), np.array([0.9]), 2) == 0.5
    assert average_precision(np.array([], bool), np.array([]), 2) == 0.0
    assert isnan(average_precision(np.array([False]), np.array([0.9]), 0))


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 6)), min_size=1, max_size=30).filter(lambda rows: any(hit for hit, _ in rows)))
def test_average_precision_is_that_of_scikit_learn(rows: list[tuple[bool, int]]) -> None:
    metrics = pytest.importorskip("sklearn.metrics")
    hit, score = np.array([hit for hit, _ in rows]), np.array([float(score) for _, score in rows])
    assert average_precision(hit, score, int(hit.sum())) == pytest.approx(metrics.average_precision_score(hit, score))


def test_candidates_of_rounds_are_pooled() -> None:
    first, second = candidates([1], np.array([0.0, 0.9])), candidates([1, 5], np.array([0.0, 0.2, 0.2]))
    pooled = Candidates.join([first, second])
    assert pooled.true_onsets == 3 and pooled.average_precision(0) == pytest.approx(2 / 3)
