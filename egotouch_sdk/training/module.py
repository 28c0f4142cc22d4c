"""The Lightning module: loss, optimiser, averaged weights and held-out scores."""

from __future__ import annotations

from math import cos, pi
from typing import Any

import lightning
import numpy as np
import torch
from lightning.pytorch.callbacks import Timer
from torch import Tensor, nn
from torch.nn.functional import binary_cross_entropy_with_logits, interpolate, mse_loss
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

from egotouch_sdk.evaluation.metrics import force_scores, touch_scores
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.training.dataset import Sample
from egotouch_sdk.training.network import TouchNetwork
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.shards import HOVER_MAX_MM

#: Steps over which the averaging decay rises to its final value.
AVERAGE_WARMUP_STEPS = 10.0


class TouchModule(lightning.LightningModule):
    """Trains `network` by a recipe; `shipped_network` is the averaged one, where averaging is on.

    `trunk` says which file of weights the trunk started from, None for none; checkpoints keep it.
    """

    def __init__(self, recipe: Recipe, touch_share: float) -> None:
        super().__init__()
        self.recipe = recipe
        self.touch_weight = (1 - touch_share) / touch_share
        self.network = TouchNetwork(recipe.drop_path, recipe.dropout, recipe.remembers).use_fast_layout()
        self.hover_head = nn.Linear(self.network.state_size, 1)
        self.average = AveragedModel(self.network, multi_avg_fn=get_ema_multi_avg_fn(recipe.average_decay), use_buffers=True)
        self.held_out: list[tuple[Tensor, ...]] = []
        self.trunk: dict[str, Any] | None = None

    def on_save_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        checkpoint["trunk"] = self.trunk

    def on_load_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        self.trunk = checkpoint.get("trunk")

    @property
    def shipped_network(self) -> TouchNetwork:
        """The network to export."""
        return self.average.module if self.recipe.average_decay else self.network

    def shrink(self, patch: Tensor) -> Tensor:
        """Pictures (N, T, 3, 100, 100) at the recipe's size."""
        size = self.recipe.picture_px
        if size == patch.shape[-1]:
            return patch
        return interpolate(patch.flatten(0, 1), (size, size), mode="bilinear", antialias=True).unflatten(0, patch.shape[:2])

    def embed(self, network: TouchNetwork, batch: Sample) -> Tensor:
        """Hidden values (N, T, 128) of a batch."""
        return network.embed_films(self.shrink(batch.patch), batch.polar)

    def training_step(self, batch: Sample, _: int) -> Tensor:
        hidden = self.embed(self.network, batch)
        loss = self.loss(self.network.film(hidden), batch, log=True)
        if self.recipe.remembers:
            loss = loss + self.recipe.still_weight * self.loss(self.network.stills(hidden), batch, log=False)
        return loss

    def loss(self, state: Tensor, batch: Sample, log: bool) -> Tensor:
        """The loss of states (N, T, S)."""
        recipe = self.recipe
        logit, force_n, sigma_n = self.network.decide(state)
        target = batch.touch * (1 - recipe.label_smoothing) + recipe.label_smoothing / 2
        weight = 1 + batch.touch * (self.touch_weight - 1)
        touch_loss = binary_cross_entropy_with_logits(logit, target, weight)
        touches = batch.touch.sum().clamp(min=1)
        force_loss = (batch.touch * (force_n - batch.force_n) ** 2).sum() / touches / FORCE_MAX_N**2
        total = touch_loss + recipe.force_weight * force_loss
        if recipe.hover_weight:
            total = total + recipe.hover_weight * mse_loss(self.hover_head(state)[..., 0], hover_target(batch.hover_mm))
        if recipe.sigma_weight:
            surprised = surprise(force_n.detach() - batch.force_n, sigma_n)
            total = total + recipe.sigma_weight * (batch.touch * surprised).sum() / touches
        if log:
            self.log("loss", touch_loss, prog_bar=True, on_step=False, on_epoch=True, batch_size=len(logit))
            self.log("force_loss", force_loss, prog_bar=True, on_step=False, on_epoch=True, batch_size=len(logit))
        return total

    def on_train_batch_end(self, *_: Any) -> None:
        if self.recipe.average_decay:
            decay = min(self.recipe.average_decay, 1 - AVERAGE_WARMUP_STEPS / (AVERAGE_WARMUP_STEPS + self.global_step))
            self.average.multi_avg_fn = get_ema_multi_avg_fn(decay)
            self.average.update_parameters(self.network)

    def validation_step(self, batch: Sample, _: int) -> None:
        network = self.shipped_network.eval()
        logit, force_n, _ = network.decide(network.film(self.embed(network, batch)))
        self.held_out.append(tuple(values.flatten() for values in (logit, force_n, batch.touch, batch.force_n)))

    def on_validation_epoch_end(self) -> None:
        logit, force_n, touch, true_n = (torch.cat(parts).float().cpu().numpy() for parts in zip(*self.held_out, strict=True))
        self.held_out.clear()
        is_touch = touch > 0.5
        if is_touch.all() or not is_touch.any():
            return
        scores = touch_scores(is_touch, 1 / (1 + np.exp(-logit)), 0.5)
        force = force_scores(true_n[is_touch], force_n[is_touch])
        self.log_dict({"auroc": scores.auroc, "accuracy": scores.accuracy, "force_mae_n": force.mae_n}, prog_bar=True)

    def configure_optimizers(self) -> Any:
        recipe = self.recipe
        learned = [*self.network.named_parameters(), *self.hover_head.named_parameters()]
        decayed = [p for name, p in learned if p.ndim > 1 and not name.endswith("scale")]
        plain = [p for name, p in learned if p.ndim <= 1 or name.endswith("scale")]
        groups = [{"params": decayed, "weight_decay": recipe.weight_decay}, {"params": plain, "weight_decay": 0.0}]
        return torch.optim.AdamW(groups, recipe.learning_rate)

    def on_train_batch_start(self, *_: Any) -> None:
        rate = self.recipe.learning_rate * rate_factor(self.progress(), self.recipe.warmup_share)
        for group in self.optimizers().param_groups:
            group["lr"] = rate

    def progress(self) -> float:
        """Share 0..1 of the run that is done, by steps or, where the run has a time limit, by time if that is further."""
        share = self.global_step / max(float(self.trainer.estimated_stepping_batches), 1.0)
        for callback in self.trainer.callbacks:
            if isinstance(callback, Timer) and callback.time_remaining() is not None:
                elapsed = callback.time_elapsed()
                share = max(share, elapsed / max(elapsed + callback.time_remaining(), 1e-6))
        return min(share, 1.0)


def rate_factor(progress: float, warmup_share: float) -> float:
    """Learning rate as a share of the largest: linear rise over `warmup_share`, then a cosine to nearly 0; constant for no warm-up."""
    if warmup_share == 0.0:
        return 1.0
    if progress < warmup_share:
        return 0.02 + 0.98 * progress / warmup_share
    return 0.005 + 0.995 * 0.5 * (1 + cos(pi * (progress - warmup_share) / (1 - warmup_share)))


def surprise(error_n: Tensor, sigma_n: Tensor) -> Tensor:
    """Negative log likelihood of errors under their standard errors, both in newtons, up to a constant."""
    return torch.log(sigma_n) + 0.5 * (error_n / sigma_n) ** 2


def hover_target(hover_mm: Tensor) -> Tensor:
    """Hover height on a logarithmic scale, 0 while touching and 1 at 30 mm: near heights matter most."""
    return torch.log1p(hover_mm.clamp(max=HOVER_MAX_MM)) / torch.log1p(torch.tensor(HOVER_MAX_MM))
