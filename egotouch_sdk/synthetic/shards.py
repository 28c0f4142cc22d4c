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
from typing import Any

import numpy as np

from egotouch_sdk.synthetic.camera import LightLayers
from egotouch_sdk.synthetic.render import Layers
from egotouch_sdk.synthetic.series import LabelledLayers
from egotouch_sdk.synthetic.srgb import linear_to_srgb


def write_shard(path: Path, patches: Sequence[LabelledLayers]) -> None:
    """Write one shard; a reader never sees it half done."""
    write_layers(path, [light_layers(patch.layers) for patch in patches], [patch.labels for patch in patches])


def write_layers(path: Path, layers: Sequence[LightLayers], metas: Sequence[dict[str, Any]]) -> None:
    """Write pictures and what is true of them as one file; a reader never sees it half done."""
    scratch = path.with_suffix(f".{os.getpid()}.tmp")
    with scratch.open("wb") as file:
        np.savez_compressed(
            file,
            light=np.stack([picture.light for picture in layers]),
            albedo=np.stack([picture.albedo for picture in layers]),
            segment=np.stack([picture.segment for picture in layers]),
            depth_mm=np.stack([picture.depth_mm for picture in layers]),
            meta=np.array(json.dumps(metas)),
        )
    scratch.replace(path)


def light_layers(layers: Layers) -> LightLayers:
    """Rendered layers as training reads them from a shard, with the same rounding."""
    middle = layers.depth_m.shape[0] // 2
    depth_mm = np.clip((layers.depth_m - layers.depth_m[middle, middle]) * 1e3, -300, 300)
    return LightLayers(
        np.clip(layers.light, 0, 60).astype(np.float16), linear_to_srgb(layers.albedo), layers.segment, depth_mm.astype(np.float16)
    )
