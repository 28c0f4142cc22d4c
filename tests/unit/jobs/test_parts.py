"""Names of half-done results, packed results, progress lines, tasks that are refused."""

from __future__ import annotations

import os
import pickle
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import egotouch_sdk.jobs
from egotouch_sdk.cli.main import build_parser
from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.jobs import Batch, Task, run_jobs
from egotouch_sdk.jobs.attempt import attempt, pack, pack_order, unpack
from egotouch_sdk.jobs.choice import open_runner
from egotouch_sdk.jobs.progress import Progress
from egotouch_sdk.jobs.runner import Outcome
from egotouch_sdk.jobs.scratch import claim, is_shared, leftovers, scratch_path, sole_run, sweep
from tests.support.work import always_broken, name_of, task, text_of, visible, write, write_folder


def test_a_half_done_result_is_hidden_and_found_by_its_name_alone(tmp_path: Path) -> None:
    path = scratch_path(tmp_path, "a.b")
    path.write_text("half")
    (tmp_path / "a.b").write_text("whole")
    assert path.name.startswith(".") and path not in tmp_path.glob("*.b")
    assert leftovers(tmp_path, "a.b") == [path]
    assert leftovers(tmp_path, "a") == leftovers(tmp_path, "b") == []
    sweep(tmp_path, "a.b")
    assert visible(tmp_path) == ["a.b"]


def test_a_new_attempt_takes_an_old_ones_folder_away(tmp_path: Path) -> None:
    old = scratch_path(tmp_path, "fold")
    old.mkdir()
    (old / "checkpoint").write_text("epoch 3")
    fresh = claim(tmp_path, "fold")
    assert (fresh / "checkpoint").read_text() == "epoch 3"
    assert not old.exists()
    sweep(tmp_path, "fold", keep_folder=True)
    assert visible(tmp_path) == [fresh.name]


def test_a_folder_has_one_run_at_a_time(tmp_path: Path) -> None:
    lock = tmp_path / ".x.lock"
    with sole_run(lock) as token:
        assert is_shared(lock, token)
        with pytest.raises(ConfigError, match="another run is at work"), sole_run(lock):
            pytest.fail("two runs at once")
        assert is_shared(lock, token)
    with sole_run(lock) as other:
        assert is_shared(lock, other) and not is_shared(lock, token)
    assert not is_shared(tmp_path / "elsewhere" / ".x.lock", token)


