"""Scoring a whole study, one participant after another: each is a task of its own that any worker can do."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from egotouch_sdk.config import StateConfig
from egotouch_sdk.evaluation.folds import Folds
from egotouch_sdk.evaluation.round_score import RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import answer
from egotouch_sdk.study_data import Study, read_round
from egotouch_sdk.touch import TouchModel


@dataclass(frozen=True, slots=True)
class ParticipantTask:
    """The rounds of one participant and the model (None: the shipped one) that scores them; plain data that can be sent to a worker."""

    participant: int
    files: tuple[Path, ...]
    model: Path | None
    threads: int = 1
    config: StateConfig | None = None


def tasks(study: Study, folds: Folds, threads: int = 1, config: StateConfig | None = None) -> list[ParticipantTask]:
    """One task per participant; raises `SourceError` for a participant without a fold."""
    files = study.files_of()
    folds.check(files)
    return [ParticipantTask(number, files[number], folds.model_of(number), threads, config) for number in sorted(files)]


def score_participant(task: ParticipantTask, done: Callable[[RoundScore], None] | None = None) -> list[RoundScore]:
    """Load the model and score every round of one participant; `done` is told of each.

    Raises `SourceError` for an unreadable round and `ModelError` for an unusable model.
    """
    model, scores = TouchModel(task.model, task.threads), []
    config = task.config or StateConfig()
    down = config.down_probability or model.manifest.down_probability
    for file in task.files:
        study_round = read_round(file)
        scores.append(score_round(Truth.of(study_round), answer(study_round, model, config), down))
        if done is not None:
            done(scores[-1])
    return scores


def score_study(work: Iterable[ParticipantTask], done: Callable[[RoundScore], None] | None = None) -> list[RoundScore]:
    """Score all tasks here, one after another, in the order of participants and rounds; `done` is told of each round."""
    return in_order(score for task in work for score in score_participant(task, done))


def in_order(scores: Iterable[RoundScore]) -> list[RoundScore]:
    """Scores by participant and round, whoever was ready first."""
    return sorted(scores, key=lambda score: (score.participant, score.name))
