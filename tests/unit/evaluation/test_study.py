from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.folds import Folds
from egotouch_sdk.evaluation.study import score_participant, score_study, tasks
from egotouch_sdk.evaluation.study_jobs import score_study_on
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.study_data import Study, open_study
from tests.support.study import signal_model, study_round, write_study

TOUCH = "....######......"


@pytest.fixture
def study(tmp_path: Path) -> Study:
    rounds = [study_round(TOUCH, participant=p, round=r) for p in (0, 1, 2) for r in (0, 1)]
    return open_study(write_study(tmp_path / "study", rounds))


def test_every_round_of_every_participant_is_scored_once_in_order(study: Study, tmp_path: Path) -> None:
    seen: list[str] = []
    work = tasks(study, Folds({}, signal_model(tmp_path)))
    scores = score_study(work, done=lambda score: seen.append(score.name))
    assert [(score.participant, score.name) for score in scores] == [(f"p0{p}", f"r00{r}") for p in (0, 1, 2) for r in (0, 1)]
    assert all(score.frames["live", 1].accuracy == 1.0 and score.clicks == 1 for score in scores) and len(seen) == 6


def test_each_participant_is_scored_by_the_model_of_its_fold(study: Study, tmp_path: Path) -> None:
    good, wrong = signal_model(tmp_path, "good"), signal_model(tmp_path, "wrong", gain=-1.0)
    scores = score_study(tasks(study, Folds({0: good, 1: wrong, 2: good})))
    assert [score.frames["raw", 0].accuracy for score in scores] == [1, 1, 0, 0, 1, 1]


def test_a_participant_without_a_fold_is_refused(study: Study, tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="participants 1, 2 are in no fold"):
        tasks(study, Folds({0: signal_model(tmp_path)}))


def test_a_task_and_its_scores_can_be_sent_to_a_worker(study: Study, tmp_path: Path) -> None:
    task = pickle.loads(pickle.dumps(tasks(study, Folds({}, signal_model(tmp_path)))[1]))
    scores = pickle.loads(pickle.dumps(score_participant(task)))
    assert [score.name for score in scores] == ["r000", "r001"]
    np.testing.assert_array_equal(scores[0].touch, [letter == "#" for letter in TOUCH])


def test_workers_score_what_one_process_scores(study: Study, tmp_path: Path) -> None:
    work = tasks(study, Folds({}, signal_model(tmp_path)))
    lines: list[str] = []
    shared = score_study_on(LocalProcesses(2), work, lines.append)
    alone = score_study(work)
    assert [(score.participant, score.name, score.frames) for score in shared] == [(s.participant, s.name, s.frames) for s in alone]
    assert lines[0].startswith("0 of 3 participants are there, 3 to make") and len(lines) == 4


def test_a_participant_who_cannot_be_scored_is_named(study: Study, tmp_path: Path) -> None:
    (study.folder / "p01-r001.npz").write_bytes(b"no round")
    with pytest.raises(SourceError, match=r"p01 could not be scored: .*p01-r001\.npz is not a readable round"):
        score_study_on(LocalProcesses(1), tasks(study, Folds({}, signal_model(tmp_path))), lambda line: None)
