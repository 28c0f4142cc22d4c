"""The touch and force network: patches in, probability and newtons out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from egotouch_sdk.errors import ModelError
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_input import normalise
from egotouch_sdk.model_store import MODELS_DIR, checked_file
from egotouch_sdk.observation import FORCE_MAX_N, FingertipPatch, FloatArray, TouchEstimate
from egotouch_sdk.touch.manifest import FORCE_SIGMA, MEMORY, NEXT_MEMORY, OUTPUTS, TouchManifest, check_signature

#: The model that comes with the package.
SHIPPED_MODEL = MODELS_DIR / "touch.onnx"


class TouchModel:
    """A touch model, checked against its manifest when it is loaded.

    `path` is an .onnx file with its manifest (same name, .json) beside it; None is the shipped model. `threads` share one
    inference. Raises `ModelError` when a file is missing, altered since its manifest was written, or not a touch model.
    """

    def __init__(self, path: str | Path | None = None, threads: int = 1) -> None:
        file = SHIPPED_MODEL if path is None else Path(path)
        if not file.is_file():
            raise ModelError(f"there is no touch model at {file}", hint="Check the path, or leave it out to use the shipped model")
        self.manifest = TouchManifest.read(file.with_suffix(".json"))
        checked_file(file, self.manifest.sha256)
        self._session = create_session(file, threads)
        outputs = {node.name: tuple(node.shape) for node in self._session.get_outputs()}
        inputs = {node.name: tuple(node.shape) for node in self._session.get_inputs()}
        check_signature(file, inputs, outputs)
        self._outputs = [*OUTPUTS, *(name for name in (FORCE_SIGMA, NEXT_MEMORY) if name in outputs)]
        self._memory_size = int(inputs[MEMORY][1]) if MEMORY in inputs else 0

    @property
    def memory_size(self) -> int:
        """How many numbers the model remembers of a finger from frame to frame; 0 for a model that judges every frame alone."""
        return self._memory_size

    def estimate(self, patches: Sequence[FingertipPatch]) -> tuple[TouchEstimate, ...]:
        """Touch probability 0..1, force in newtons 0..3.5 and, where the model tells it, its standard error for each patch, in one batch.

        Each patch is judged alone, with nothing remembered. Raises `ModelError` when the network answers with something that is not a
        number.
        """
        return self.estimate_next(patches, np.zeros((len(patches), self.memory_size), np.float32))[0]

    def estimate_next(self, patches: Sequence[FingertipPatch], memories: FloatArray) -> tuple[tuple[TouchEstimate, ...], FloatArray]:
        """The same as `estimate` with what is remembered of each patch's finger, and what to remember for its next frame.

        `memories` (N, memory_size) float32, zeros where nothing is remembered; those returned have the same shape.
        Raises `ModelError` for memories of another shape, and when the network answers with something that is not a number.
        """
        if memories.shape != (len(patches), self.memory_size):
            raise ModelError(f"memories have shape {memories.shape}, {self._name} needs {(len(patches), self.memory_size)}")
        if not patches:
            return (), memories
        inputs = {
            "patch": normalise(np.stack([patch.image for patch in patches])),
            "polar": np.array([(patch.r_palms, patch.theta_rad) for patch in patches], np.float32),
        }
        if self.memory_size:
            inputs[MEMORY] = memories.astype(np.float32, copy=False)
        answers = dict(zip(self._outputs, self._session.run(self._outputs, inputs), strict=True))
        if not all(np.isfinite(answer).all() for answer in answers.values()):
            raise ModelError(f"{self._name} gave a value that is not finite")
        probabilities = 0.5 * (1.0 + np.tanh(0.5 * answers["touch_logit"].astype(np.float64)))
        sigmas = answers[FORCE_SIGMA].astype(float).tolist() if FORCE_SIGMA in answers else [None] * len(patches)
        estimates = tuple(
            TouchEstimate(patch.hand_id, patch.finger, float(probability), min(max(float(force), 0.0), FORCE_MAX_N), sigma)
            for patch, probability, force, sigma in zip(patches, probabilities, answers["force_n"], sigmas, strict=True)
        )
        return estimates, answers.get(NEXT_MEMORY, memories)

    @property
    def _name(self) -> str:
        return f"touch model {self.manifest.name} {self.manifest.version}"
