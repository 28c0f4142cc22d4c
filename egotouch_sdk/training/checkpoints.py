"""Checkpoints: where a run goes on, and where another begins."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import torch

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.training.model_card import MANIFEST_FILE
from egotouch_sdk.training.module import TouchModule
from egotouch_sdk.training.pretrained import start_trunk

LAST_CHECKPOINT = "last.ckpt"


def load_weights(module: TouchModule, checkpoint: Path) -> None:
    """Start from an earlier run's shipped weights; raises `ConfigError` when the file is no checkpoint of this network."""
    state = _read_state(checkpoint)
    averaged = _under(state, "average.module.")
    module.network.load_state_dict(averaged)
    module.hover_head.load_state_dict(_under(state, "hover_head."))
    module.average.module.load_state_dict(averaged)


def begin_with_trunk(module: TouchModule, path: Path) -> None:
    """Start the trunk from FastViT-T8 weights and print what was taken; raises `ConfigError` when the file holds none."""
    start = start_trunk(module.network, path)
    module.average.module.load_state_dict(module.network.state_dict())
    module.trunk = start.to_dict()
    sys.stderr.write(f"{start}\n")


def averaged_state(checkpoint: Path) -> dict[str, torch.Tensor]:
    """The shipped weights in a checkpoint; raises `ConfigError` when the file is none."""
    return _under(_read_state(checkpoint), "average.module.")


def _read_state(checkpoint: Path) -> dict[str, torch.Tensor]:
    if not checkpoint.is_file():
        raise ConfigError(f"there is no checkpoint {checkpoint}", hint="Check the path")
    content = torch.load(checkpoint, map_location="cpu", weights_only=False)
    if not isinstance(content, dict) or "state_dict" not in content:
        raise ConfigError(f"{checkpoint} is no checkpoint of a training run", hint="Give the last.ckpt of an earlier run")
    state: dict[str, torch.Tensor] = content["state_dict"]
    return state


def _under(state: dict[str, torch.Tensor], prefix: str) -> dict[str, torch.Tensor]:
    return {name.removeprefix(prefix): value for name, value in state.items() if name.startswith(prefix)}


def earlier_stage(checkpoint: Path | None) -> dict[str, Any] | None:
    """What the manifest beside a checkpoint says about its training, None where there is none."""
    manifest = None if checkpoint is None else checkpoint.parent / MANIFEST_FILE
    return json.loads(manifest.read_text())["training"] if manifest is not None and manifest.is_file() else None
