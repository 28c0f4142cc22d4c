"""A study's participants scored by several workers: processes of this machine, or a Ray cluster."""

from __future__ import annotations

import pickle
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.round_score import RoundScore
from egotouch_sdk.evaluation.study import ParticipantTask, in_order, score_participant
from egotouch_sdk.jobs import Batch, Runner, Task, run_jobs


def score_study_on(runner: Runner, work: Sequence[ParticipantTask], report: Callable[[str], None]) -> list[RoundScore]:
    """Score all tasks on a runner, in the order of participants and rounds; the runner is closed afterwards.

    The study's and the models' folders must be at the same path for every worker. `report` gets a line for each participant.
    Raises `SourceError` naming a participant who could not be scored, and why.
    """
    with tempfile.TemporaryDirectory(prefix="egotouch-evaluate-") as folder:
        tasks = tuple(Task(f"p{task.participant:02d}", score_into, (_absolute(task),)) for task in work)
        result = run_jobs(Batch("evaluate", Path(folder), tasks, noun="participants", unit="rounds"), runner, report)
        if result.failures:
            first = result.failures[0]
            raise SourceError(f"{first.name} could not be scored: {first.error}", hint="Mend it and start again")
        return in_order(score for task in tasks for score in pickle.loads((Path(folder) / task.name).read_bytes()))


def score_into(scratch: Path, task: ParticipantTask) -> int:
    """Score one participant, write the scores to a file for the batch that asked, and return how many rounds it had."""
    scores = score_participant(task)
    scratch.write_bytes(pickle.dumps(scores))
    return len(scores)


def _absolute(task: ParticipantTask) -> ParticipantTask:
    files = tuple(file.absolute() for file in task.files)
    return replace(task, files=files, model=None if task.model is None else task.model.absolute())
