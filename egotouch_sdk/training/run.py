"""One training run from a folder of shards to an exported model."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from datetime import timedelta
from pathlib import Path
from typing import Any

import lightning
import numpy as np
import torch
from lightning.pytorch.callbacks import ModelCheckpoint
from torch.utils.data import DataLoader

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.training.augment import AIR_SHARE
from egotouch_sdk.training.checkpoints import LAST_CHECKPOINT, begin_with_trunk, earlier_stage, load_weights
from egotouch_sdk.training.dataset import PatchDataset, Sample, SeededOrder, collate, finger_weights, fixed_views
from egotouch_sdk.training.finish import SCORING_BATCH, census, export
from egotouch_sdk.training.folder import Rendered, read_folder
from egotouch_sdk.training.module import TouchModule
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.shards import held_out


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
    return export(module, census(split.train), split.held_out, out, earlier_stage(start_from))


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
