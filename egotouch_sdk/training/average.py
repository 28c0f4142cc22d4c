"""The mean of several runs' weights, calibrated on people that none of them has seen."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.training.calibration import calibrate
from egotouch_sdk.training.dataset import fixed_views
from egotouch_sdk.training.export import ModelFacts, write_model
from egotouch_sdk.training.network import TouchNetwork
from egotouch_sdk.training.report import coverage, held_out_report
from egotouch_sdk.training.run import averaged_state, calibrated, earlier_stage, predict
from egotouch_sdk.training.shards import RenderedPatch, read_folder

VIEWS = 2
THRESHOLD_FROM = "rendered people who trained none of the averaged runs; 2.6 % of their hovers reach it"


def average(checkpoints: Sequence[Path], data: Path, out: Path, seed: int) -> Path:
    """Average the shipped weights of runs that share an ancestor, calibrate them on all of `data`, export to `out`.

    Returns the model file's path. Nobody in `data` may have trained one of the runs: this is not checked, since checkpoints do not
    name people. Raises `ConfigError` for a file that is no checkpoint of this network, `SourceError` for unusable data.
    """
    network = TouchNetwork()
    network.load_state_dict(mean_state([averaged_state(path) for path in checkpoints]))
    training = {"averaged_runs": len(checkpoints), **{f"run_{i + 1}": earlier_stage(path) for i, path in enumerate(checkpoints)}}
    return export_calibrated(network.use_fast_layout(), read_folder(data), out, training, seed)


def mean_state(states: Sequence[dict[str, Tensor]]) -> dict[str, Tensor]:
    """Mean of each weight; raises `ConfigError` when the networks differ in shape."""
    shapes = [{name: value.shape for name, value in state.items()} for state in states]
    if any(shape != shapes[0] for shape in shapes):
        raise ConfigError("the checkpoints are of different networks", hint="Average stages of one run only")
    first = states[0]
    return {name: torch.stack([state[name].double() for state in states]).mean(0).to(value.dtype) for name, value in first.items()}


def export_calibrated(network: TouchNetwork, patches: Sequence[RenderedPatch], out: Path, training: dict[str, Any], seed: int) -> Path:
    """Calibrate a network on rendered patches, write it with its scores on them, return the model file's path."""
    index, views = fixed_views(patches, VIEWS, seed)
    labels = [patches[i].label for i in index]
    touch = np.array([label.touch for label in labels])
    calibration = calibrate(touch, predict(network, views)[0])
    shipped = calibrated(network, calibration)
    logit, force_n, sigma_n = predict(shipped, views)
    measured = held_out_report(labels, 1 / (1 + np.exp(-logit.astype(np.float64))), force_n, calibration.down)
    measured["force_within_one_sigma"] = coverage(labels, force_n, sigma_n)
    facts = {
        "data": "rendered by egotouch_sdk.synthetic; no pictures of people",
        **training,
        "calibration": {"scale": round(calibration.scale, 4), "shift": round(calibration.shift, 4)},
        "calibrated_on": {
            "patches": len(patches),
            "participants": len({p.label.participant for p in patches}),
            "scenes": len({p.label.scene for p in patches}),
        },
        "threshold_from": THRESHOLD_FROM,
    }
    version = f"renders-{sum(int((run or {}).get('patches', 0)) for run in training.values() if isinstance(run, dict))}"
    return write_model(shipped, ModelFacts(version, calibration.down, calibration.up, facts, {"calibration_renders": measured}), out)
