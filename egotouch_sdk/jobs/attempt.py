"""One attempt at a task, as a worker carries it out."""

from __future__ import annotations

import pickle
import tempfile
import traceback
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from egotouch_sdk import __version__
from egotouch_sdk.errors import ConfigError, EgoTouchError
from egotouch_sdk.jobs.runner import Order, Outcome
from egotouch_sdk.jobs.scratch import is_shared
from egotouch_sdk.jobs.task import Task


def pack_order(task: Task, scratch: Path, lock: Path, token: str) -> bytes:
    """The order as bytes; raises `ConfigError` naming the task whose arguments cannot be sent."""
    try:
        return pickle.dumps(Order(task, scratch, lock, token, __version__))
    except (pickle.PicklingError, TypeError, AttributeError) as problem:
        raise ConfigError(f"{task.name} cannot be sent to a worker ({problem})") from problem


def attempt(name: str, packed: bytes) -> Outcome:
    """Carry out an order; every error becomes part of the outcome. One that was raised on purpose is not worth another try."""
    try:
        order: Order = pickle.loads(packed)
        if order.version != __version__:
            raise ConfigError(f"a worker has egotouch-sdk {__version__}, not {order.version}", hint="Install the same version everywhere")
        return _carry_out(order)
    except EgoTouchError as problem:
        return Outcome(name, error=str(problem), retry=False)
    except (Exception, SystemExit) as problem:
        place = traceback.extract_tb(problem.__traceback__)[-1]
        return Outcome(name, error=f"{type(problem).__name__}: {problem} ({Path(place.filename).name}:{place.lineno})")


def _carry_out(order: Order) -> Outcome:
    task = order.task
    if is_shared(order.lock, order.token):
        return Outcome(task.name, _make(task, order.scratch))
    with tempfile.TemporaryDirectory(prefix="egotouch-") as folder:
        scratch = Path(folder) / task.name
        outcome = Outcome(task.name, _make(task, scratch))
        return replace(outcome, content=pack(scratch))


def _make(task: Task, scratch: Path) -> int:
    if task.resumable:
        scratch.mkdir(exist_ok=True)
    count = task.make(scratch, *task.arguments) or 0
    if not scratch.exists():
        raise ConfigError(f"{task.make.__qualname__} wrote nothing for {task.name}")
    return count


def pack(path: Path) -> dict[str, bytes]:
    """The content of a file, under the name "", or of all files of a folder under their relative names."""
    if path.is_file():
        return {"": path.read_bytes()}
    return {file.relative_to(path).as_posix(): file.read_bytes() for file in sorted(path.rglob("*")) if file.is_file()}


def unpack(content: Mapping[str, bytes], path: Path) -> None:
    """Write what `pack` packed to `path`, which must not exist."""
    if "" in content:
        path.write_bytes(content[""])
        return
    path.mkdir()
    for name, data in content.items():
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_bytes(data)
