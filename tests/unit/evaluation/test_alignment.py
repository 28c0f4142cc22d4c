from __future__ import annotations

import random
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from egotouch_sdk.evaluation.alignment import align, aligned_confusion, runs
from egotouch_sdk.evaluation.confusion import Confusion


def frames(text: str) -> np.ndarray:
    return np.array([letter == "#" for letter in text], bool)


def brute_force(touch: list[bool], called: list[bool], radius: int) -> tuple[int, int]:
    """Fewest disagreements, then fewest pairs, by trying every path."""

    @cache
    def best(i: int, j: int) -> tuple[int, int]:
        if abs(i - j) > radius or i < 0 or j < 0:
            return (10**9, 10**9)
        wrong = int(touch[i] != called[j])
        if i == j == 0:
            return (wrong, 1)
        before = min(best(i - 1, j), best(i, j - 1), best(i - 1, j - 1))
        return (before[0] + wrong, before[1] + 1)

    return best(len(touch) - 1, len(called) - 1)


@pytest.mark.parametrize("radius", [0, 1, 2, 4])
def test_the_path_is_the_best_within_the_band(radius: int) -> None:
    rng = random.Random(radius)
    for _ in range(60):
        length = rng.randint(1, 14)
        touch, called = ([rng.random() < 0.5 for _ in range(length)] for _ in range(2))
        path = align(np.array(touch), np.array(called), radius)
        assert path[0] == (0, 0) and path[-1] == (length - 1, length - 1)
        assert all(abs(i - j) <= radius for i, j in path)
        assert all((b[0] - a[0], b[1] - a[1]) in {(0, 1), (1, 0), (1, 1)} for a, b in pairwise(path))
        wrong = sum(touch[i] != called[j] for i, j in path)
        assert (wrong, len(path)) == brute_force(touch, called, radius)


@pytest.mark.parametrize("late", [1, 2, 3, 4])
def test_a_touch_told_up_to_four_frames_late_is_right(late: int) -> None:
    touch = frames("....######..............")
    told = np.roll(touch, late)
    counted = aligned_confusion(touch, told, np.ones(len(touch), bool))
    assert (counted.fn, counted.fp) == (0, 0) and counted.tp >= 6


def test_a_touch_told_five_frames_late_is_wrong_at_both_ends() -> None:
    touch = frames("....########..............")
    told = np.roll(touch, 5)
    counted = aligned_confusion(touch, told, np.ones(len(touch), bool))
    assert counted.fn + counted.fp == 2


def test_a_false_touch_is_not_aligned_away() -> None:
    counted = aligned_confusion(frames("............"), frames("....###....."), np.ones(12, bool))
    assert counted == Confusion(tp=0, fn=0, fp=3, tn=9)


def test_closed_frames_are_no_bridge() -> None:
    touch, told = frames("..##....##.."), frames("....##..##..")
    gate = frames("####..######")
    assert aligned_confusion(touch, told, gate) == Confusion(tp=2, fn=2, fp=0, tn=6)


def test_runs_are_found_at_both_ends() -> None:
    assert runs(frames("##..#.##")) == [(0, 2), (4, 5), (6, 8)]
    assert runs(frames("...")) == [] and runs(frames("")) == [] and runs(frames("##")) == [(0, 2)]


def test_radius_zero_is_frame_against_frame() -> None:
    touch, told = frames(".##..#"), frames("..##.#")
    assert aligned_confusion(touch, told, np.ones(6, bool), radius=0) == Confusion.of(touch, told)