def test_files_and_folders_are_packed_and_come_back(tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    (folder / "sub").mkdir(parents=True)
    (folder / "a").write_bytes(b"\0a")
    (folder / "sub" / "b").write_bytes(b"b" * 9)
    unpack(pack(folder), tmp_path / "again")
    assert pack(tmp_path / "again") == {"a": b"\0a", "sub/b": b"b" * 9}
    unpack(pack(folder / "a"), tmp_path / "file")
    assert (tmp_path / "file").read_bytes() == b"\0a"
    (tmp_path / "empty").mkdir()
    unpack(pack(tmp_path / "empty"), tmp_path / "empty again")
    assert list((tmp_path / "empty again").iterdir()) == []


def test_a_worker_without_the_folder_sends_the_result_back(tmp_path: Path) -> None:
    elsewhere, diary = tmp_path / "not here", tmp_path / "diary"
    diary.mkdir()
    order = pack_order(Task("x", write, (diary, 7)), elsewhere / ".x.part", elsewhere / ".lock", "token")
    outcome = attempt("x", order)
    assert outcome.error == "" and outcome.count == 7
    assert outcome.content is not None and outcome.content[""].startswith(b"result 7")
    assert not elsewhere.exists()


class Elsewhere:
    """A runner on a machine that has none of the batch's folders."""

    slots, where = 2, "another machine"

    def __init__(self, nowhere: Path) -> None:
        self._nowhere, self._orders, self.closed = nowhere, dict[str, bytes](), False

    def start(self, name: str, order: bytes) -> None:
        content = pickle.loads(order)
        moved = replace(content, scratch=self._nowhere / content.scratch.name, lock=self._nowhere / content.lock.name)
        self._orders[name] = pickle.dumps(moved)

    def wait(self) -> list[Outcome]:
        name = min(self._orders)
        return [attempt(name, self._orders.pop(name))]

    def close(self) -> None:
        self.closed = True


def test_results_of_a_machine_without_the_folder_are_the_same(tmp_path: Path) -> None:
    out, diary = tmp_path / "out", tmp_path / "diary"
    diary.mkdir()
    tasks = (task(write, diary, 1), task(always_broken, diary, 2), task(write_folder, diary, 3, resumable=True))
    runner = Elsewhere(tmp_path / "nowhere")
    result = run_jobs(Batch("batch", out, tasks), runner, lambda line: None)
    assert sorted(result.new) == [name_of(1), name_of(3)] and result.counted == 4
    assert [(failure.name, failure.attempts) for failure in result.failures] == [(name_of(2), 3)]
    assert (out / name_of(1)).read_text() == text_of(1)
    assert (out / name_of(3) / "inside" / "a").read_text() == text_of(3)
    assert visible(out) == [name_of(1), name_of(3)]
    assert runner.closed and not (tmp_path / "nowhere").exists()


def test_a_worker_of_another_version_refuses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order = pack_order(Task("x", write, (tmp_path, 7)), tmp_path / ".x.part", tmp_path / ".lock", "token")
    monkeypatch.setattr("egotouch_sdk.jobs.attempt.__version__", "99.0")
    outcome = attempt("x", order)
    assert "99.0" in outcome.error and not outcome.retry
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["", ".hidden", "a/b", ".."])
def test_a_name_that_is_no_file_name_is_refused(name: str) -> None:
    with pytest.raises(ConfigError, match="cannot be called"):
        Task(name, write)


def test_a_function_that_no_worker_can_import_is_refused() -> None:
    with pytest.raises(ConfigError, match="cannot be sent"):
        Task("a", lambda scratch: 1)


def test_arguments_that_cannot_be_sent_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="x cannot be sent to a worker"):
        pack_order(Task("x", write, ((n for n in "ab"),)), tmp_path, tmp_path, "")


def test_two_tasks_of_one_name_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="two tasks make a"):
        Batch("batch", tmp_path, (Task("a", write), Task("a", write)))


def test_progress_counts_only_what_this_run_did() -> None:
    assert Progress(10, 6, 2, 128, 36.0).line("shards", "patches") == "6/10 shards: 128 new patches, 12800 per hour, 72 s left"
    assert Progress(10, 6, 2, 0, 7200.0).line("folds", "") == "6/10 folds: 2 new folds, 1 per hour, 4.0 h left"
    assert Progress(3, 3, 1, 0, 600.0).line("folds", "") == "3/3 folds: 1 new folds, 6 per hour, 0 s left"
    assert Progress(3, 0, 0, 0, 0.0).line("folds", "").endswith("0 s left")


def test_without_ray_the_extra_is_named_and_nothing_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    before = dict(os.environ)
    with pytest.raises(MissingExtraError, match=r"egotouch-sdk\[cluster\]"):
        open_runner(1, "local")
    assert dict(os.environ) == before


README = Path(egotouch_sdk.jobs.__file__).with_name("README.md").read_text(encoding="utf-8")


def test_every_command_line_of_the_readme_is_accepted() -> None:
    lines = [line.split("#")[0].split() for line in README.splitlines() if line.startswith("egotouch ")]
    assert len(lines) >= 5
    for line in lines:
        assert callable(build_parser().parse_args(line[1:]).handler)


def test_the_readmes_own_batch_runs(tmp_path: Path) -> None:
    (example,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    (tmp_path / "own.py").write_text(example)
    (tmp_path / "texts").mkdir()
    (tmp_path / "texts" / "x.txt").write_text("b a b")
    done = subprocess.run([sys.executable, "own.py"], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "out" / "x.words").read_text() == "a\nb"
    assert visible(tmp_path / "out") == ["x.words"]
