from __future__ import annotations

import random
from itertools import pairwise
from math import isnan, sqrt
from statistics import fmean, stdev

import numpy as np
import pytest

from egotouch_sdk.evaluation.round_score import RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import answer
from egotouch_sdk.evaluation.study_score import Spread, by_participant, figures, frame_figures, groups, height_names, worst
from egotouch_sdk.study_data import TouchType
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch import TouchModel
from tests.support.study import signal_model, study_round

GOOD = "....######.....######...."
BAD = "....######..............."


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(signal_model(tmp_path_factory.mktemp("model")))


def scored(model: TouchModel, touch: str, told: object = None, **options: object) -> RoundScore:
    study = study_round(touch, told, **options)  # type: ignore[arg-type]
    return score_round(Truth.of(study), answer(study, model), 0.6)


def noisy_rounds(model: TouchModel, count: int = 6) -> list[RoundScore]:
    rng = random.Random(4)
    rounds = []
    for number in range(count):
        touch = "".join(rng.choice(["....", "######", "........"]) for _ in range(8))
        logits = [rng.gauss(1.5 if letter == "#" else -1.5, 1.5) for letter in touch]
        rounds.append(scored(model, touch, logits, participant=number % 3, round=number))
    return rounds


def test_rank_and_calibration_figures_are_those_of_scikit_learn(model: TouchModel) -> None:
    metrics = pytest.importorskip("sklearn.metrics")
    rounds = noisy_rounds(model)
    told = figures(rounds)
    touch, probability = (np.concatenate([getattr(each, name) for each in rounds]) for name in ("touch", "probability"))
    live = np.concatenate([each.live for each in rounds])
    assert told["auroc"] == pytest.approx(metrics.roc_auc_score(touch, probability))
    assert told["auprc"] == pytest.approx(metrics.average_precision_score(touch, probability))
    assert told["accuracy"] == pytest.approx(metrics.accuracy_score(touch, live))
    assert told["tpr"] == pytest.approx(metrics.recall_score(touch, live))
    assert told["hover_rejection"] == pytest.approx(metrics.recall_score(~touch, ~live)) == pytest.approx(1 - told["fpr"])
    edges = np.linspace(0, 1, 11)
    inside = [(probability >= low) & (probability < high if high < 1 else probability <= 1) for low, high in pairwise(edges)]
    gaps = [abs(touch[part].mean() - probability[part].mean()) * part.mean() for part in inside if part.any()]
    assert told["ece"] == pytest.approx(sum(gaps))


def test_every_side_is_told_with_and_without_the_paper_s_shift(model: TouchModel) -> None:
    rows = frame_figures([scored(model, GOOD)])
    assert list(rows) == [f"{side}{kind}" for side in ("raw", "median", "live") for kind in ("", " +1", " aligned")]
    assert rows["raw"]["accuracy"] == rows["live +1"]["accuracy"] == rows["live aligned"]["accuracy"] == 1.0
    assert rows["live"]["accuracy"] == pytest.approx(21 / 25) and rows["live"]["tpr"] == pytest.approx(10 / 12)


def test_clicks_chatter_and_false_touches(model: TouchModel) -> None:
    rounds = [
        scored(model, GOOD),
        scored(model, "..############....", "..#####..#####...."),
        scored(model, "." * 30, "...#####" + "." * 22),
    ]
    told = figures(rounds)
    assert told["click_accuracy"] == pytest.approx(2 / 3) and told["chatter_per_touch"] == pytest.approx(1 / 3)
    assert told["false_touches_per_minute"] == pytest.approx(1 / (73 / 30 / 60))
    assert isnan(told["drag_dropouts_per_s"])


def test_drop_outs_are_told_per_second_of_dragging(model: TouchModel) -> None:
    dropped = scored(model, "..############..", "..#####..#####..", touch_type=TouchType.DRAG)
    assert figures([dropped, scored(model, GOOD)])["drag_dropouts_per_s"] == pytest.approx(1 / (12 / 30))


def test_onsets_are_one_frame_late_and_known(model: TouchModel) -> None:
    told = figures([scored(model, GOOD)])
    assert (told["onset_f1_0"], told["onset_f1_0_shifted"], told["onset_f1_1"], told["offset_f1_4"]) == (0.0, 1.0, 1.0, 1.0)
    assert told["onset_delay_ms_median"] == pytest.approx(33.3, abs=0.1) and told["onset_jitter_ms"] == pytest.approx(0, abs=0.1)
    assert (told["event_ap_0"], told["event_ap_1"]) == (0.0, 1.0)


