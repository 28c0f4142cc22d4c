"""Batches on real worker processes: killed, failing, interrupted and begun again."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.jobs import Batch, BatchResult, Task, run_jobs
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.jobs.scratch import scratch_path, sole_run
from tests.support import work

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="tasks are killed by POSIX signals")]


class Place:
    """A folder for results, one for the diary of attempts, and what a run reported."""

    def __init__(self, root: Path) -> None:
        self.out, self.diary = root / "out", root / "diary"
        self.out.mkdir()
        self.diary.mkdir()
        self.lines: list[str] = []

    def run(self, *tasks: Task, workers: int = 2) -> BatchResult:
        self.lines = []
        return run_jobs(Batch("batch", self.out, tasks, "results"), LocalProcesses(workers), self.lines.append)

    def attempts(self, count: int) -> list[int]:
        return [work.attempts_at(self.diary, number) for number in range(count)]

    def holds_exactly(self, *numbers: int) -> bool:
        return work.visible(self.out) == sorted(map(work.name_of, numbers)) and all(
            (self.out / work.name_of(number)).read_text() == work.text_of(number) for number in numbers
        )


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


def test_a_batch_is_made_once(place: Place) -> None:
    tasks = [work.task(work.write, place.diary, number) for number in range(5)]
    result = place.run(*tasks)
    assert (result.counted, result.failures, result.exit_code) == (0 + 1 + 2 + 3 + 4, (), 0)
    assert sorted(result.new) == sorted(task.name for task in tasks)
    assert place.holds_exactly(0, 1, 2, 3, 4)
    assert place.lines[0] == "0 of 5 results are there, 5 to make on 2 processes"
    assert place.lines[-1].startswith("5/5 results: 5 new results, ")

    again = place.run(*tasks)
    assert again == BatchResult(0, (), ())
    assert place.lines == ["5 of 5 results are there, 0 to make on 2 processes"]
    assert place.attempts(5) == [1, 1, 1, 1, 1]


def test_a_killed_worker_costs_one_attempt_of_its_own_task(place: Place) -> None:
    makes = [work.write, work.write_killed_at_first, work.write, work.write, work.write_killed_at_first, work.write]
    result = place.run(*(work.task(make, place.diary, number) for number, make in enumerate(makes)))
    assert result.exit_code == 0 and len(result.new) == 6
    assert place.holds_exactly(0, 1, 2, 3, 4, 5)
    assert place.attempts(6) == [1, 3, 1, 1, 3, 1]  # the second attempt notes itself twice
    deaths = [line for line in place.lines if "SIGKILL" in line]
    assert len(deaths) == 2 and all("will be tried again: its worker was killed by SIGKILL" in line for line in deaths)


def test_tasks_that_always_fail_are_named_and_the_others_done(place: Place) -> None:
    makes = [work.always_broken, work.write, work.always_killed, work.write_broken_at_first, work.refused, work.writes_nothing]
    result = place.run(*(work.task(make, place.diary, number) for number, make in enumerate(makes)))
    assert result.exit_code == 1
    assert place.holds_exactly(1, 3)
    given_up = {failure.name: failure for failure in result.failures}
    assert sorted(given_up) == [work.name_of(number) for number in (0, 2, 4, 5)]
    assert given_up["result-0.txt"].error.startswith("ValueError: 0 cannot be made (work.py:")
    assert given_up["result-2.txt"].error == "its worker was killed by SIGKILL"
    assert given_up["result-4.txt"].error == "there is nothing to make it of. Bring something"
    assert "wrote nothing" in given_up["result-5.txt"].error
    assert [given_up[name].attempts for name in sorted(given_up)] == [3, 3, 1, 1]
    assert place.lines[-1].startswith("result-") and " is missing after " in place.lines[-1]

    result = place.run(*(work.task(work.write, place.diary, number) for number in range(6)))
    assert result.exit_code == 0 and place.holds_exactly(0, 1, 2, 3, 4, 5)
    assert place.attempts(6)[1] == 1


def test_a_resumable_task_goes_on_where_it_was_killed(place: Place) -> None:
    result = place.run(work.task(work.count_up, place.diary, 0, resumable=True))
    assert result.exit_code == 0 and result.counted == 0
    assert work.visible(place.out) == [work.name_of(0)]
    assert sorted(path.name for path in (place.out / work.name_of(0)).iterdir()) == ["step-0", "step-1", "step-2"]
    assert (place.diary / "0.log").read_text() == "step 0\nstep 1\nstep 2\n"


def test_a_resumable_task_that_is_given_up_leaves_its_progress_for_the_next_run(place: Place) -> None:
    batch = Batch("batch", place.out, (work.task(work.count_up, place.diary, 0, resumable=True),))
    assert run_jobs(batch, LocalProcesses(1), place.lines.append, attempts=2).exit_code == 1
    assert len(work.visible(place.out)) == 1 and not (place.out / work.name_of(0)).exists()
    assert run_jobs(batch, LocalProcesses(1), place.lines.append, attempts=2).exit_code == 0
    assert (place.diary / "0.log").read_text() == "step 0\nstep 1\nstep 2\n"
    assert work.visible(place.out) == [work.name_of(0)]


def test_leftovers_of_a_killed_run_go(place: Place) -> None:
    scratch_path(place.out, work.name_of(0)).write_text("half")
    scratch_path(place.out, "of another batch").write_text("half")
    place.run(work.task(work.write, place.diary, 0))
    left = work.visible(place.out)
    assert len(left) == 2 and left[0].startswith(".of another batch.") and left[1] == work.name_of(0)


def test_a_second_run_in_the_folder_is_refused_and_changes_nothing(place: Place) -> None:
    with sole_run(place.out / ".batch.lock"), pytest.raises(ConfigError, match="another run"):
        place.run(work.task(work.write, place.diary, 0))
    assert place.holds_exactly() and place.attempts(1) == [0]


@settings(max_examples=8)
@given(st.sets(st.integers(0, 5)), st.sets(st.integers(0, 5), max_size=2), st.integers(1, 3))
def test_whatever_is_there_already_the_rest_is_made_once(there: set[int], killed: set[int], workers: int) -> None:
    with tempfile.TemporaryDirectory() as root:
        place = Place(Path(root))
        for number in there:
            (place.out / work.name_of(number)).write_text(work.text_of(number))
        makes = [work.write_killed_at_first if number in killed else work.write for number in range(6)]
        tasks = [work.task(make, place.diary, number) for number, make in enumerate(makes)]
        random.Random(0).shuffle(tasks)
        result = place.run(*tasks, workers=workers)
        assert sorted(result.new) == sorted(work.name_of(number) for number in set(range(6)) - there)
        assert place.holds_exactly(*range(6))
        assert place.attempts(6) == [0 if n in there else 3 if n in killed else 1 for n in range(6)]


SCRIPT = """
import sys
from pathlib import Path
from egotouch_sdk.jobs import Batch, run_jobs
from egotouch_sdk.jobs.local import LocalProcesses
from tests.support import work

