"""Tasks that a worker of any kind can import: they write results, and die or fail on the way when told to."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.jobs import Task


def text_of(number: int) -> str:
    return f"result {number}\n" * 100


def begin(scratch: Path, diary: Path, number: int) -> int:
    """Note that an attempt began, leave half a result behind, and return which attempt it is, from 1."""
    with (diary / f"{number}.log").open("a") as file:
        file.write(f"{os.getpid()}\n")
    scratch.write_text(text_of(number)[:150])
    return len((diary / f"{number}.log").read_text().splitlines())


def write(scratch: Path, diary: Path, number: int) -> int:
    begin(scratch, diary, number)
    scratch.write_text(text_of(number))
    return number


def write_killed_at_first(scratch: Path, diary: Path, number: int) -> int:
    """Killed in the middle of its first attempt, as the kernel kills for memory."""
    if begin(scratch, diary, number) == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return write(scratch, diary, number)


def write_broken_at_first(scratch: Path, diary: Path, number: int) -> int:
    if begin(scratch, diary, number) == 1:
        raise OSError("the disk hiccuped")
    return write(scratch, diary, number)


def always_killed(scratch: Path, diary: Path, number: int) -> int:
    begin(scratch, diary, number)
    os.kill(os.getpid(), signal.SIGKILL)
    return 0


def always_broken(scratch: Path, diary: Path, number: int) -> int:
    begin(scratch, diary, number)
    raise ValueError(f"{number} cannot be made")


def refused(scratch: Path, diary: Path, number: int) -> int:
    begin(scratch, diary, number)
    raise SourceError("there is nothing to make it of", hint="Bring something")


def writes_nothing(scratch: Path, diary: Path, number: int) -> int:
    with (diary / f"{number}.log").open("a") as file:
        file.write(f"{os.getpid()}\n")
    return 0


def count_up(scratch: Path, diary: Path, number: int) -> int:
    """A resumable task in three steps, killed after each but the last; every step is noted once it is safe."""
    steps = len(list(scratch.iterdir()))
    (scratch / f"step-{steps}").write_text(str(number))
    with (diary / f"{number}.log").open("a") as file:
        file.write(f"step {steps}\n")
    if steps < 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def write_folder(scratch: Path, diary: Path, number: int) -> int:
    (scratch / "inside").mkdir()
    return write(scratch / "inside" / "a", diary, number)


def wait_for_ever(scratch: Path, diary: Path, number: int) -> int:
    begin(scratch, diary, number)
    while True:
        signal.pause()


def name_of(number: int) -> str:
    return f"result-{number}.txt"


def task(make: object, diary: Path, number: int, resumable: bool = False) -> Task:
    return Task(name_of(number), make, (diary, number), resumable)  # type: ignore[arg-type]


def attempts_at(diary: Path, number: int) -> int:
    log = diary / f"{number}.log"
    return len(log.read_text().splitlines()) if log.exists() else 0


def visible(folder: Path) -> list[str]:
    """What a user sees in a folder, and half-done results if there are any; only the lock may stay."""
    return sorted(path.name for path in folder.iterdir() if not path.name.endswith(".lock"))
