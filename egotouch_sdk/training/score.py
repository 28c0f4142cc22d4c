"""Scores of an exported model on rendered patches or films that it never saw."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from egotouch_sdk.inference import create_session
from egotouch_sdk.touch.manifest import MEMORY, NEXT_MEMORY, OUTPUTS, TouchManifest
from egotouch_sdk.training.dataset import fixed_views
from egotouch_sdk.training.folder import Rendered
from egotouch_sdk.training.network import MEMORY_SIZE
from egotouch_sdk.training.report import held_out_report

_BATCH = 128


def score_model(model: Path, rendered: Sequence[Rendered], views: int, seed: int, threads: int = 1) -> dict[str, Any]:
    """The report of `held_out_report` at the model's own threshold, from `views` fixed cameras for each patch or film."""
    index, sample = fixed_views(rendered, views, seed)
    session = create_session(model, threads)
    remembers = MEMORY in {node.name for node in session.get_inputs()}
    images, polar = sample.patch.numpy(), sample.polar.numpy()
    logit, force_n = np.empty((2, *images.shape[:2]))
    for start in range(0, len(images), _BATCH):
        part = np.s_[start : start + _BATCH]
        memory = {MEMORY: np.zeros((len(images[part]), MEMORY_SIZE), np.float32)} if remembers else {}
        for frame in range(images.shape[1]):
            inputs = {"patch": images[part, frame], "polar": polar[part, frame], **memory}
            logit[part, frame], force_n[part, frame], *following = session.run([*OUTPUTS, *([NEXT_MEMORY] if remembers else [])], inputs)
            memory = dict(zip(memory, following, strict=True))
    threshold = TouchManifest.read(model.with_suffix(".json")).down_probability
    labels = [label for i in index for label in rendered[i].labels]
    return held_out_report(labels, 1 / (1 + np.exp(-logit.ravel())), force_n.ravel(), threshold)
