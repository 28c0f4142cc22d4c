import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.evaluation.metrics import calibration_error
from egotouch_sdk.training.calibration import FALSE_TOUCH_SHARE, calibrate
from egotouch_sdk.training.recipe import Recipe


def test_an_overconfident_shifted_network_becomes_honest() -> None:
    rng = np.random.default_rng(0)
    true_logit = rng.normal(0, 2, 20000)
    touch = rng.random(20000) < 1 / (1 + np.exp(-true_logit))
    result = calibrate(touch, 4 * true_logit + 3, ~touch)
    probability = 1 / (1 + np.exp(-(result.scale * (4 * true_logit + 3) + result.shift)))
    assert calibration_error(touch, probability) < 0.02
    assert (probability[~touch] >= result.down).mean() == pytest.approx(FALSE_TOUCH_SHARE, abs=0.002)
    assert 0 < result.up < result.down


def test_both_classes_weigh_the_same() -> None:
    rng = np.random.default_rng(0)
    touch = rng.random(20000) < 0.1
    result = calibrate(touch, np.where(touch, 1.0, -1.0) + rng.normal(0, 1, 20000), ~touch)
    assert result.shift == pytest.approx(0.0, abs=0.1)


def test_perfect_separation_stays_finite() -> None:
    touch = np.arange(100) % 2 == 0
    result = calibrate(touch, np.where(touch, 5.0, -5.0), ~touch)
    assert np.isfinite([result.scale, result.shift]).all() and result.down == 0.5


@pytest.mark.parametrize(
    "bad", [{"epochs": 0}, {"learning_rate": 0.0}, {"force_weight": -1.0}, {"held_out_share": 1.0}, {"average_decay": 1.0}]
)
def test_an_impossible_recipe_is_refused(bad: dict[str, float]) -> None:
    with pytest.raises(ConfigError):
        Recipe(**bad)  # type: ignore[arg-type]


def test_the_papers_recipe() -> None:
    paper = Recipe.paper()
    assert (paper.learning_rate, paper.batch, paper.epochs, paper.force_weight) == (3e-4, 128, 8, 5.0)
    assert paper.average_decay == paper.label_smoothing == paper.hover_weight == 0.0
