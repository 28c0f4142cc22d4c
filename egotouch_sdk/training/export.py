"""Writes a trained network as the model file, its manifest, its golden pair and its model card."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch

from egotouch_sdk.errors import ModelError
from egotouch_sdk.observation import PATCH_PX
from egotouch_sdk.touch.manifest import FORCE_SIGMA, MEMORY, NEXT_MEMORY, OUTPUTS
from egotouch_sdk.training.model_card import CARD_FILE, MANIFEST_FILE, model_card
from egotouch_sdk.training.network import MEMORY_SIZE, TouchNetwork, count_parameters, reparameterise

MODEL_FILE = "touch.onnx"
GOLDEN_FILE = "touch_golden.npz"
#: Parameters of the paper's model while training and as shipped, in millions (EgoTouch, UIST'24, section 4).
PAPER_PARAMETERS_M = {"trained": 4.1, "shipped": 3.8}
#: Largest difference between torch and ONNX outputs that counts as the same model (our choice; float32 rounding is about 1e-6).
PARITY_TOLERANCE = 1e-4
#: Patches in the golden pair.
GOLDEN_SIZE = 4
ONNX_OPSET = 17
Floats = npt.NDArray[np.float32]
#: What a manifest says of each input and output.
_FIELDS: dict[str, dict[str, Any]] = {
    name: {"dtype": "float32", "shape": ["N", *shape], "meaning": meaning}
    for name, shape, meaning in (
        ("patch", (3, PATCH_PX, PATCH_PX), "RGB through egotouch_sdk.patches.normalise"),
        ("polar", (2,), "(r_palms, theta_rad); (0, 0) when the host is unknown"),
        (MEMORY, (MEMORY_SIZE,), "next_memory of the finger's last frame, zeros at first"),
        ("touch_logit", (), "touch probability is its logistic"),
        ("force_n", (), "newtons, 0..3.5"),
        (FORCE_SIGMA, (), "standard error of force_n on touches, newtons"),
        (NEXT_MEMORY, (MEMORY_SIZE,), "what to remember of the finger"),
    )
}


@dataclass(frozen=True)
class ModelFacts:
    """What the manifest says beyond the file itself.

    `version` is free text, "untrained" for random weights. `threshold_down` and `threshold_up` are touch probabilities:
    a touch begins at or above the first and ends below the second. `training` and `measured` are JSON-ready and copied as they are.
    """

    version: str
    threshold_down: float
    threshold_up: float
    training: dict[str, Any] = field(default_factory=dict)
    measured: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not 0.0 < self.threshold_up <= self.threshold_down < 1.0:
            raise ModelError(f"thresholds are down={self.threshold_down}, up={self.threshold_up}; need 0 < up <= down < 1")


def write_model(network: TouchNetwork, facts: ModelFacts, folder: Path) -> Path:
    """Write the model file with its manifest, golden pair and model card into `folder`; returns the model file's path.

    The network is folded first. Raises `ModelError` when the written file does not give the trained network's outputs within 1e-4.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / MODEL_FILE
    inputs = golden_inputs(network)
    expected = run_torch(network, inputs)
    write_onnx(reparameterise(network), path)
    check_parity(path, inputs, expected)
    golden: dict[str, Any] = {**inputs, **expected}
    np.savez_compressed(folder / GOLDEN_FILE, **golden)
    manifest = build_manifest(network, facts, path)
    (folder / MANIFEST_FILE).write_text(json.dumps(manifest, indent=2) + "\n")
    (folder / CARD_FILE).write_text(model_card(manifest))
    return path


def input_names(network: TouchNetwork) -> tuple[str, ...]:
    """Names of the model file's inputs."""
    return ("patch", "polar") if network.memory is None else ("patch", "polar", MEMORY)


def output_names(network: TouchNetwork) -> tuple[str, ...]:
    """Names of the model file's outputs."""
    return (*OUTPUTS, FORCE_SIGMA) if network.memory is None else (*OUTPUTS, FORCE_SIGMA, NEXT_MEMORY)


def golden_inputs(network: TouchNetwork) -> dict[str, Floats]:
    """Fixed inputs for the golden pair: random patches with the mean and spread of normalised ones, four places, and four memories."""
    rng = np.random.default_rng(0)
    patch = rng.standard_normal((GOLDEN_SIZE, 3, PATCH_PX, PATCH_PX), np.float32)
    polar = np.array([[0.0, 0.0], [0.8, 0.3], [1.4, -0.6], [2.1, 2.9]], np.float32)
    memory = rng.uniform(-1, 1, (GOLDEN_SIZE, MEMORY_SIZE)).astype(np.float32) * np.array([[0.0], [0.1], [0.5], [1.0]], np.float32)
    return dict(zip(input_names(network), (patch, polar, memory), strict=False))


def run_torch(network: TouchNetwork, inputs: dict[str, Floats]) -> dict[str, Floats]:
    """The network's outputs by name, in evaluation mode; its own mode is restored."""
    training = network.training
    network.eval()
    try:
        with torch.no_grad():
            outputs = network(*(torch.from_numpy(inputs[name]) for name in input_names(network)))
    finally:
        network.train(training)
    return {name: output.numpy() for name, output in zip(output_names(network), outputs, strict=True)}


def write_onnx(folded: TouchNetwork, path: Path) -> None:
    """Write a folded network as ONNX with a free batch size."""
    example = {"patch": torch.zeros(2, 3, PATCH_PX, PATCH_PX), "polar": torch.zeros(2, 2), MEMORY: torch.zeros(2, MEMORY_SIZE)}
    inputs, outputs = input_names(folded), output_names(folded)
    torch.onnx.export(
        folded.eval(),
        tuple(example[name] for name in inputs),
        str(path),
        input_names=list(inputs),
        output_names=list(outputs),
        dynamic_axes={name: {0: "batch"} for name in (*inputs, *outputs)},
        opset_version=ONNX_OPSET,
        dynamo=False,
    )


def check_parity(path: Path, inputs: dict[str, Floats], expected: dict[str, Floats]) -> None:
    """Raise `ModelError` unless the model file gives the expected outputs for the whole batch and for one patch alone."""
    from egotouch_sdk.inference import create_session

    session = create_session(path)
    for count in (GOLDEN_SIZE, 1):
        got = session.run(list(expected), {name: values[:count] for name, values in inputs.items()})
        worst = max(float(np.abs(g - e[:count]).max()) for g, e in zip(got, expected.values(), strict=True))
        if worst > PARITY_TOLERANCE:
            raise ModelError(f"{path.name} differs from the trained network by {worst:.2g}", hint="Report your torch and onnx versions")


def build_manifest(network: TouchNetwork, facts: ModelFacts, path: Path) -> dict[str, Any]:
    """The manifest of a written model file, JSON-ready."""
    return {
        "name": "egotouch-touch",
        "version": facts.version,
        "file": path.name,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "inputs": {name: _FIELDS[name] for name in input_names(network)},
        "outputs": {name: _FIELDS[name] for name in output_names(network)},
        "threshold": {"down": facts.threshold_down, "up": facts.threshold_up},
        "parameters": {
            "trained": count_parameters(network),
            "shipped": count_parameters(reparameterise(network)),
            "paper_millions": PAPER_PARAMETERS_M,
        },
        "training": facts.training,
        "measured": facts.measured,
        "licence": "Apache-2.0",
    }
