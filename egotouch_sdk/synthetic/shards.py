"""Shards of rendered patch layers on disk: written once, whole or not at all, and read back by training.

One `.npz` holds `light` float16 (N, 144, 144, 3): irradiance by key, windows and room, 1 = white in the open;
`albedo` uint8 (N, 144, 144, 3) sRGB-encoded RGB; `segment` uint8 (N, 144, 144): 0 background, 1 host, 2 touching hand;
`depth_mm` float16 (N, 144, 144) relative to the tip; `meta`: a JSON list of N label objects. 2.5 px/mm, tip in the centre.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from egotouch_sdk.synthetic.series import LabelledLayers
from egotouch_sdk.synthetic.srgb import linear_to_srgb


def write_shard(path: Path, patches: Sequence[LabelledLayers]) -> None:
    """Write one shard; a reader never sees it half done."""
    centre = patches[0].layers.depth_m.shape[0] // 2
    depth = np.stack([p.layers.depth_m for p in patches])
    scratch = path.with_suffix(f".{os.getpid()}.tmp")
    with scratch.open("wb") as file:
        np.savez_compressed(
            file,
            light=np.stack([np.clip(p.layers.light, 0, 60).astype(np.float16) for p in patches]),
            albedo=np.stack([linear_to_srgb(p.layers.albedo) for p in patches]),
            segment=np.stack([p.layers.segment for p in patches]),
            depth_mm=np.clip((depth - depth[:, centre : centre + 1, centre : centre + 1]) * 1e3, -300, 300).astype(np.float16),
            meta=np.array(json.dumps([p.labels for p in patches])),
        )
    scratch.replace(path)
