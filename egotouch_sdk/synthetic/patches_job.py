"""Renders a data set of patches, shard by shard, on processes of this machine or on a cluster; stop and start it as you like."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.jobs import Batch, BatchResult, Runner, Task, run_jobs
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.series import LabelledLayers, render_series
from egotouch_sdk.synthetic.shards import write_shard
from egotouch_sdk.synthetic.skin import SkinIdentity, bake_identity
from egotouch_sdk.synthetic.stage import ImpossibleSceneError

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

SERIES_PER_SHARD = 8
#: Skin types of the participants in turn: mostly II to IV as in the paper's study, every type present (our choice).
_FITZPATRICK = (3.0, 2.0, 3.4, 4.0, 2.6, 5.0, 3.2, 1.3, 3.8, 6.0, 2.3, 4.4)


@dataclass(frozen=True, slots=True)
class PatchJob:
    """What a data set is made of; the same job gives the same patches whatever renders them, and how many.

    Its people are `first_participant` and those after: sets that must not share anybody begin at different numbers.
    """

    seed: int
    series: int
    participants: int
    samples: int
    first_participant: int = 0

    @property
    def shards(self) -> int:
        """Number of shard files."""
        return -(-self.series // SERIES_PER_SHARD)


def participant(number: int) -> SkinIdentity:
    """The skin of participant `number` (0, 1, …); baked once, about 10 s, then read from the cache."""
    return bake_identity(number, _FITZPATRICK[number % len(_FITZPATRICK)])


def render_shard(path: Path, job: PatchJob, shard: int) -> int:
    """Render one shard, write it to `path` and return its number of patches; every shard has one participant."""
    number = job.first_participant + shard % job.participants
    identity = participant(number)
    host, touching = HandRig("left"), HandRig("right")
    patches: list[LabelledLayers] = []
    for index in range(shard * SERIES_PER_SHARD, min((shard + 1) * SERIES_PER_SHARD, job.series)):
        try:
            rendered = render_series(np.random.default_rng([job.seed, index]), host, touching, identity, job.samples, index)
        except ImpossibleSceneError:
            continue
        extra = {"participant": number, "fitzpatrick": identity.fitzpatrick, "scene": f"{job.seed}-{index}"}
        patches += [LabelledLayers(p.layers, {**p.labels, **extra}) for p in rendered]
    write_shard(path, patches)
    return len(patches)


def run(job: PatchJob, out: Path, runner: Runner, report: Callable[[str], None]) -> BatchResult:
    """Render every missing shard of `job` into `out`; the result's `counted` is the number of new patches.

    `report` gets one line per finished shard. Raises `ConfigError` when `out` holds another job's data.
    """
    claim(job, out, f"job-{job.seed}.json")
    shards = tuple(Task(f"shard-{job.seed}-{k:05d}.npz", render_shard, (job, k)) for k in range(job.shards))
    return run_jobs(Batch(f"job-{job.seed}", out, shards, "shards", "patches"), runner, report)


def claim(job: DataclassInstance, out: Path, name: str) -> None:
    """Note in the folder `out` which job fills it; raises `ConfigError` when that file says another."""
    out.mkdir(parents=True, exist_ok=True)
    recipe = out / name
    if recipe.exists() and json.loads(recipe.read_text()) != asdict(job):
        raise ConfigError(f"{out} holds another job: {recipe.read_text().strip()}", hint="Use another folder or seed")
    recipe.write_text(json.dumps(asdict(job)) + "\n")
