from __future__ import annotations

import builtins
from math import exp, isnan

import numpy as np
import pytest

from egotouch_sdk.errors import MissingExtraError
from egotouch_sdk.evaluation.bayes import bayes_factor, between_factor, within_factor


def levels(*columns: list[float]) -> dict[str, dict[str, float]]:
    return {f"level {number}": {f"p{p:02d}": value for p, value in enumerate(column)} for number, column in enumerate(columns)}


def apart(*columns: list[float]) -> dict[str, dict[str, float]]:
    return {f"level {number}": {f"p{number}{p}": value for p, value in enumerate(column)} for number, column in enumerate(columns)}


def test_more_than_two_groups_follow_the_bic_of_statsmodels() -> None:
    models = pytest.importorskip("statsmodels.api")
    rng = np.random.default_rng(2)
    samples = [rng.normal(mean, 0.02, size).tolist() for mean, size in ((0.95, 3), (0.94, 8), (0.90, 4))]
    values = np.concatenate(samples)
    group = np.repeat(np.arange(3), [3, 8, 4])
    null = models.OLS(values, np.ones((15, 1))).fit().bic
    full = models.OLS(values, np.eye(3)[group]).fit().bic
    assert between_factor(samples) == pytest.approx(exp((null - full) / 2))
    assert bayes_factor(apart(*samples)).factor == pytest.approx(between_factor(samples))


def test_levels_within_participants_follow_the_residuals_of_statsmodels() -> None:
    models = pytest.importorskip("statsmodels.api")
    table = np.random.default_rng(3).normal(0.95, 0.01, (15, 4)) + np.array([0, 0.002, 0.004, 0.0])
    people, level = np.repeat(np.arange(15), 4), np.tile(np.arange(4), 15)
    without = models.OLS(table.ravel(), np.eye(15)[people]).fit().ssr
    with_effect = models.OLS(table.ravel(), np.hstack([np.eye(15)[people], np.eye(4)[level][:, 1:]])).fit().ssr
    observations = 15 * 3
    difference = observations * np.log(with_effect / without) + 3 * np.log(observations)
    assert within_factor(table) == pytest.approx(exp(-difference / 2))


def test_two_levels_are_the_t_test_of_pingouin() -> None:
    pingouin, stats = pytest.importorskip("pingouin"), pytest.importorskip("scipy.stats")
    rng = np.random.default_rng(5)
    first, second = rng.normal(0.95, 0.02, 15).tolist(), rng.normal(0.93, 0.02, 15).tolist()
    paired = bayes_factor(levels(first, second))
    t = stats.ttest_rel(first, second).statistic
    assert paired.factor == pytest.approx(float(pingouin.bayesfactor_ttest(t, 15, paired=True))) and paired.method == "JZS, paired"
    groups = bayes_factor(apart(first, second[:9]))
    t = stats.ttest_ind(first, second[:9]).statistic
    assert groups.factor == pytest.approx(float(pingouin.bayesfactor_ttest(t, 15, 9))) and groups.participants == 24


def test_a_strong_effect_is_far_above_one_and_none_is_below() -> None:
    rng = np.random.default_rng(6)
    same = [rng.normal(0.95, 0.01, 15).tolist() for _ in range(4)]
    assert bayes_factor(levels(*same)).factor < 1
    moved = [(np.array(column) - 0.02 * number).tolist() for number, column in enumerate(same)]
    assert bayes_factor(levels(*moved)).factor > 1000


def test_participants_who_miss_a_level_are_left_out() -> None:
    table = levels([0.9, 0.8, 0.95, 0.9], [0.91, 0.85, 0.96], [0.9, 0.82, 0.93, 0.7])
    assert bayes_factor(table).participants == 3


def test_participants_of_one_level_each_are_compared_between_and_all_others_within() -> None:
    columns = [0.9, 0.8, 0.95], [0.91, 0.85, 0.96], [0.9, 0.82, 0.93]
    assert bayes_factor(apart(*columns)).method == "BIC, between participants"
    assert bayes_factor(levels(*columns)).method == "BIC, within participants"
    assert bayes_factor({**levels(*columns[:2]), "none": {}}).method == "too few"


def test_too_few_have_no_factor() -> None:
    assert isnan(bayes_factor(levels([0.9], [0.8])).factor)
    assert isnan(bayes_factor(apart([0.9])).factor) and isnan(bayes_factor(apart([0.9], [0.8])).factor)
    assert isnan(bayes_factor({}).factor)


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    known = builtins.__import__

    def without_pingouin(name: str, *rest: object) -> object:
        if name == "pingouin":
            raise ImportError(name)
        return known(name, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(builtins, "__import__", without_pingouin)
    with pytest.raises(MissingExtraError, match=r"egotouch-sdk\[evaluation\]"):
        bayes_factor(levels([0.9, 0.8, 0.95], [0.91, 0.85, 0.96]))
