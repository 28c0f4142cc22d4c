"""From trained weights to a shipped model: calibration and scores on renders of people who trained nothing."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch

from egotouch_sdk.training.calibration import Calibration, calibrate
from egotouch_sdk.training.dataset import Sample, fixed_views
from egotouch_sdk.training.export import ModelFacts, write_model
from egotouch_sdk.training.folder import Rendered
from egotouch_sdk.training.module import TouchModule
from egotouch_sdk.training.network import TouchNetwork
from egotouch_sdk.training.report import coverage, held_out_report
from egotouch_sdk.training.shards import PatchLabel

#: Patches or films per forward pass when scoring.
SCORING_BATCH = 32
#: A hover of at least this height that passes for a touch is a false touch; below it the touch is only early: fingers come down at 0.1 to
#: 0.2 m/s, so skin follows within one frame of 33 ms.
CLEAR_HOVER_MM = 3.0
#: What manifests say of the data.
DATA = "rendered by egotouch_sdk.synthetic; no pictures of people"


def export(
    module: TouchModule, trained_on: dict[str, int], held_out: Sequence[Rendered], out: Path, earlier: dict[str, Any] | None = None
) -> Path:
    """Calibrate on the held-out renders, write the model with its scores, and return its path."""
    recipe = module.recipe
    shipped, calibration, measured = calibrate_and_score(module.shipped_network, held_out, recipe.held_out_views, recipe.seed)
    training: dict[str, Any] = {
        "data": DATA,
        **trained_on,
        "held_out_participants": census(held_out)["participants"],
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
            parts.append(network.decide(network.film(network.embed_films(patch, polar))))
    logit, force_n, sigma_n = (torch.cat(column).numpy() for column in zip(*parts, strict=True))
    return logit, force_n, sigma_n
