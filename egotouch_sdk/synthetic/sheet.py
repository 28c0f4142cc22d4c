"""A contact sheet of rendered patches, to look at before training on them."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import SourceError
from egotouch_sdk.synthetic.srgb import srgb_to_linear

_CUT = slice(22, 122)


def contact_sheet(folder: Path, rows: int = 10, seed: int = 0) -> npt.NDArray[np.uint8]:
    """`rows` random series, one a row: hover close, hover far, light touch, firm touch, then the same from a second view.

    Returns a BGR picture; labels are in the corner of each patch. Raises `SourceError` when there are no shards.
    """
    files = sorted(folder.glob("shard-*.npz"))
    if not files:
        raise SourceError(f"no shards in {folder}", hint="Render some first: egotouch synth patches --out FOLDER")
    rng = np.random.default_rng(seed)
    lines = []
    for _ in range(rows):
        with np.load(files[rng.integers(len(files))]) as shard:
            meta = json.loads(str(shard["meta"]))
            first = 8 * int(rng.integers(len(meta) // 8))
            weights = rng.dirichlet((1.2, 1.0, 1.2))
            cells = []
            for k in (0, 2, 4, 6, 1, 3, 5, 7):
                light = shard["light"][first + k][_CUT, _CUT].astype(float) @ weights
                image = srgb_to_linear(shard["albedo"][first + k][_CUT, _CUT]) * light[..., None]
                if k == 0:
                    exposure = 0.22 / np.median(image.mean(2))
                cell = np.ascontiguousarray((np.clip(image * exposure, 0, 1) ** (1 / 2.2) * 255).astype(np.uint8)[:, :, ::-1])
                labels = meta[first + k]
                text = f"{labels['force_n']:.1f}N" if labels["touch"] else f"{labels['hover_mm']:.0f}mm"
                cells.append(cv2.putText(cell, text, (2, 10), cv2.FONT_HERSHEY_SIMPLEX, 0.34, (0, 255, 0), 1, cv2.LINE_AA))
            lines.append(np.hstack(cells))
    return np.vstack(lines)
