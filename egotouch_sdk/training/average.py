"""The mean of several runs' weights, calibrated on people that none of them has seen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.training.checkpoints import averaged_state, earlier_stage
from egotouch_sdk.training.export import ModelFacts, write_model
from egotouch_sdk.training.finish import DATA, calibrate_and_score, census
from egotouch_sdk.training.folder import Rendered, read_folder
from egotouch_sdk.training.force_fit import fit_force
from egotouch_sdk.training.network import TouchNetwork

VIEWS = 2
THRESHOLD_FROM = "rendered people who trained no run; 2 % of their hovers of 3 mm and more, seen by ordinary cameras, reach it"


def average(checkpoints: Sequence[Path], data: Path, out: Path, seed: int, force_data: Path | None = None) -> Path:
    """Average the shipped weights of runs that share an ancestor, calibrate them on all of `data`, export to `out`.

    A run named twice counts twice. With `force_data`, renders that trained the runs, the force is fitted again as `fit_force` does.
    Returns the model file's path. Nobody in `data` may have trained one of the runs: this is not checked, since checkpoints do not
    name people. Raises `ConfigError` for a file that is no checkpoint of this network, `SourceError` for unusable data.
    """
    weights = Counter(checkpoints)
    states = {path: averaged_state(path) for path in weights}
    mean = mean_state([states[path] for path in checkpoints])
    network = TouchNetwork(remembers=any(name.startswith("memory.") for name in mean))
    network.load_state_dict(mean)
    training: dict[str, Any] = {"averaged_runs": len(weights), "weights": list(weights.values())}
    training |= {f"run_{number}": earlier_stage(path) for number, path in enumerate(weights, 1)}
    if force_data is not None:
        trained = read_folder(force_data)
        fit_force(network, trained, seed)
        training["force_fitted_on"] = census(trained)
    return export_calibrated(network.use_fast_layout(), read_folder(data), out, training, seed)


def mean_state(states: Sequence[dict[str, Tensor]]) -> dict[str, Tensor]:
    """Mean of each weight; raises `ConfigError` when the networks differ in shape."""
    shapes = [{name: value.shape for name, value in state.items()} for state in states]
    if any(shape != shapes[0] for shape in shapes):
        raise ConfigError("the checkpoints are of different networks", hint="Average stages of one run only")
    first = states[0]
    return {name: torch.stack([state[name].double() for state in states]).mean(0).to(value.dtype) for name, value in first.items()}


def export_calibrated(network: TouchNetwork, patches: Sequence[Rendered], out: Path, training: dict[str, Any], seed: int) -> Path:
    """Calibrate a network on rendered patches, write it with its scores on them, return the model file's path."""
    shipped, calibration, measured = calibrate_and_score(network, patches, VIEWS, seed)
    facts = {
        "data": DATA,
        **training,
        "calibration": calibration.to_dict(),
        "calibrated_on": census(patches),
        "threshold_from": THRESHOLD_FROM,
    }
    version = f"renders-{sum(int((run or {}).get('patches', 0)) for name, run in training.items() if name.startswith('run_'))}"
    return write_model(shipped, ModelFacts(version, calibration.down, calibration.up, facts, {"calibration_renders": measured}), out)
