"""Leave-participants-out training: each fold is a run whose model never sees its participants, not even to choose a threshold."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.jobs import Batch, BatchResult, Runner, run_jobs
from egotouch_sdk.training.export import MODEL_FILE
from egotouch_sdk.training.job import SCORES_FILE, training_task
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.run import Machine

FOLDS_FILE = "folds.json"


def deal(participants: Collection[int], folds: int, seed: int) -> tuple[tuple[int, ...], ...]:
    """Participants in `folds` groups of nearly one size, by chance: numbers in sequence may share a skin type or a hand size.

    As many folds as participants leave one out each time. Raises `ConfigError` for fewer than 2 folds or more than participants.
    """
    if not 2 <= folds <= len(set(participants)):
        raise ConfigError(
            f"{folds} folds of {len(set(participants))} participants are not possible", hint="Use 2 or more, at most one each"
        )
    order = np.random.default_rng(seed).permutation(sorted(set(participants))).tolist()
    return tuple(tuple(sorted(order[k::folds])) for k in range(folds))


def participants_in(data: Path) -> set[int]:
    """Whom the shards of a folder show; raises `SourceError` where there are none, or one that is not readable."""
    found: set[int] = set()
    for path in sorted(data.glob("*.npz")):
        try:
            with np.load(path) as arrays:
                found |= {int(meta["participant"]) for meta in json.loads(str(arrays["meta"]))}
        except (OSError, ValueError, KeyError, EOFError, BadZipFile) as problem:
            raise SourceError(f"{path.name} is not a readable shard ({problem})", hint="Delete it and render it again") from problem
    if not found:
        raise SourceError(f"no rendered patches in {data}", hint="Render some first: egotouch synth patches --help")
    return found


def train_folds(
    data: Path, out: Path, folds: int, recipe: Recipe, machine: Machine, runner: Runner, report: Callable[[str], None]
) -> BatchResult:
    """Train every missing fold into `out/fold-k` and write `out/folds.json`, which says whose model is where.

    Raises `SourceError` for unusable data and `ConfigError` when `out` holds other folds.
    """
    groups = deal(participants_in(data), folds, recipe.seed)
    plan = {"folds": [{"participants": list(group), "model": f"fold-{k}/{MODEL_FILE}"} for k, group in enumerate(groups)]}
    path = out / FOLDS_FILE
    if path.is_file() and json.loads(path.read_text()) != plan:
        raise ConfigError(f"{path} holds other folds", hint="Use another folder")
    tasks = tuple(training_task(f"fold-{k}", out, data, recipe, machine, group) for k, group in enumerate(groups))
    out.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(plan, indent=1) + "\n")
    return run_jobs(Batch("folds", out, tasks, "folds"), runner, report)


def fold_scores(out: Path) -> dict[str, dict[str, Any]]:
    """Scores of the finished folds on their own participants, by fold."""
    found = sorted(out.glob(f"fold-*/{SCORES_FILE}"), key=lambda path: int(path.parent.name.removeprefix("fold-")))
    return {path.parent.name: json.loads(path.read_text()) for path in found}
