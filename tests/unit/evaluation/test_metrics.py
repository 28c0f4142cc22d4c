import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.errors import FrameError
from egotouch_sdk.evaluation.darkness import darkness
from egotouch_sdk.evaluation.metrics import auroc, calibration_error, force_scores, ranks, spearman, touch_scores


def test_auroc_of_known_orders() -> None:
    touch = np.array([True, True, False, False])
    assert auroc(touch, np.array([4.0, 3.0, 2.0, 1.0])) == 1.0
    assert auroc(touch, np.array([1.0, 2.0, 3.0, 4.0])) == 0.0
    assert auroc(touch, np.array([4.0, 1.0, 3.0, 2.0])) == 0.5
    assert auroc(touch, np.ones(4)) == 0.5


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 5)), min_size=4, max_size=40))
def test_auroc_is_the_share_of_ordered_pairs(rows: list[tuple[bool, int]]) -> None:
    touch, score = np.array([r[0] for r in rows]), np.array([float(r[1]) for r in rows])
    if touch.all() or not touch.any():
        with pytest.raises(FrameError):
            auroc(touch, score)
        return
    pairs = [(a > b) + 0.5 * (a == b) for a in score[touch] for b in score[~touch]]
    assert auroc(touch, score) == pytest.approx(np.mean(pairs))


def test_ranks_share_ties() -> None:
    assert ranks(np.array([10.0, 20.0, 20.0, 5.0])).tolist() == [2.0, 3.5, 3.5, 1.0]


def test_spearman_sees_order_only() -> None:
    x = np.arange(10.0)
    assert spearman(x, x**3) == pytest.approx(1.0)
    assert spearman(x, -np.exp(x)) == pytest.approx(-1.0)
    assert np.isnan(spearman(x, np.zeros(10)))


def test_touch_scores_count_at_the_threshold() -> None:
    scores = touch_scores(np.array([True, True, False, False]), np.array([0.5, 0.4, 0.6, 0.1]), 0.5)
    assert (scores.accuracy, scores.true_positive_rate, scores.false_positive_rate) == (0.5, 0.5, 0.5)


def test_force_scores_in_three_units() -> None:
    scores = force_scores(np.array([1.0, 2.0, 3.0]), np.array([1.5, 2.0, 2.5]))
    assert scores.mae_n == pytest.approx(1 / 3)
    assert scores.mae_range_percent == pytest.approx(100 / 3 / 3.5)
    assert scores.mae_relative_percent == pytest.approx((50 + 0 + 100 / 6) / 3)
    assert scores.constant_mae_n == pytest.approx(2 / 3)
    assert scores.spearman == pytest.approx(1.0)


def test_calibration_error_of_a_liar_and_of_an_honest_one() -> None:
    touch = np.arange(100) < 20
    assert calibration_error(touch, np.full(100, 0.2)) == pytest.approx(0.0)
    assert calibration_error(touch, np.full(100, 0.9)) == pytest.approx(0.7)


def test_darkness_prefers_the_patch_with_a_dark_outline() -> None:
    flat = np.full((100, 100, 3), 150, np.uint8)
    outlined = flat.copy()
    outlined[40:60, 20:60] = 40
    scores = darkness(np.stack([flat, outlined]))
    assert scores[1] > scores[0]
