"""Trials: one training run for each of several recipes, on the same data and the same held-out participants."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.jobs import Batch, BatchResult, Runner, run_jobs
from egotouch_sdk.training.job import training_task
from egotouch_sdk.training.model_card import MANIFEST_FILE
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.run import Machine

_FORM = "[recipe] for all and one [trials.NAME] each, with fields of the recipe such as epochs = 8"
#: Fields that choose whom a run is scored on: scores of different people cannot be compared.
_COMMON = ("held_out_share", "held_out_views")


def read_trials(path: Path, base: Recipe) -> dict[str, Recipe]:
    """The recipes of a TOML file by name: `base`, with what `[recipe]` says, with what `[trials.NAME]` says.

    Raises `ConfigError` naming the table and the field that is wrong.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise ConfigError(f"cannot read the trials in {path} ({problem})", hint=f"It holds {_FORM}") from problem
    trials = content.get("trials")
    if set(content) - {"recipe", "trials"} or not isinstance(trials, dict) or not trials:
        raise ConfigError(f"{path} holds no list of trials", hint=f"It holds {_FORM}")
    common = _changed(base, content.get("recipe", {}), "recipe")
    recipes = {}
    for name, changes in trials.items():
        recipes[name] = _changed(common, changes, f"trials.{name}")
        if differing := [field for field in _COMMON if getattr(recipes[name], field) != getattr(common, field)]:
            raise ConfigError(f"[trials.{name}] in {path} changes {differing[0]}", hint="Set it in [recipe], the same for all")
    return recipes


def _changed(recipe: Recipe, changes: Mapping[str, Any], table: str) -> Recipe:
    if not isinstance(changes, Mapping):
        raise ConfigError(f"{table} is not a table", hint=f"The file holds {_FORM}")
    known = [field.name for field in fields(Recipe)]
    if unknown := sorted(set(changes) - set(known)):
        raise ConfigError(f"[{table}] has the unknown field {unknown[0]}", hint=f"A recipe has {', '.join(known)}")
    try:
        return replace(recipe, **changes)
    except TypeError as problem:
        raise ConfigError(f"[{table}] has a value of the wrong type ({problem})") from problem


def train_trials(
    data: Path, out: Path, recipes: Mapping[str, Recipe], machine: Machine, runner: Runner, report: Callable[[str], None]
) -> BatchResult:
    """Train every missing trial into `out/NAME`; raises `ConfigError` when a folder of that name holds another recipe's run."""
    tasks = tuple(training_task(name, out, data, recipe, machine) for name, recipe in recipes.items())
    return run_jobs(Batch("trials", out, tasks, "trials"), runner, report)


def trial_scores(out: Path, names: Iterable[str]) -> dict[str, dict[str, Any]]:
    """Held-out scores of the finished trials by name, best AUROC first."""
    manifests = {name: out / name / MANIFEST_FILE for name in names}
    scores = {name: json.loads(path.read_text())["measured"]["held_out_renders"] for name, path in manifests.items() if path.is_file()}
    return dict(sorted(scores.items(), key=lambda item: item[1]["auroc"], reverse=True))
