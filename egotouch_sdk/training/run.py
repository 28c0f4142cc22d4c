"""One training run from a folder of shards to an exported model."""

from __future__ import annotations

import copy
import json
import sys
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from datetime import timedelta
from pathlib import Path
from typing import Any

import lightning
import numpy as np
import numpy.typing as npt
import torch
from lightning.pytorch.callbacks import ModelCheckpoint
from torch.utils.data import DataLoader

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.training.augment import AIR_SHARE
from egotouch_sdk.training.calibration import Calibration, calibrate
from egotouch_sdk.training.dataset import PatchDataset, Sample, SeededOrder, collate, finger_weights, fixed_views
from egotouch_sdk.training.export import ModelFacts, write_model
from egotouch_sdk.training.folder import Rendered, read_folder
from egotouch_sdk.training.model_card import MANIFEST_FILE
from egotouch_sdk.training.module import TouchModule
from egotouch_sdk.training.network import HIDDEN, TouchNetwork
from egotouch_sdk.training.pretrained import start_trunk
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.report import coverage, held_out_report
from egotouch_sdk.training.shards import PatchLabel, held_out

#: Patches or films per forward pass when scoring.
SCORING_BATCH = 32
#: A hover of at least this height that passes for a touch is a false touch; below it the touch is only early: fingers come down at 0.1 to
#: 0.2 m/s, so skin follows within one frame of 33 ms.
CLEAR_HOVER_MM = 3.0
LAST_CHECKPOINT = "last.ckpt"
#: What manifests say of the data.
DATA = "rendered by egotouch_sdk.synthetic; no pictures of people"


@dataclass(frozen=True, slots=True)
class Machine:
    """What a run may use: compute threads of torch and worker processes that make pictures."""

    threads: int = 2
    workers: int = 1
    max_minutes: float | None = None


@dataclass(frozen=True, slots=True)
class Split:
    """Rendered patches or films that train, and those of other participants that do not."""

    train: list[Rendered]
    held_out: list[Rendered]

    @classmethod
    def of(cls, patches: list[Rendered], recipe: Recipe) -> Split:
        """Split by participant; raises `SourceError` when a side would lack touches or hovers."""
        marked = held_out([patch.label for patch in patches], recipe.held_out_share)
        split = cls([p for p, m in zip(patches, marked, strict=True) if not m], [p for p, m in zip(patches, marked, strict=True) if m])
        for name, side in (("training", split.train), ("held-out", split.held_out)):
            if len({label.touch for patch in side for label in patch.labels}) < 2:
                raise SourceError(f"the {name} patches lack touches or hovers", hint="Render more scenes")
        return split


def train(
    data: Path,
    out: Path,
    recipe: Recipe,
    machine: Machine,
    *,
    resume: bool = False,
    start_from: Path | None = None,
    trunk: Path | None = None,
    left_out: Collection[int] = (),
) -> Path:
    """Train on the shards in `data`, export to `out` and return the model file's path.

    The last checkpoint is kept in `out` after every epoch and on Ctrl-C; `resume` continues from it. `start_from` is a checkpoint of
    an earlier run whose weights are the start, `trunk` a file of FastViT-T8 weights for the trunk alone.
    The participants `left_out` neither train nor choose the threshold.
    Raises `SourceError` for unusable data, `ConfigError` for a missing checkpoint.
    """
    torch.set_num_threads(machine.threads)
    lightning.seed_everything(recipe.seed, verbose=False)
    patches = [patch for patch in read_folder(data) if patch.label.participant not in left_out]
    if recipe.remembers and max(len(patch.labels) for patch in patches) == 1:
        raise ConfigError(f"{data} holds single patches, which give nothing to remember", hint="Render films: egotouch synth films --help")
    split = Split.of(patches, recipe)
    module = TouchModule(recipe, float(np.mean([label.touch for patch in split.train for label in patch.labels])))
    if start_from is not None:
        load_weights(module, start_from)
    if trunk is not None:
        begin_with_trunk(module, trunk)
    _, validation = fixed_views(split.held_out, recipe.held_out_views, recipe.seed)
    fit(module, split.train, validation, out, machine, resume)
    return export(module, split, out, earlier_stage(start_from))


def fit(module: TouchModule, train_patches: list[Rendered], validation: Sample, out: Path, machine: Machine, resume: bool) -> None:
    """Run Lightning's loop; the module is trained in place."""
    out.mkdir(parents=True, exist_ok=True)
    checkpoint = out / LAST_CHECKPOINT
    if resume and not checkpoint.is_file():
        raise ConfigError(f"there is no checkpoint {checkpoint}", hint="Start without --resume")
    recipe = module.recipe
    order = SeededOrder(len(train_patches), recipe.seed, finger_weights([patch.label for patch in train_patches]))
    batches = DataLoader(
        PatchDataset(train_patches, AIR_SHARE, frames=None if recipe.remembers else recipe.frames_per_film),
        recipe.batch,
        sampler=order,
        collate_fn=collate,
        num_workers=machine.workers,
        drop_last=len(train_patches) >= 2 * recipe.batch,
        persistent_workers=machine.workers > 0,
        prefetch_factor=3 if machine.workers else None,
    )
    trainer = lightning.Trainer(
        accelerator="auto",
        devices=1,
        max_epochs=recipe.epochs,
        max_time=None if machine.max_minutes is None else timedelta(minutes=machine.max_minutes),
        default_root_dir=out,
        logger=False,
        enable_model_summary=False,
        num_sanity_val_steps=0,
        gradient_clip_val=1.0,
        callbacks=[
            ModelCheckpoint(out, filename="last", save_top_k=1, enable_version_counter=False, save_on_exception=True),
            _NextEpoch(order),
            _EpochLines(),
        ],
    )
    trainer.fit(module, batches, _batches_of(validation), ckpt_path=str(checkpoint) if resume else None, weights_only=False)
    if trainer.interrupted:
        raise KeyboardInterrupt


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


