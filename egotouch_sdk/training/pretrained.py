"""Starts the trunk from ImageNet weights of FastViT-T8 that the user has fetched.

Two namings are known: timm's `fastvit_t8.apple_in1k` and the authors' released `fastvit_t8.pth.tar`, both in the training-time form
with parallel branches. ImageNet pictures were normalised by one mean and deviation per colour over the whole set; ours are standardised
patch by patch (`egotouch_sdk.patches.normalise`), so the weights are a start to train from, not features to use as they are.
"""

from __future__ import annotations

import argparse
import hashlib
import pickle
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.training.fastvit import STAGE_DEPTHS
from egotouch_sdk.training.network import TouchNetwork

#: Our names inside a module and timm's. The trailing dot or end keeps a rule from matching half a name.
_CONV = {"branches.0.0.": "conv_kxk.0.conv.", "branches.0.1.": "conv_kxk.0.bn.", "branches.1.0.": "conv_scale.conv.",
         "branches.1.1.": "conv_scale.bn.", "skip.": "identity."}  # fmt: skip
_LARGE = {"branches.0.0.": "large_conv.conv.", "branches.0.1.": "large_conv.bn.", "branches.1.0.": "small_conv.conv.",
          "branches.1.1.": "small_conv.bn."}  # fmt: skip
_BLOCK = {**{f"mixer.mix.{own}": f"token_mixer.mixer.{theirs}" for own, theirs in _CONV.items()},
          "mixer.norm.": "token_mixer.norm.identity.", "mixer.scale": "token_mixer.layer_scale.gamma",
          "mlp.spatial.branches.0.0.": "mlp.conv.conv.", "mlp.spatial.branches.0.1.": "mlp.conv.bn.",
          "mlp.layers.0.": "mlp.fc1.", "mlp.layers.2.": "mlp.fc2.", "scale": "layer_scale.gamma"}  # fmt: skip
_EXCITE = {"weights.0.": "se.fc1.", "weights.2.": "se.fc2."}
#: timm's names and the authors', whose flat `network` alternates blocks (0, 2, 4, 6) and downsampling (1, 3, 5).
_AUTHORS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"^stem\.", "patch_embed."), (r"^final_conv\.", "conv_exp."),
    (r"^stages\.(\d)\.blocks\.", lambda m: f"network.{2 * int(m[1])}."),
    (r"^stages\.(\d)\.downsample\.proj\.", lambda m: f"network.{2 * int(m[1]) - 1}.proj."),
    (r"\bconv_kxk\b", "rbr_conv"), (r"\bconv_scale\b", "rbr_scale"), (r"\bidentity\b", "rbr_skip"), (r"\blarge_conv\b", "lkb_origin"),
    (r"\bmlp\b", "convffn"), (r"\bse\.fc1\b", "se.reduce"), (r"\bse\.fc2\b", "se.expand"), (r"\blayer_scale\.gamma$", "layer_scale"),
)  # fmt: skip
_HINT = "Give the file of timm's fastvit_t8.apple_in1k (model.safetensors or pytorch_model.bin) or the authors' fastvit_t8.pth.tar"


@dataclass(frozen=True, slots=True)
class TrunkStart:
    """Which file a trunk started from, how many of our tensors it gave, and which of ours and of its own stayed out."""

    file: str
    sha256: str
    taken: int
    kept: tuple[str, ...]
    unused: tuple[str, ...]

    def __str__(self) -> str:
        kept = f"; not in it, from scratch: {', '.join(self.kept)}" if self.kept else ""
        unused = f"; not taken from it: {', '.join(self.unused)}" if self.unused else ""
        return f"{self.taken} tensors of the trunk and its expansion from {self.file}{kept}{unused}"

    def to_dict(self) -> dict[str, Any]:
        """What the manifest records, JSON-ready."""
        return {"file": self.file, "sha256": self.sha256, "tensors": self.taken}


def timm_name(own: str) -> str | None:
    """timm's name of one of our tensors; None for the EgoTouch head and for batch counters, which evaluation does not use."""
    if own.endswith("num_batches_tracked"):
        return None
    for place, theirs, rules in _places():
        if own.startswith(place):
            rest = own.removeprefix(place)
            for start, replacement in rules.items():
                if rest == start or (start.endswith(".") and rest.startswith(start)):
                    return theirs + replacement + rest.removeprefix(start)
    return None


