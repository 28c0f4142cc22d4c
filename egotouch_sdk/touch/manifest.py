"""What a touch model's manifest and its network's signature must be."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ModelError
from egotouch_sdk.model_store import read_manifest

INPUTS = {"patch": ("N", 3, 100, 100), "polar": ("N", 2)}
OUTPUTS = {"touch_logit": ("N",), "force_n": ("N",)}
#: A model may also tell the standard error of its force.
FORCE_SIGMA = "force_sigma_n"
#: A model may also remember: an input (N, M) of what it kept of each finger, zeros for nothing, and what it keeps now, of the same shape.
MEMORY = "memory"
NEXT_MEMORY = "next_memory"

_HINT = "Give the .onnx file of an egotouch touch model with its .json manifest beside it"
_MEMORY_HINT = f"Export the network with {MEMORY} and {NEXT_MEMORY}, both of shape (N, M), or with neither"


@dataclass(frozen=True, slots=True)
class TouchManifest:
    """The part of a manifest that inference needs; `content` is all of it.

    A touch begins at `down_probability` and ends below `up_probability`, 0 < up <= down < 1.
    """

    name: str
    version: str
    file: Path
    sha256: str
    down_probability: float
    up_probability: float
    content: dict[str, Any]

    @classmethod
    def read(cls, path: Path) -> TouchManifest:
        """Read a manifest; raises `ModelError` when it is missing, no manifest of a touch model, or has impossible thresholds."""
        content = read_manifest(path)
        try:
            down, up = float(content["threshold"]["down"]), float(content["threshold"]["up"])
            manifest = cls(
                str(content["name"]), str(content["version"]), path.parent / str(content["file"]), str(content["sha256"]), down, up, content
            )
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"{path} is not the manifest of a touch model ({type(error).__name__}: {error})", hint=_HINT) from error
        if not 0.0 < up <= down < 1.0:
            raise ModelError(f"{path} has thresholds down={down}, up={up}; need 0 < up <= down < 1", hint=_HINT)
        return manifest


def check_signature(path: Path, inputs: dict[str, tuple[Any, ...]], outputs: dict[str, tuple[Any, ...]]) -> None:
    """Raise `ModelError` unless a network's inputs and outputs are those of a touch model; a free axis may have any name."""
    parts = ((inputs, INPUTS, {MEMORY}, "inputs"), (outputs, OUTPUTS, {FORCE_SIGMA, NEXT_MEMORY}, "outputs"))
    for found, needed, optional, kind in parts:
        if set(found) - optional != set(needed):
            raise ModelError(f"{path} has {kind} {sorted(found)}, a touch model has {sorted(needed)}", hint=_HINT)
        for name, shape in needed.items():
            fits = len(found[name]) == len(shape) and all(want in ("N", have) for have, want in zip(found[name], shape, strict=True))
            if not fits or isinstance(found[name][0], int):
                raise ModelError(f"{path} has {kind[:-1]} {name} of shape {list(found[name])}, a touch model has {list(shape)}", hint=_HINT)
    _check_memory(path, inputs.get(MEMORY), outputs.get(NEXT_MEMORY))


def _check_memory(path: Path, before: tuple[Any, ...] | None, after: tuple[Any, ...] | None) -> None:
    if before is None and after is None:
        return
    if after is None:
        raise ModelError(f"{path} has an input {MEMORY} but no output {NEXT_MEMORY}", hint=_MEMORY_HINT)
    if before is None:
        raise ModelError(f"{path} has an output {NEXT_MEMORY} but no input {MEMORY}", hint=_MEMORY_HINT)
    for name, shape in ((f"input {MEMORY}", before), (f"output {NEXT_MEMORY}", after)):
        if len(shape) != 2 or isinstance(shape[0], int) or not isinstance(shape[1], int) or shape[1] < 1:
            raise ModelError(f"{path} has {name} of shape {list(shape)}, a touch model has ['N', M] with a fixed M", hint=_MEMORY_HINT)
    if before[1] != after[1]:
        raise ModelError(f"{path} takes {MEMORY} of {before[1]} numbers and gives {NEXT_MEMORY} of {after[1]}", hint=_MEMORY_HINT)
