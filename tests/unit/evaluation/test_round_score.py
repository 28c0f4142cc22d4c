from __future__ import annotations

import numpy as np
import pytest

from egotouch_sdk.evaluation.confusion import Confusion, Matches
from egotouch_sdk.evaluation.round_score import RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import answer
from egotouch_sdk.joints import Finger
from egotouch_sdk.study_data import TouchType
from egotouch_sdk.touch import TouchModel
from tests.support.study import signal_model, study_round

DOWN = 0.6


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(signal_model(tmp_path_factory.mktemp("model")))


def scored(model: TouchModel, touch: str, told: str | None = None, **options: object) -> RoundScore:
    study = study_round(touch, told, **options)
    return score_round(Truth.of(study), answer(study, model), DOWN)


def test_a_perfect_model_is_right_but_for_the_medians_frame(model: TouchModel) -> None:
    score = scored(model, "....######....")
    assert score.frames["raw", 0] == Confusion(tp=6, tn=8)
    assert score.frames["median", 0] == score.frames["live", 0] == Confusion(tp=5, fn=1, fp=1, tn=7)
    assert score.frames["live", 1] == Confusion(tp=6, tn=7)
    assert all(score.aligned[side].accuracy == 1.0 for side in ("raw", "median", "live"))
    assert (score.touches, score.clicks, score.extra, score.merged, score.false_touches, score.unseen) == (1, 1, 0, 0, 0, 0)
    assert score.onsets[0, 0] == score.offsets[0, 0] == Matches(0, 1, 1)
    assert score.onsets[0, 1] == score.onsets[1, 0] == score.offsets[1, 0] == Matches(1, 0, 0)
    assert score.onset_delay_ms == pytest.approx([33.3], abs=0.1) and score.offset_delay_ms == pytest.approx([33.3], abs=0.1)


def test_a_touch_that_drops_out_has_an_extra_touch_and_no_click(model: TouchModel) -> None:
    score = scored(model, "..############..", "..#####..#####..")
    assert (score.touches, score.clicks, score.extra, score.false_touches) == (1, 0, 1, 0)
    assert score.contact_s == pytest.approx(12 / 30) and score.onset_delay_ms.size == 0


def test_touches_told_as_one_are_merged(model: TouchModel) -> None:
    score = scored(model, "..###.###..", "..#######..")
    assert (score.touches, score.clicks, score.merged) == (2, 0, 2)


def test_a_false_touch_is_counted(model: TouchModel) -> None:
    score = scored(model, ".................", "...#####.........", touch_type=TouchType.HOVER)
    assert (score.touches, score.false_touches, score.onsets[4, 0]) == (0, 1, Matches(0, 0, 1))
    assert score.frames["live", 0].fp == 5 and score.is_hover and not score.is_drag


def test_a_touch_that_begins_as_the_round_ends_counts_in_frames_only(model: TouchModel) -> None:
    score = scored(model, "....#####........###")
    assert (score.touches, score.clicks, score.cut, score.false_touches) == (1, 1, 1, 0)
    assert score.frames["raw", 0] == Confusion(tp=8, tn=12)
    assert score.onsets[1, 0] == score.offsets[1, 0] == Matches(1, 0, 0) and (score.candidates.score > 0.5).sum() == 1


def test_a_touch_that_goes_on_when_the_round_ends_has_an_onset_and_no_offset(model: TouchModel) -> None:
    score = scored(model, "....#####........#######")
    assert (score.touches, score.clicks, score.cut) == (2, 2, 0)
    assert score.onsets[1, 0] == Matches(2, 0, 0) and score.offsets[1, 0] == Matches(1, 0, 0)
    assert (len(score.onset_delay_ms), len(score.offset_delay_ms)) == (2, 1)


def test_a_touch_that_goes_on_from_before_has_an_offset_and_no_onset(model: TouchModel) -> None:
    score = scored(model, "#####......#####....")
    assert (score.touches, score.clicks) == (2, 2)
    assert score.onsets[1, 0] == Matches(1, 0, 0) and score.offsets[1, 0] == Matches(2, 0, 0)
    assert (len(score.onset_delay_ms), len(score.offset_delay_ms), score.candidates.true_onsets) == (1, 2, 1)


def test_closed_frames_are_not_counted(model: TouchModel) -> None:
    study = study_round("...####xx....")
    truth = Truth.of(study)
    assert not truth.touch[7:9].any()
    score = score_round(truth, answer(study, model), DOWN)
    assert score.frames["raw", 0].total == len(score.touch) == len(score.probability) == 11
    assert score.frames["raw", 1].total == 10 and score.seconds == pytest.approx(11 / 30)


def test_forces_are_compared_on_open_frames_and_at_their_peak(model: TouchModel) -> None:
    score = scored(model, "..######..", force_n=1.5, told_force_n=0.8)
    assert score.true_n[score.touch] == pytest.approx([1.5] * 6)
    assert score.told_n[score.touch] == pytest.approx([0, 0.8, 0.8, 0.8, 0.8, 0.8])
    assert score.peaks_n == pytest.approx(np.array([[1.5, 0.8]]))


def test_conditions_come_from_the_rounds_meta(model: TouchModel) -> None:
    score = scored(model, "..##..", participant=7, round=12, fitzpatrick=5, finger=Finger.RING, walking=True, touch_type=TouchType.DRAG)
    assert (score.participant, score.name, score.is_drag) == ("p07", "r012", True)
    assert score.conditions == {
        "skin tone": "V",
        "hair": "sparse",
        "place": "palm",
        "touch type": "drag",
        "light": "lamp",
        "setting": "indoors",
        "motion": "walking",
        "finger": "ring",
        "touching hand": "right",
    }


def test_a_round_without_a_single_open_frame_counts_nothing(model: TouchModel) -> None:
    score = scored(model, "xxxx")
    assert score.frames["live", 0].total == score.touches == len(score.touch) == 0
    assert score.aligned["live"].total == 0