def authors_name(own: str) -> str | None:
    """The authors' name of one of our tensors, None where `timm_name` is."""
    name = timm_name(own)
    if name is not None:
        for pattern, replacement in _AUTHORS:
            name = re.sub(pattern, replacement, name)
    return name


def start_trunk(network: TouchNetwork, path: Path) -> TrunkStart:
    """Copy the weights in `path` into the trunk, and into the expansion and its squeeze-excite where the file has them in our shapes.

    The network changes only when the whole trunk fits. Raises `ConfigError` when the file is missing, not readable or not a
    FastViT-T8 before folding, `MissingExtraError` when a .safetensors file needs a package that is not installed.
    """
    theirs = _read(path)
    if any(".reparam_conv." in name or ".lkb_reparam." in name for name in theirs):
        raise ConfigError(f"{path} is a folded FastViT, made for inference", hint=f"Training needs the branches. {_HINT}")
    named = authors_name if any(name.startswith("patch_embed.") for name in theirs) else timm_name
    taken: dict[str, Tensor] = {}
    kept, used = [], set()
    for own, value in network.state_dict().items():
        name = named(own)
        if name is None:
            continue
        found = theirs.get(name)
        if found is not None and found.shape == value.shape:
            taken[own] = found
            used.add(name)
        elif own.startswith("trunk."):
            what = "is missing" if found is None else f"has shape {tuple(found.shape)}, need {tuple(value.shape)}"
            raise ConfigError(f"{path} is not a FastViT-T8: tensor {name} {what}", hint=_HINT)
        else:
            kept.append(own)
    network.load_state_dict(taken, strict=False)
    unused = tuple(name for name in theirs if name not in used and not name.endswith("num_batches_tracked"))
    return TrunkStart(path.name, hashlib.sha256(path.read_bytes()).hexdigest(), len(taken), tuple(kept), unused)


def _places() -> Iterator[tuple[str, str, dict[str, str]]]:
    """Each module of ours with weights, where it is in timm, and the rules for the names inside it."""
    yield from ((f"trunk.0.{2 * i}.", f"stem.{i}.", _CONV) for i in range(3))
    layer = 1
    for stage, depth in enumerate(STAGE_DEPTHS):
        if stage:
            yield f"trunk.{layer}.0.", f"stages.{stage}.downsample.proj.0.", _LARGE
            yield f"trunk.{layer}.1.", f"stages.{stage}.downsample.proj.1.", _CONV
            layer += 1
        for block in range(depth):
            yield f"trunk.{layer}.", f"stages.{stage}.blocks.{block}.", _BLOCK
            layer += 1
    yield "expand.", "final_conv.", _CONV
    yield "excite.", "final_conv.", _EXCITE


def _read(path: Path) -> Mapping[str, Tensor]:
    if not path.is_file():
        raise ConfigError(f"there is no file {path}", hint=_HINT)
    try:
        content = _read_safetensors(path) if path.suffix == ".safetensors" else _read_torch(path)
    except (OSError, RuntimeError, ValueError, EOFError, pickle.UnpicklingError) as problem:
        raise ConfigError(f"{path} is not a readable file of weights ({type(problem).__name__})", hint=_HINT) from problem
    for key in ("state_dict", "state_dict_ema"):
        if isinstance(content, dict) and isinstance(content.get(key), dict):
            content = content[key]
    if not isinstance(content, dict) or not content or not all(isinstance(value, Tensor) for value in content.values()):
        raise ConfigError(f"{path} holds no table of tensors", hint=_HINT)
    return content


def _read_torch(path: Path) -> Any:
    """Tensors and plain values only: a fetched file runs no code."""
    with torch.serialization.safe_globals([argparse.Namespace]):
        return torch.load(path, map_location="cpu", weights_only=True)


def _read_safetensors(path: Path) -> Any:
    try:
        from safetensors import SafetensorError
        from safetensors.torch import load_file
    except ImportError as missing:
        raise MissingExtraError("reading .safetensors files", "train") from missing
    try:
        return load_file(path)
    except SafetensorError as problem:
        raise ValueError(str(problem)) from problem
