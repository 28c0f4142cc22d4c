"""Who does what next: the bookkeeping of a batch, without processes, files or clock.

waiting ──next()──▶ running ──finish()──▶ done
   ▲                 │   │
   └───── fail() ────┘   └── fail() for the last time ──▶ given up
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Failure:
    """A task that was given up, and what its last attempt died of."""

    name: str
    error: str
    attempts: int


class Ledger:
    """Hands out each name until it is done or was tried `attempts` times; refuses any report on a name that is not running."""

    def __init__(self, names: Iterable[str], attempts: int) -> None:
        self._waiting = deque(names)
        self._running: set[str] = set()
        self._tried: dict[str, int] = dict.fromkeys(self._waiting, 0)
        self._attempts = attempts
        self.total = len(self._tried)
        self.done: list[str] = []
        self.failures: list[Failure] = []

    @property
    def is_over(self) -> bool:
        """True when nothing waits or runs."""
        return not self._waiting and not self._running

    @property
    def running(self) -> frozenset[str]:
        """Names that were handed out and not reported on."""
        return frozenset(self._running)

    def next(self) -> str | None:
        """The next name to work on, None when none waits."""
        if not self._waiting:
            return None
        name = self._waiting.popleft()
        self._running.add(name)
        self._tried[name] += 1
        return name

    def finish(self, name: str) -> None:
        """An attempt gave its result."""
        self._running.remove(name)
        self.done.append(name)

    def fail(self, name: str, error: str, retry: bool = True) -> bool:
        """An attempt ended without result; returns whether the name waits for another one, behind the others."""
        self._running.remove(name)
        if retry and self._tried[name] < self._attempts:
            self._waiting.append(name)
            return True
        self.failures.append(Failure(name, error, self._tried[name]))
        return False
