"""Batches on a real Ray of this machine with two workers. Ray runs in a process of its own, as it does for users."""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from egotouch_sdk.jobs import Batch, run_jobs
from egotouch_sdk.jobs.local import LocalProcesses
from tests.support import work
from tests.support.ports import free_port

HAS_RAY = importlib.util.find_spec("ray") is not None

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not HAS_RAY and not os.environ.get("CI"), reason="needs the extra [cluster]"),
    pytest.mark.skipif(sys.platform == "win32", reason="tasks are killed by POSIX signals"),
]

ROOT = Path(__file__).parents[3]
SCRIPT = """
import json
import sys
from dataclasses import asdict, replace
from pathlib import Path
from egotouch_sdk.jobs import Batch, run_jobs
from egotouch_sdk.jobs.ray_cluster import RayCluster
from egotouch_sdk.jobs.runner import Order
from tests.support import work

out, diary, makes = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:]
tasks = tuple(
    work.task(getattr(work, make), diary, number, resumable=make == "count_up") for number, make in enumerate(makes)
)
cluster = RayCluster("local", local_cpus=2)
try:
    result = run_jobs(Batch("batch", out, tasks), cluster, lambda line: print(line, file=sys.stderr, flush=True))
except KeyboardInterrupt:
    sys.exit(130)
print("RESULT " + json.dumps(asdict(result)), flush=True)
"""


class Cluster:
    """A process that runs a batch on a local Ray."""

    def __init__(self, root: Path) -> None:
        self.out, self.diary, self._script = root / "out", root / "diary", root / "script.py"
        self.out.mkdir()
        self.diary.mkdir()
        self._script.write_text(SCRIPT)

    def begin(self, *makes: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, str(self._script), str(self.out), str(self.diary), *makes],
            cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT), "RAY_memory_monitor_refresh_ms": "0"}, start_new_session=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip

    def attempts(self, count: int) -> list[int]:
        return [work.attempts_at(self.diary, number) for number in range(count)]


@pytest.fixture
def cluster(tmp_path: Path) -> Cluster:
    return Cluster(tmp_path)


def test_killed_and_failing_tasks_end_once_each_and_the_next_run_makes_the_rest(cluster: Cluster) -> None:
    makes = ["write", "write_killed_at_first", "write", "write", "always_broken", "write", "count_up"]
    out, err = cluster.begin(*makes).communicate(timeout=240)
    result = json.loads(next(line for line in out.splitlines() if line.startswith("RESULT ")).removeprefix("RESULT "))
    assert sorted(result["new"]) == [work.name_of(number) for number in (0, 1, 2, 3, 5, 6)]
    assert result["counted"] == 0 + 1 + 2 + 3 + 5 + 6
    assert [(failure["name"], failure["attempts"]) for failure in result["failures"]] == [("result-4.txt", 3)]
    assert result["failures"][0]["error"].startswith("ValueError: 4 cannot be made")
    assert err.startswith("0 of 7 tasks are there, 7 to make on a local Ray\n")
    assert "result-1.txt failed, will be tried again: The worker died" in err
    assert work.visible(cluster.out) == [work.name_of(number) for number in (0, 1, 2, 3, 5, 6)]
    assert cluster.attempts(7) == [1, 3, 1, 1, 3, 1, 3]  # the one that was killed notes its second attempt twice
    assert (cluster.diary / "6.log").read_text() == "step 0\nstep 1\nstep 2\n"

    tasks = tuple(work.task(work.write, cluster.diary, number) for number in range(7))
    again = run_jobs(Batch("batch", cluster.out, tasks), LocalProcesses(1), lambda line: None)
    assert again.new == (work.name_of(4),)
    assert cluster.attempts(7) == [1, 3, 1, 1, 4, 1, 3]


def test_a_worker_that_is_killed_from_outside_and_ctrl_c(cluster: Cluster) -> None:
    process = cluster.begin("write", "wait_for_ever", "wait_for_ever")
    first = int(_wait_for(cluster, lambda: cluster.attempts(3)[1:] == [1, 1]).joinpath("1.log").read_text())
    os.kill(first, signal.SIGKILL)
    _wait_for(cluster, lambda: cluster.attempts(3) == [1, 2, 1])
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=120)
    assert process.returncode == 130
    assert work.visible(cluster.out) == [work.name_of(0)]
    pids = [int(line) for number in (1, 2) for line in (cluster.diary / f"{number}.log").read_text().splitlines()]
    _wait_for(cluster, lambda: not any(Path(f"/proc/{pid}").exists() for pid in pids))


def _wait_for(cluster: Cluster, true: object) -> Path:
    for _ in range(1200):
        if true():  # type: ignore[operator]
            return cluster.diary
        time.sleep(0.1)
    pytest.fail(f"waited two minutes in vain: {cluster.attempts(3)}")


@pytest.mark.parametrize("address", ["127.0.0.1:{port}", "ray://127.0.0.1:{port}"])
def test_no_cluster_at_an_address_is_said_in_one_line(address: str) -> None:
    address = address.format(port=free_port())
    program = f"from egotouch_sdk.jobs.ray_cluster import RayCluster; RayCluster({address!r})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)
    assert done.stderr.splitlines()[-1].startswith(f"egotouch_sdk.errors.ConfigError: no Ray cluster answers at {address} (")
    assert done.returncode == 1 and done.stdout == ""
