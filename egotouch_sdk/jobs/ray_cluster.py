"""Workers of a Ray cluster (extra `cluster`), or of a small Ray that is started on this machine and ends with the batch."""

from __future__ import annotations

import os
import secrets
import shutil
import socket
import sys
import tempfile
import warnings
from collections.abc import Sequence
from typing import Any

from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.jobs.attempt import attempt
from egotouch_sdk.jobs.runner import Outcome

#: The address that starts a Ray of this machine's own.
LOCAL = "local"
_QUIET = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0"}
#: Results are a few megabytes and leave the store at once; what does not fit goes to disk.
_LOCAL_STORE_BYTES = 128 * 2**20
#: The path of a Unix socket holds about 100 characters; a folder of the user's own can be too deep.
_SHORT_PATH = "/tmp"
#: How long one wait for results may take before Ctrl-C is noticed and new machines are counted.
_PATIENCE_S = 1.0
#: Time for killed attempts to end.
_END_S = 20.0


class RayCluster:
    """A `Runner` on the cluster at `address`: "local", "auto", "HOST:PORT" of the head or "ray://HOST:10001" from outside.

    Each order holds `cpus` processor cores and `gpus` GPUs, of which it sees no others (0.5: two share one). `local_cpus` is the size of
    the local Ray. Raises `MissingExtraError` without Ray and `ConfigError` when no cluster answers.
    """

    def __init__(self, address: str, cpus: int = 1, gpus: float = 0.0, local_cpus: int | None = None) -> None:
        wanted = _QUIET | (_local_environment() if address == LOCAL else {})
        self._environment = {name: value for name, value in wanted.items() if name not in os.environ}
        os.environ.update(self._environment)
        try:
            import ray
        except ImportError as missing:
            self._restore_environment()
            raise MissingExtraError("Running on a Ray cluster", "cluster") from missing
        self._ray = ray
        self._needs = {"CPU": float(cpus), "GPU": gpus}
        self._running: dict[Any, str] = {}
        self._folder = ""
        self.where = "a local Ray" if address == LOCAL else f"the Ray cluster at {address}"
        options = self._local_options(local_cpus or os.cpu_count() or 1) if address == LOCAL else {"address": address}
        try:
            _knock(address)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                ray.init(log_to_driver=False, logging_level="error", **options)
        except (OSError, RuntimeError, ValueError) as problem:
            self.close()
            raise _no_cluster(address, problem) from problem
        self._attempt = ray.remote(num_cpus=cpus, num_gpus=gpus, max_retries=0)(attempt)

    def _local_options(self, cpus: int) -> dict[str, Any]:
        self._folder = tempfile.mkdtemp(prefix="ray-", dir=_SHORT_PATH if os.path.isdir(_SHORT_PATH) else None)  # noqa: PTH112
        return {
            "address": LOCAL,
            "num_cpus": cpus,
            "include_dashboard": False,
            "object_store_memory": _LOCAL_STORE_BYTES,
            "_temp_dir": self._folder,
        }

    @property
    def slots(self) -> int:
        """Orders that the machines of the cluster can hold now."""
        there = self._ray.cluster_resources()
        return max(1, min(int(there.get(what, 0.0) / need) for what, need in self._needs.items() if need))

    def start(self, name: str, order: bytes) -> None:
        """Hand an attempt to the cluster."""
        self._running[self._attempt.remote(name, order)] = name

    def wait(self) -> Sequence[Outcome]:
        """Wait for results and deaths; returns nothing after a second without any."""
        ready, _ = self._ray.wait(list(self._running), timeout=_PATIENCE_S)
        return [self._hear(reference) for reference in ready]

    def close(self) -> None:
        """Kill the attempts, leave the cluster, and end it where it is a local one."""
        ray = self._ray
        if self._running and ray.is_initialized():
            for reference in self._running:
                ray.cancel(reference, force=True)
            ray.wait(list(self._running), num_returns=len(self._running), timeout=_END_S)
        self._running.clear()
        ray.shutdown()
        self._restore_environment()
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)

    def _restore_environment(self) -> None:
        for name in self._environment:
            os.environ.pop(name, None)

    def _hear(self, reference: Any) -> Outcome:
        name = self._running.pop(reference)
        try:
            outcome: Outcome = self._ray.get(reference)
        except self._ray.exceptions.RayError as death:
            lines = str(death).strip().splitlines()
            last = isinstance(death, self._ray.exceptions.RayTaskError)  # a traceback: what counts is its end
            return Outcome(name, error=lines[-1] if last else lines[0].partition(". ")[0])
        return outcome


def _knock(address: str) -> None:
    """Raise `OSError` where nobody listens: Ray itself would try for a minute and then end the whole process."""
    host, _, port = address.rpartition("/")[2].rpartition(":")
    if host and port.isdigit():
        socket.create_connection((host.strip("[]"), int(port)), _PATIENCE_S * 5).close()


def _no_cluster(address: str, problem: Exception) -> ConfigError:
    hint = "Start one: ray start --head"
    if "InvalidAuthToken" in f"{problem} {problem.__cause__}":
        hint = "It wants its token: set RAY_AUTH_MODE=token, and RAY_AUTH_TOKEN or the file ~/.ray/auth_token"
    return ConfigError(f"no Ray cluster answers at {address} ({str(problem).strip().splitlines()[0]})", hint=hint)


def _local_environment() -> dict[str, str]:
    """Ray listens on every network interface; nobody without this token can give work to the local one."""
    mode = {} if "ray" in sys.modules else {"RAY_AUTH_MODE": "token"}  # it reads the mode once, while it is imported
    return {"RAY_AUTH_TOKEN": secrets.token_hex(32)} | mode
