"""What a batch asks of whoever carries its tasks out, and the messages between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from egotouch_sdk.jobs.task import Task


@dataclass(frozen=True, slots=True)
class Order:
    """One attempt: make `task` at the path `scratch`, or send the result back where the file `lock` does not hold `token`."""

    task: Task
    scratch: Path
    lock: Path
    token: str
    version: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """How an attempt ended: without `error` the result is at the order's `scratch`, or packed in `content`."""

    name: str
    count: int = 0
    content: Mapping[str, bytes] | None = None
    error: str = ""
    retry: bool = True


class Runner(Protocol):
    """Carries out orders, at most `slots` at a time; it never does one twice by itself."""

    @property
    def slots(self) -> int:
        """How many orders may run at once; may change while a batch runs."""

    @property
    def where(self) -> str:
        """Where the work is done, for reports: "2 processes"."""

    def start(self, name: str, order: bytes) -> None:
        """Begin the attempt at the task `name` that `pack_order` made `order` of."""

    def wait(self) -> Sequence[Outcome]:
        """Wait until some attempts ended, also by the death of their worker, and return how."""

    def close(self) -> None:
        """End every attempt at once; none writes anything after this returned."""
