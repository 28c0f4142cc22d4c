from __future__ import annotations

from math import isnan, sqrt
from statistics import NormalDist

import numpy as np
import pytest

from egotouch_sdk.evaluation.bootstrap import Indices, interval_of, interval_of_mean, interval_of_recordings


def test_the_interval_of_a_mean_is_the_normal_one_for_many_participants() -> None:
    values = np.random.default_rng(1).normal(0.9, 0.03, 400)
    half = NormalDist().inv_cdf(0.975) * values.std(ddof=1) / sqrt(400)
    assert interval_of_mean(values.tolist()) == pytest.approx((values.mean() - half, values.mean() + half), abs=half * 0.15)


def test_whole_units_are_drawn() -> None:
    low, high = interval_of([[0.0] * 100, [1.0]], lambda units: float(np.mean([value for unit in units for value in unit])))
    assert (low, high) == (0.0, 1.0)


def test_the_same_draws_come_again_and_the_unknown_is_left_out() -> None:
    values = [0.8, 0.9, float("nan"), 0.95]
    assert interval_of_mean(values) == interval_of_mean(values) == interval_of_mean([0.8, 0.9, 0.95])


def test_one_unit_has_no_interval() -> None:
    assert all(isnan(bound) for bound in (*interval_of_mean([0.9]), *interval_of([1], lambda units: 1.0)))
    assert all(isnan(bound) for bound in interval_of([1, 2], lambda units: float("nan"), draws=5))


def test_rows_are_drawn_in_stretches_of_whole_recordings() -> None:
    seen: list[Indices] = []

    def note(rows: Indices) -> float:
        seen.append(rows)
        return float(rows.mean())

    interval_of_recordings([40, 25], note, block=5, draws=50)
    assert {len(rows) for rows in seen} == {80, 65, 50}
    for rows in seen:
        for stretch in rows.reshape(-1, 5):
            assert (np.diff(stretch) == 1).all() and (stretch < 40).all() == (stretch[0] < 40)


def test_a_short_recording_is_drawn_in_fifths() -> None:
    seen: list[Indices] = []

    def note(rows: Indices) -> float:
        seen.append(rows)
        return 1.0

    interval_of_recordings([10], note, block=15, draws=20)
    assert all((np.diff(rows.reshape(-1, 2)) == 1).all() for rows in seen) and len({tuple(rows) for rows in seen}) > 5


def test_near_copies_do_not_narrow_the_interval() -> None:
    values = np.repeat(np.random.default_rng(1).normal(0, 1, 20), 15)
    stretches = interval_of_recordings([300], lambda rows: float(values[rows].mean()), block=15)
    frames = interval_of_recordings([300], lambda rows: float(values[rows].mean()), block=1)
    assert stretches[1] - stretches[0] > 2.5 * (frames[1] - frames[0])
