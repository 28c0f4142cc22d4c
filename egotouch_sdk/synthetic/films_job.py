"""Renders a data set of training films, shard by shard, on processes of this machine or on a cluster; stop and start it as you like."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from egotouch_sdk.jobs import Batch, BatchResult, Runner, Task, run_jobs
from egotouch_sdk.synthetic.film_shards import write_films
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.patches_job import claim, participant
from egotouch_sdk.synthetic.stage import ImpossibleSceneError
from egotouch_sdk.synthetic.training_film import LabelledFilm, render_films

SCENES_PER_SHARD = 4


@dataclass(frozen=True, slots=True)
class FilmsJob:
    """What a data set of films is made of; the same job gives the same films whatever renders them, and how many.

    `scenes` have two films each. Its people are `first_participant` and those after: sets that must not share anybody begin at
    different numbers.
    """

    seed: int
    scenes: int
    participants: int
    samples: int
    first_participant: int = 0

    @property
    def shards(self) -> int:
        """Number of shard files."""
        return -(-self.scenes // SCENES_PER_SHARD)


def render_film_shard(path: Path, job: FilmsJob, shard: int) -> int:
    """Render one shard, write it to `path` and return its number of frames; every shard has one participant."""
    number = job.first_participant + shard % job.participants
    identity = participant(number)
    host, touching = HandRig("left"), HandRig("right")
    films: list[LabelledFilm] = []
    for index in range(shard * SCENES_PER_SHARD, min((shard + 1) * SCENES_PER_SHARD, job.scenes)):
        try:
            rendered = render_films(np.random.default_rng([job.seed, index, 21]), host, touching, identity, job.samples, index)
        except ImpossibleSceneError:
            continue
        extra = {"participant": number, "fitzpatrick": identity.fitzpatrick, "scene": f"{job.seed}-{index}"}
        films += [LabelledFilm(each.layers, {**each.labels, **extra}) for each in rendered]
    write_films(path, films)
    return sum(len(each.labels["shown"]) for each in films)


def run_films(job: FilmsJob, out: Path, runner: Runner, report: Callable[[str], None]) -> BatchResult:
    """Render every missing shard of `job` into `out`; the result's `counted` is the number of new frames.

    `report` gets one line per finished shard. Raises `ConfigError` when `out` holds another job's data.
    """
    claim(job, out, f"films-{job.seed}.json")
    shards = tuple(Task(f"films-{job.seed}-{k:05d}.npz", render_film_shard, (job, k)) for k in range(job.shards))
    return run_jobs(Batch(f"films-{job.seed}", out, shards, "shards", "frames"), runner, report)

