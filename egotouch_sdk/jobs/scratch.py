"""Half-done results: hidden files beside the finished ones, named so that nobody takes one for the other.

`shard-7.npz` is made as `.shard-7.npz.3f09c1d2.part` and renamed when it is whole.
"""

from __future__ import annotations

import glob
import secrets
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from egotouch_sdk.errors import ConfigError


def scratch_path(folder: Path, name: str) -> Path:
    """A name that no other attempt at `name`, here or on another machine, uses."""
    return folder / f".{name}.{secrets.token_hex(4)}.part"


def leftovers(folder: Path, name: str) -> list[Path]:
    """What earlier attempts at `name` left, newest first."""
    return sorted(folder.glob(f".{glob.escape(name)}.{'[0-9a-f]' * 8}.*"), key=_changed_ns, reverse=True)


def _changed_ns(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


def claim(folder: Path, name: str) -> Path:
    """A scratch folder that takes over what an earlier attempt left; one that is still being written loses its folder and fails."""
    fresh = scratch_path(folder, name)
    for old in leftovers(folder, name):
        if old.is_dir():
            old.rename(fresh)
            break
    return fresh


def sweep(folder: Path, name: str, keep_folder: bool = False) -> None:
    """Delete what attempts at `name` left; with `keep_folder` the newest folder stays."""
    for path in leftovers(folder, name):
        if keep_folder and path.is_dir():
            keep_folder = False
        else:
            remove(path)


def remove(path: Path) -> None:
    """Delete a file or a folder, or nothing where there is none."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


@contextmanager
def sole_run(lock: Path) -> Iterator[str]:
    """Hold the file `lock` against a second run for as long as this process lives; gives the token that the file then holds.

    A worker that reads the same token there shares the folder with this process. Raises `ConfigError` when another run holds it.
    On Windows nothing is held back.
    """
    token = secrets.token_hex(16)
    with lock.open("a", encoding="ascii") as file:
        if sys.platform != "win32":
            import fcntl

            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as problem:
                raise ConfigError(f"another run is at work in {lock.parent}", hint="Wait for it, or use another folder") from problem
        file.truncate(0)
        file.write(token)
        file.flush()
        yield token


def is_shared(lock: Path, token: str) -> bool:
    """Whether this process sees the same file `lock` as the one that holds it."""
    try:
        return lock.read_text(encoding="ascii") == token
    except (OSError, ValueError):
        return False
