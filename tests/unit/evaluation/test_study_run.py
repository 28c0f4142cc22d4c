from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.config import StateConfig
from egotouch_sdk.evaluation.study_run import Answers, answer
from egotouch_sdk.study_data import StudyRound
from egotouch_sdk.touch import TouchModel
from tests.support.study import memory_model, signal_model, study_round


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(signal_model(tmp_path_factory.mktemp("model")))


def live(answers: Answers) -> str:
    return "".join("#" if touching else "." for touching in answers.live)


def test_the_median_shows_a_touch_and_a_lift_one_frame_late(model: TouchModel) -> None:
    assert live(answer(study_round("....####......"), model)) == ".....####....."


def test_a_single_wrong_frame_never_shows(model: TouchModel) -> None:
    assert live(answer(study_round("....######....", "..#..#.###...."), model)) == ".......####..."


def test_the_models_own_answers_are_kept_beside_the_medians(model: TouchModel) -> None:
    answers = answer(study_round("..##..", "..#...", told_force_n=2.5), model)
    assert (answers.probability > 0.5).tolist() == [False, False, True, False, False, False]
    assert answers.force_n.tolist() == [0, 0, 2.5, 0, 0, 0]
    assert (answers.median_probability > 0.5).sum() == 0 and not answers.median_force_n.any()


def test_a_touch_goes_on_for_two_frames_behind_a_closed_gate_and_ends_at_the_third(model: TouchModel) -> None:
    answers = answer(study_round("...####xx##...", "...########..."), model)
    assert live(answers) == "....########.."
    assert np.isnan(answers.probability[7:9]).all() and np.isfinite(np.delete(answers.probability, [7, 8])).all()
    assert live(answer(study_round("...####xxx....", "...#######...."), model)) == "....#####....."


def test_between_the_thresholds_nothing_begins_and_nothing_ends(model: TouchModel) -> None:
    told = [-4, -4, 0, 0, 0, 4, 4, 0, 0, 0, -4, -4, -4]
    assert live(answer(study_round("." * 13, told), model)) == "......#####.."


def test_settings_come_before_the_models_thresholds(model: TouchModel) -> None:
    study = study_round("." * 8, [-4, 1, 1, 1, 1, 1, 1, 1])
    assert live(answer(study, model)) == "..######"
    assert live(answer(study, model, StateConfig(down_probability=0.9))) == "........"


def test_after_a_stall_the_past_is_forgotten(model: TouchModel) -> None:
    study = study_round("..###...", "..###...")
    times = study.timestamp_ns.copy()
    times[4:] += 400_000_000
    arrays = {name: getattr(study, name) for name in ("patches", "polar", "touch", "force_n", "hover_mm", "gate")}
    stalled = StudyRound(meta=study.meta, timestamp_ns=times, **arrays)
    assert live(answer(study, model)) == "...###.."
    assert live(answer(stalled, model)) == "...#...."


def remembered(study: StudyRound, folder: Path, config: StateConfig | None = None) -> list[int | None]:
    """How many frames of the finger a model with memory had in mind, in each frame; None behind a closed gate."""
    told_n = answer(study, TouchModel(memory_model(folder)), config).force_n
    return [None if np.isnan(force_n) else round(force_n / 0.1) for force_n in told_n]


def test_a_model_with_memory_is_shown_a_round_as_a_film(tmp_path: Path) -> None:
    assert remembered(study_round("..##.."), tmp_path) == [1, 2, 3, 4, 5, 6]
    answers = answer(study_round("..##..", [3.0, 3.0, 3.0, -1.0, -1.0, -1.0]), TouchModel(memory_model(tmp_path)))
    assert (answers.probability > 0.5).tolist() == [True] * 6


def test_every_round_is_a_film_of_its_own(tmp_path: Path) -> None:
    model = TouchModel(memory_model(tmp_path))
    assert answer(study_round("..#"), model).force_n.tolist() == answer(study_round("..#"), model).force_n.tolist()


def test_a_finger_behind_a_gate_that_is_closed_for_too_long_is_forgotten(tmp_path: Path) -> None:
    assert remembered(study_round(".#xxx##"), tmp_path) == [1, 2, None, None, None, 3, 4]
    assert remembered(study_round(".#xxxx##"), tmp_path) == [1, 2, None, None, None, None, 1, 2]


def test_a_model_with_memory_forgets_after_a_stall(tmp_path: Path) -> None:
    study = study_round("..####")
    times = study.timestamp_ns.copy()
    times[3:] += 90_000_000
    jerky = replace(study, timestamp_ns=times)
    assert remembered(jerky, tmp_path) == [1, 2, 3, 4, 5, 6]
    assert remembered(jerky, tmp_path, StateConfig(stall_ms=100.0)) == [1, 2, 3, 1, 2, 3]
