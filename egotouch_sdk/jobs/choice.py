"""Which runner a command uses."""

from __future__ import annotations

from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.jobs.ray_cluster import RayCluster
from egotouch_sdk.jobs.runner import Runner


def open_runner(workers: int, ray_address: str | None, cpus: int = 1, gpus: float = 0.0) -> Runner:
    """`workers` processes of this machine, or the Ray cluster at `ray_address`, whose tasks hold `cpus` cores and `gpus` GPUs each.

    A local Ray has room for `workers` tasks. Raises `MissingExtraError` without Ray and `ConfigError` when no cluster answers.
    """
    return LocalProcesses(workers) if ray_address is None else RayCluster(ray_address, cpus, gpus, workers * cpus)
