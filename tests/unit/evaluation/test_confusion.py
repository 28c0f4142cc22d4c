from __future__ import annotations

from math import isnan

import numpy as np

from egotouch_sdk.evaluation.confusion import Confusion, Matches


def test_counts_give_shares_and_add_up() -> None:
    touch, called = np.array([1, 1, 1, 0, 0], bool), np.array([1, 1, 0, 1, 0], bool)
    counts = Confusion.of(touch, called)
    assert counts == Confusion(tp=2, fn=1, fp=1, tn=1)
    assert (counts.accuracy, counts.tpr, counts.fpr) == (3 / 5, 2 / 3, 1 / 2)
    assert (counts + counts).total == 10


def test_nothing_has_no_share() -> None:
    assert all(isnan(value) for value in (Confusion().accuracy, Confusion().tpr, Confusion().fpr, Matches().f1))


def test_f1_of_matches() -> None:
    assert (Matches(1, 1, 0) + Matches(1, 0, 2)).f1 == 2 * 2 / (2 * 2 + 1 + 2)
