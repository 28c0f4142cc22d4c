"""Worker processes of this machine.

A process pool of the standard library breaks as a whole when one worker is killed and does not say which task it had; here each worker
has a pipe of its own, so a death costs one attempt of one task.
"""

from __future__ import annotations

import multiprocessing as mp
import os
import pickle
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess

from egotouch_sdk.jobs.attempt import attempt
from egotouch_sdk.jobs.runner import Outcome

#: One worker per core leaves no core for the threads of numeric libraries.
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


@dataclass(eq=False, slots=True)
class _Worker:
    process: SpawnProcess
    pipe: Connection
    name: str = ""  # the task at hand, "" when idle


class LocalProcesses:
    """A `Runner` of up to `workers` fresh processes; they end with this process, however it ends."""

    def __init__(self, workers: int) -> None:
        self.slots = workers
        self.where = f"{workers} process{'' if workers == 1 else 'es'}"
        self._workers: list[_Worker] = []

    def start(self, name: str, order: bytes) -> None:
        """Begin an attempt on an idle worker, or on a new one."""
        idle = (worker for worker in self._workers if not worker.name and worker.process.is_alive())
        worker = next(idle, None) or self._hire()
        worker.name = name
        with suppress(OSError):  # it has just died: `wait` finds out
            worker.pipe.send_bytes(pickle.dumps((name, order)))

    def wait(self) -> Sequence[Outcome]:
        """Wait for results and deaths."""
        busy = [worker for worker in self._workers if worker.name]
        wait([worker.pipe for worker in busy] + [worker.process.sentinel for worker in busy])
        outcomes = []
        for worker in busy:
            if worker.pipe.poll() or not worker.process.is_alive():
                outcomes.append(self._hear(worker))
                worker.name = ""
        return outcomes

    def close(self) -> None:
        """Kill the workers; results that they had not handed over are lost."""
        for worker in self._workers:
            worker.process.kill()
        for worker in self._workers:
            worker.process.join()
            worker.pipe.close()
        self._workers.clear()

    def _hire(self) -> _Worker:
        ours, theirs = mp.Pipe()
        process = mp.get_context("spawn").Process(target=_serve, args=(theirs,))
        with _environment(_ONE_THREAD), _without_interrupts():
            process.start()
        theirs.close()
        self._workers.append(_Worker(process, ours))
        return self._workers[-1]

    def _hear(self, worker: _Worker) -> Outcome:
        try:
            outcome: Outcome = worker.pipe.recv()
        except (EOFError, OSError):
            worker.process.join()
            worker.pipe.close()
            self._workers.remove(worker)
            return Outcome(worker.name, error=_obituary(worker.process.exitcode))
        return outcome


def _obituary(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        return f"its worker was killed by {signal.Signals(-exit_code).name}"
    return f"its worker ended with exit code {exit_code}"


def _serve(pipe: Connection) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    while True:
        try:
            name, order = pickle.loads(pipe.recv_bytes())
        except EOFError:
            return
        pipe.send(attempt(name, order))


def _end_with_parent() -> None:
    parent = mp.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def _environment(values: dict[str, str]) -> Iterator[None]:
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Ctrl-C reaches the whole process group, but only this process decides: one born in here never sees it, this one sees it later."""
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
