"""One training run as a job: in a folder of its own, with a log, going on from its last epoch after an interruption."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.jobs import Task
from egotouch_sdk.training.checkpoints import LAST_CHECKPOINT
from egotouch_sdk.training.folder import read_folder
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.run import Machine, train
from egotouch_sdk.training.score import score_model

#: What was asked of the run, its output, and its scores on participants that were left out.
PLAN_FILE, LOG_FILE, SCORES_FILE = "run.json", "train.log", "left_out.json"


def training_task(name: str, out: Path, data: Path, recipe: Recipe, machine: Machine, left_out: tuple[int, ...] = ()) -> Task:
    """The task that makes the folder `out/name`; raises `ConfigError` when there is one of another recipe or other participants."""
    plan = _plan(recipe, left_out)
    finished = out / name / PLAN_FILE
    if finished.is_file() and json.loads(finished.read_text()) != plan:
        raise ConfigError(f"{out / name} holds a run with other settings", hint="Delete it, or use another name or folder")
    return Task(name, train_in_folder, (data.absolute(), recipe, machine, left_out), resumable=True)


def train_in_folder(folder: Path, data: Path, recipe: Recipe, machine: Machine, left_out: tuple[int, ...]) -> None:
    """Train in `folder`, or go on from the checkpoint there; then score on the patches of the participants `left_out`."""
    plan, checkpoint = json.dumps(_plan(recipe, left_out), indent=1), folder / LAST_CHECKPOINT
    if not (folder / PLAN_FILE).is_file() or (folder / PLAN_FILE).read_text() != plan:
        checkpoint.unlink(missing_ok=True)
        (folder / PLAN_FILE).write_text(plan)
    with _output_to(folder / LOG_FILE):
        model = train(data, folder, recipe, machine, resume=checkpoint.is_file(), left_out=left_out)
        if left_out:
            strangers = [patch for patch in read_folder(data) if patch.label.participant in left_out]
            scores = score_model(model, strangers, recipe.held_out_views, recipe.seed, machine.threads)
            (folder / SCORES_FILE).write_text(json.dumps(scores, indent=1) + "\n")


def _plan(recipe: Recipe, left_out: tuple[int, ...]) -> dict[str, Any]:
    return {"recipe": recipe.to_dict(), "left_out": list(left_out)}


@contextmanager
def _output_to(log: Path) -> Iterator[None]:
    """Everything that this process and its children print goes to the end of `log`."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = os.dup(1), os.dup(2)
    with log.open("ab", buffering=0) as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    try:
        yield
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        for saved, descriptor in zip(kept, (1, 2), strict=True):
            os.dup2(saved, descriptor)
            os.close(saved)
