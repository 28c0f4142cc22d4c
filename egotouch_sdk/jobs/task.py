"""What there is to do: frozen descriptions that a worker on any machine can carry out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ConfigError


@dataclass(frozen=True, slots=True)
class Task:
    """One piece of work that needs no other: `make(scratch, *arguments)` writes `output`'s content to the path `scratch`.

    `name` is that of the file or folder which the task produces in the batch's folder; it appears whole or not at all, so `make` may
    be killed at any moment. `make` is an importable function of a module; it and `arguments` are pickled. The whole number that it
    returns, or None, is what the batch counts. `resumable` means that `scratch` is a folder in which `make` finds what an interrupted
    attempt left there, and continues from it.
    """

    name: str
    make: Callable[..., int | None]
    arguments: tuple[Any, ...] = ()
    resumable: bool = False

    def __post_init__(self) -> None:
        if not self.name or self.name.startswith(".") or Path(self.name).name != self.name:
            raise ConfigError(f"a task cannot be called {self.name!r}", hint="Use the plain name of the file that it makes")
        if "<" in self.make.__qualname__:
            raise ConfigError(f"{self.make.__qualname__} cannot be sent to a worker", hint="Use a function at the top of a module")


@dataclass(frozen=True, slots=True)
class Batch:
    """Tasks whose results go into one `folder`.

    No two runs of the same `name` work in one folder at a time. `noun` (plural) is what reports call the tasks and `unit` what their
    numbers count.
    """

    name: str
    folder: Path
    tasks: tuple[Task, ...]
    noun: str = "tasks"
    unit: str = ""

    def __post_init__(self) -> None:
        names = [task.name for task in self.tasks]
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise ConfigError(f"two tasks make {twice[0]}", hint="Give each its own name")