def test_force_errors_in_newtons_of_the_range_and_relative(model: TouchModel) -> None:
    told = figures([scored(model, "..##########..", force_n=2.0, told_force_n=1.3)])
    errors = [2.0] + [0.7] * 9
    assert told["force_mae_n"] == pytest.approx(fmean(errors), rel=1e-5)
    assert told["force_mae_range_percent"] == pytest.approx(fmean(errors) / 3.5 * 100, rel=1e-5)
    assert told["force_mae_relative_percent"] == pytest.approx(fmean(errors) / 2.0 * 100, rel=1e-5)
    assert told["soft_hard_frames"] == pytest.approx(0.9) and told["soft_hard_touches"] == 1.0
    soft = figures([scored(model, "..##########..", force_n=0.6, told_force_n=1.3)])
    assert soft["soft_hard_touches"] == 0.0


def test_hovers_are_told_by_height(model: TouchModel) -> None:
    heights = {0.5: "hover_0_1_mm", 1.0: "hover_1_2_mm", 3.0: "hover_2_5_mm", 5.0: "hover_5_10_mm", 40.0: "hover_over_10_mm"}
    assert height_names() == list(heights.values())
    wrong = "...#####" + "." * 8
    for height_mm, name in heights.items():
        rounds = [scored(model, "." * 16, wrong, hover_mm=height_mm, touch_type=TouchType.HOVER)]
        rounds += [scored(model, "." * 16, hover_mm=other) for other in heights if other != height_mm]
        told = figures(rounds)
        assert {each for each in height_names() if told[each] < 1.0} == {name}
        assert told[name] == told["hover_round_rejection"] == pytest.approx(11 / 16)
        assert told["hover_rejection"] == pytest.approx(1 - 5 / 80)


def test_unmeasured_forces_and_heights_are_left_out(model: TouchModel) -> None:
    study = study_round(GOOD)
    truth = Truth.of(study)
    blind = Truth(
        **{name: getattr(truth, name) for name in Truth.__slots__ if name not in {"force_n", "hover_mm"}},
        force_n=np.full(len(GOOD), np.nan),
        hover_mm=np.full(len(GOOD), np.nan),
    )
    told = figures([score_round(blind, answer(study, model), 0.6)])
    assert told["click_accuracy"] == 1.0 and told["hover_rejection"] == pytest.approx(11 / 13)
    assert all(isnan(told[name]) for name in ("force_mae_n", "soft_hard_frames", "soft_hard_touches", *height_names()))


def test_groups_compare_the_values_of_a_condition(model: TouchModel) -> None:
    rounds = [scored(model, GOOD, participant=p, place=place) for p in (0, 1) for place in (Surface.PALM, Surface.BACK_OF_HAND)]
    rounds.append(scored(model, GOOD, BAD, participant=1, round=9, place=Surface.INNER_FOREARM))
    parts = groups(rounds, "place")
    assert [(part.name, part.rounds, list(part.accuracies)) for part in parts] == [
        ("palm", 2, ["p00", "p01"]),
        ("back_of_hand", 2, ["p00", "p01"]),
        ("inner_forearm", 1, ["p01"]),
    ]
    weakest = worst(parts)
    assert weakest is not None and weakest.name == "inner_forearm" and weakest.figures["click_accuracy"] == 0.5
    assert worst(groups(rounds, "light")) is None and groups(rounds, "altitude") == []


def test_participants_are_told_apart(model: TouchModel) -> None:
    rounds = noisy_rounds(model)
    assert {name: [each.name for each in part] for name, part in by_participant(rounds).items()} == {
        "p00": ["r000", "r003"],
        "p01": ["r001", "r004"],
        "p02": ["r002", "r005"],
    }


def test_a_spread_leaves_out_what_is_not_known() -> None:
    assert Spread.of([1.0, float("nan"), 3.0]) == Spread(2.0, stdev([1.0, 3.0]), 2)
    assert Spread.of([1.0, 3.0]).std == pytest.approx(sqrt(2))
    assert isnan(Spread.of([]).mean) and isnan(Spread.of([1.0]).std)
