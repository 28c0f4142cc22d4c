"""Renders a data set of patches, shard by shard, on several processes; stop and start it as you like."""

from __future__ import annotations

import json
import multiprocessing as mp
import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from egotouch_sdk.clock import now_ns
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.series import LabelledLayers, render_series
from egotouch_sdk.synthetic.shards import write_shard
from egotouch_sdk.synthetic.skin import SkinIdentity, bake_identity
from egotouch_sdk.synthetic.stage import ImpossibleSceneError

SERIES_PER_SHARD = 8
#: Skin types of the participants in turn: mostly II to IV as in the paper's study, every type present (our choice).
_FITZPATRICK = (3.0, 2.0, 3.4, 4.0, 2.6, 5.0, 3.2, 1.3, 3.8, 6.0, 2.3, 4.4)


@dataclass(frozen=True, slots=True)
class PatchJob:
    """What a data set is made of; the same job gives the same patches whatever the number of processes."""

    seed: int
    series: int
    participants: int
    samples: int

    @property
    def shards(self) -> int:
        """Number of shard files."""
        return -(-self.series // SERIES_PER_SHARD)


def participant(number: int) -> SkinIdentity:
    """The skin of participant `number` (0, 1, …); baked once, about 10 s, then read from the cache."""
    return bake_identity(number, _FITZPATRICK[number % len(_FITZPATRICK)])


def render_shard(job: PatchJob, shard: int, out: Path) -> int:
    """Render one shard into `out` and return its number of patches; every shard has one participant."""
    number = shard % job.participants
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
    write_shard(out / f"shard-{job.seed}-{shard:05d}.npz", patches)
    return len(patches)


def _start_worker() -> None:
    os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"


def run(job: PatchJob, out: Path, workers: int, report: Callable[[str], None]) -> int:
    """Render every missing shard of `job` into `out`; returns the number of new patches.

    `report` gets one line per finished shard. Raises `ConfigError` when `out` holds another job's data.
    """
    out.mkdir(parents=True, exist_ok=True)
    recipe = out / f"job-{job.seed}.json"
    if recipe.exists() and json.loads(recipe.read_text()) != asdict(job):
        raise ConfigError(f"{out} holds another job with seed {job.seed}: {recipe.read_text().strip()}", hint="Use another folder or seed")
    recipe.write_text(json.dumps(asdict(job)) + "\n")
    missing = [k for k in range(job.shards) if not (out / f"shard-{job.seed}-{k:05d}.npz").exists()]
    report(f"{job.shards - len(missing)} of {job.shards} shards are there, {len(missing)} to render on {workers} processes")
    started_ns, made = now_ns(), 0
    pool = ProcessPoolExecutor(workers, mp_context=mp.get_context("spawn"), initializer=_start_worker)
    try:
        futures = [pool.submit(render_shard, job, k, out) for k in missing]
        for done, future in enumerate(as_completed(futures), 1):
            made += future.result()
            elapsed_s = (now_ns() - started_ns) / 1e9
            rate = made / elapsed_s * 3600
            left_min = (len(missing) - done) / max(done, 1) * elapsed_s / 60
            report(f"shard {done}/{len(missing)}: {made} patches, {rate:.0f} per hour, {left_min:.0f} min left")
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
    return made
