"""The touch and force network: patches in, probability and newtons out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from egotouch_sdk.errors import ModelError
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_input import normalise
from egotouch_sdk.model_store import MODELS_DIR, checked_file
from egotouch_sdk.observation import FORCE_MAX_N, FingertipPatch, TouchEstimate
from egotouch_sdk.touch.manifest import FORCE_SIGMA, OUTPUTS, TouchManifest, check_signature

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
        check_signature(file, {node.name: tuple(node.shape) for node in self._session.get_inputs()}, outputs)
        self._outputs = [*OUTPUTS, *([FORCE_SIGMA] if FORCE_SIGMA in outputs else [])]

    def estimate(self, patches: Sequence[FingertipPatch]) -> tuple[TouchEstimate, ...]:
        """Touch probability 0..1, force in newtons 0..3.5 and, where the model tells it, its standard error for each patch, in one batch.

        Raises `ModelError` when the network answers with something that is not a number.
        """
        if not patches:
            return ()
        images = normalise(np.stack([patch.image for patch in patches]))
        polar = np.array([(patch.r_palms, patch.theta_rad) for patch in patches], np.float32)
        logits, forces, *rest = answers = self._session.run(self._outputs, {"patch": images, "polar": polar})
        if not all(np.isfinite(answer).all() for answer in answers):
            raise ModelError(f"touch model {self.manifest.name} {self.manifest.version} gave a value that is not finite")
        probabilities = 0.5 * (1.0 + np.tanh(0.5 * logits.astype(np.float64)))
        sigmas = rest[0].astype(float).tolist() if rest else [None] * len(patches)
        return tuple(
            TouchEstimate(patch.hand_id, patch.finger, float(probability), min(max(float(force), 0.0), FORCE_MAX_N), sigma)
            for patch, probability, force, sigma in zip(patches, probabilities, forces, sigmas, strict=True)
        )