if __name__ == "__main__":
    out, diary = map(Path, sys.argv[1:])
    makes = [work.write, work.wait_for_ever, work.wait_for_ever, work.write]
    tasks = tuple(work.task(make, diary, number) for number, make in enumerate(makes))
    try:
        run_jobs(Batch("batch", out, tasks), LocalProcesses(2), lambda line: print(line, flush=True))
    except KeyboardInterrupt:
        sys.exit(130)
"""
ROOT = Path(__file__).parents[3]


@pytest.fixture
def stuck(place: Place, tmp_path: Path) -> subprocess.Popen[str]:
    """A run of its own process group, whose two workers are in the middle of tasks that do not end."""
    (tmp_path / "script.py").write_text(SCRIPT)
    process = subprocess.Popen(
        [sys.executable, str(tmp_path / "script.py"), str(place.out), str(place.diary)],
        cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("1/4"):
            break
    wait_until(lambda: place.attempts(3)[1:] == [1, 1])
    return process


def wait_until(true: object) -> None:
    import time

    for _ in range(1200):
        if true():  # type: ignore[operator]
            return
        time.sleep(0.1)
    pytest.fail("waited two minutes in vain")


def worker_pids(place: Place) -> list[int]:
    return [int((place.diary / f"{number}.log").read_text()) for number in (1, 2)]


def is_gone(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    status = Path(f"/proc/{pid}/stat")
    return status.exists() and status.read_text().rpartition(")")[2].split()[0] == "Z"


def test_ctrl_c_ends_the_workers_and_leaves_no_half_result(place: Place, stuck: subprocess.Popen[str]) -> None:
    os.killpg(stuck.pid, signal.SIGINT)  # as a terminal does: the workers get it too
    _, err = stuck.communicate(timeout=60)
    assert (stuck.returncode, err) == (130, "")
    wait_until(lambda: all(is_gone(pid) for pid in worker_pids(place)))
    assert place.holds_exactly(0)

    assert place.run(*(work.task(work.write, place.diary, number) for number in range(4))).exit_code == 0
    assert place.holds_exactly(0, 1, 2, 3)
    assert place.attempts(4) == [1, 2, 2, 1]


def test_workers_end_with_a_run_that_is_killed(place: Place, stuck: subprocess.Popen[str]) -> None:
    stuck.kill()
    stuck.communicate(timeout=60)
    wait_until(lambda: all(is_gone(pid) for pid in worker_pids(place)))
    assert [name for name in work.visible(place.out) if not name.startswith(".")] == [work.name_of(0)]

    assert place.run(*(work.task(work.write, place.diary, number) for number in range(4))).exit_code == 0
    assert place.holds_exactly(0, 1, 2, 3)
    assert place.attempts(4) == [1, 2, 2, 1]
