"""Runs a batch: skips what is there, hands out the rest, publishes results, gives up on nothing but what failed again and again."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from egotouch_sdk.clock import now_ns
from egotouch_sdk.jobs.attempt import pack_order, unpack
from egotouch_sdk.jobs.ledger import Failure, Ledger
from egotouch_sdk.jobs.progress import Progress
from egotouch_sdk.jobs.runner import Outcome, Runner
from egotouch_sdk.jobs.scratch import claim, remove, scratch_path, sole_run, sweep
from egotouch_sdk.jobs.task import Batch, Task

#: How often a task is tried before it is given up: a worker may be killed for memory once or twice by no fault of the task.
ATTEMPTS = 3


@dataclass(frozen=True, slots=True)
class BatchResult:
    """What a run added: the `counted` numbers of its tasks, the names of `new` results, and the tasks that were given up."""

    counted: int
    new: tuple[str, ...]
    failures: tuple[Failure, ...]

    @property
    def exit_code(self) -> int:
        """1 when something is missing, else 0."""
        return 1 if self.failures else 0


def run_jobs(batch: Batch, runner: Runner, report: Callable[[str], None], attempts: int = ATTEMPTS) -> BatchResult:
    """Make every missing result of `batch`; `report` gets a line for each that is ready, fails or is given up.

    Results appear whole, once each. Ctrl-C (`KeyboardInterrupt`) ends all workers and removes what is half done, except the folders of
    resumable tasks; the next run goes on from there. The runner is closed in any case. Raises `ConfigError` when another run is at
    work in the folder or a task cannot be sent to a worker.
    """
    with closing(runner):
        batch.folder.mkdir(parents=True, exist_ok=True)
        lock = batch.folder.absolute() / f".{batch.name}.lock"
        with sole_run(lock) as token:
            run = _Run(batch, runner, report, attempts, partial(pack_order, lock=lock, token=token))
            try:
                return run.through()
            finally:
                runner.close()
                run.clean_up()


class _Run:
    def __init__(
        self, batch: Batch, runner: Runner, report: Callable[[str], None], attempts: int, pack: Callable[[Task, Path], bytes]
    ) -> None:
        self._batch, self._runner, self._report, self._pack = batch, runner, report, pack
        self._folder = batch.folder.absolute()
        self._missing: dict[str, Task] = {task.name: task for task in batch.tasks if not (self._folder / task.name).exists()}
        self._ledger = Ledger(self._missing, attempts)
        self._scratch: dict[str, Path] = {}
        self._counted = 0
        self._started_ns = now_ns()
        self.clean_up()

    def through(self) -> BatchResult:
        """Work until everything is done or given up."""
        noun, total = self._batch.noun, len(self._batch.tasks)
        self._report(f"{total - len(self._missing)} of {total} {noun} are there, {len(self._missing)} to make on {self._runner.where}")
        while not self._ledger.is_over:
            while len(self._ledger.running) < self._runner.slots and (name := self._ledger.next()) is not None:
                self._begin(name)
            for outcome in self._runner.wait():
                self._end(outcome)
        failures = tuple(self._ledger.failures)
        for failure in failures:
            self._report(f"{failure.name} is missing after {failure.attempts} attempts: {failure.error}")
        return BatchResult(self._counted, tuple(self._ledger.done), failures)

    def clean_up(self) -> None:
        """Remove half-done results, but not what a resumable task can go on from."""
        for task in self._missing.values():
            sweep(self._folder, task.name, keep_folder=task.resumable and not (self._folder / task.name).exists())

    def _begin(self, name: str) -> None:
        task = self._missing[name]
        self._scratch[name] = (claim if task.resumable else scratch_path)(self._folder, name)
        self._runner.start(name, self._pack(task, self._scratch[name]))

    def _end(self, outcome: Outcome) -> None:
        name, scratch = outcome.name, self._scratch.pop(outcome.name)
        if not outcome.error:
            if outcome.content is not None:
                remove(scratch)
                unpack(outcome.content, scratch)
            scratch.replace(self._folder / name)
            self._counted += outcome.count
            self._ledger.finish(name)
            self._report(self._progress())
            return
        again = self._ledger.fail(name, outcome.error, outcome.retry)
        self._report(f"{name} failed, {'will be tried again' if again else 'given up'}: {outcome.error}")
        if not self._missing[name].resumable:
            remove(scratch)

    def _progress(self) -> str:
        new, total = len(self._ledger.done), len(self._batch.tasks)
        there = total - len(self._missing) + new
        elapsed_s = (now_ns() - self._started_ns) / 1e9
        return Progress(total, there, new, self._counted, elapsed_s).line(self._batch.noun, self._batch.unit)
