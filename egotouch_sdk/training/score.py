"""Scores of an exported model on rendered patches that it never saw."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from egotouch_sdk.inference import create_session
from egotouch_sdk.touch.manifest import OUTPUTS, TouchManifest
from egotouch_sdk.training.dataset import fixed_views
from egotouch_sdk.training.report import held_out_report
from egotouch_sdk.training.shards import RenderedPatch

_BATCH = 128


def score_model(model: Path, patches: Sequence[RenderedPatch], views: int, seed: int, threads: int = 1) -> dict[str, Any]:
    """The report of `held_out_report` at the model's own threshold, from `views` fixed camera pictures of each patch."""
    index, sample = fixed_views(patches, views, seed)
    session = create_session(model, threads)
    images, polar = sample.patch.numpy(), sample.polar.numpy()
    parts = [
        session.run(list(OUTPUTS), {"patch": images[start : start + _BATCH], "polar": polar[start : start + _BATCH]})
        for start in range(0, len(images), _BATCH)
    ]
    logit, force_n = (np.concatenate(column).astype(np.float64) for column in zip(*parts, strict=True))
    threshold = TouchManifest.read(model.with_suffix(".json")).down_probability
    return held_out_report([patches[i].label for i in index], 1 / (1 + np.exp(-logit)), force_n, threshold)