def export(module: TouchModule, split: Split, out: Path, earlier: dict[str, Any] | None = None) -> Path:
    """Calibrate on the held-out renders, write the model with its scores, and return its path."""
    recipe = module.recipe
    shipped, calibration, measured = calibrate_and_score(module.shipped_network, split.held_out, recipe.held_out_views, recipe.seed)
    training: dict[str, Any] = {
        "data": DATA,
        **census(split.train),
        "held_out_participants": census(split.held_out)["participants"],
        "epochs_done": module.current_epoch,
        "steps_done": module.global_step,
        "recipe": recipe.to_dict(),
        "calibration": calibration.to_dict(),
        "threshold_from": "held-out rendered participants; 2 % of their hovers of 3 mm and more, seen by ordinary cameras, reach it",
    }
    if module.trunk is not None:
        training["trunk"] = module.trunk
    if earlier is not None:
        training["started_from"] = earlier
    facts = ModelFacts(f"renders-{training['patches']}", calibration.down, calibration.up, training, {"held_out_renders": measured})
    return write_model(shipped, facts, out)


def calibrate_and_score(
    network: TouchNetwork, patches: Sequence[Rendered], views: int, seed: int
) -> tuple[TouchNetwork, Calibration, dict[str, Any]]:
    """A calibrated copy of the network, its calibration, and its scores on the pictures that calibrated it."""
    index, pictures = fixed_views(patches, views, seed)
    labels = [label for i in index for label in patches[i].labels]
    logit, force_n, sigma_n = (values.ravel() for values in predict(network, pictures))
    calibration = calibrate(np.array([label.touch for label in labels]), logit, clear_hovers(labels))
    probability = 1 / (1 + np.exp(-(calibration.scale * logit.astype(np.float64) + calibration.shift)))
    measured = held_out_report(labels, probability, force_n, calibration.down)
    measured["force_within_one_sigma"] = coverage(labels, force_n, sigma_n)
    return calibrated(network, calibration), calibration, measured


def clear_hovers(labels: Sequence[PatchLabel]) -> npt.NDArray[np.bool_]:
    """Which frames (N,) hover so high that a touch told there is a false one, not an early one."""
    return np.array([not label.touch and label.hover_mm >= CLEAR_HOVER_MM for label in labels])


def census(patches: Sequence[Rendered]) -> dict[str, int]:
    """How many patches (frames of films count each), participants and scenes there are."""
    participants, scenes = {patch.label.participant for patch in patches}, {patch.label.scene for patch in patches}
    return {"patches": sum(len(patch.labels) for patch in patches), "participants": len(participants), "scenes": len(scenes)}


def calibrated(network: TouchNetwork, calibration: Calibration) -> TouchNetwork:
    """A copy whose touch logit is already calibrated."""
    shipped = copy.deepcopy(network)
    with torch.no_grad():
        shipped.outputs.weight[0] *= calibration.scale
        shipped.outputs.bias[0] = shipped.outputs.bias[0] * calibration.scale + calibration.shift
    return shipped


def predict(network: TouchNetwork, views: Sample) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Touch logits, forces and their standard errors in newtons, (N, T) each, of a batch of any size, films as films."""
    network.eval()
    parts = []
    with torch.no_grad():
        for start in range(0, len(views.patch), SCORING_BATCH):
            patch, polar = (part[start : start + SCORING_BATCH] for part in (views.patch, views.polar))
            hidden = network.embed(patch.flatten(0, 1), polar.flatten(0, 1)).reshape(*patch.shape[:2], HIDDEN)
            parts.append(network.decide(network.film(hidden)))
    logit, force_n, sigma_n = (torch.cat(column).numpy() for column in zip(*parts, strict=True))
    return logit, force_n, sigma_n


def _batches_of(views: Sample) -> DataLoader[Sample]:
    slices = [slice(i, i + SCORING_BATCH) for i in range(0, len(views.patch), SCORING_BATCH)]
    chunks = [Sample(*(column[part] for column in views)) for part in slices]
    return DataLoader(chunks, batch_size=None)


class _NextEpoch(lightning.Callback):
    """Gives every epoch its own order and cameras, also after a resume."""

    def __init__(self, order: SeededOrder) -> None:
        self.order = order

    def on_train_epoch_start(self, trainer: Any, *_: Any) -> None:
        self.order.epoch = trainer.current_epoch


class _EpochLines(lightning.Callback):
    """One line of figures per epoch, for logs that are no terminal."""

    def on_train_epoch_end(self, trainer: Any, *_: Any) -> None:
        figures = " ".join(f"{name} {float(value):.4f}" for name, value in trainer.callback_metrics.items())
        trainer.print(f"epoch {trainer.current_epoch + 1}/{trainer.max_epochs} {figures}", flush=True)
