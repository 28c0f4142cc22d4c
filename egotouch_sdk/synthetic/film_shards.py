"""Shards of training films on disk: written once, whole or not at all, and read back by training.

One `.npz` holds the pictures of all its films one after the other: `light` float16 (U, S, S, 3), `albedo` uint8 (U, S, S, 3) sRGB-encoded
RGB, `segment` uint8 (U, S, S), `depth_mm` float16 (U, S, S), S = 132 at 2.5 px/mm with the tip in the centre, as in `LightLayers`; and
`meta`: a JSON list of films, each with `first` and `pictures` (where its pictures lie), labels of the film and of each of its frames.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from egotouch_sdk.synthetic.shards import write_layers
from egotouch_sdk.synthetic.training_film import LabelledFilm

PATTERN = "films-*.npz"


def write_films(path: Path, films: Sequence[LabelledFilm]) -> None:
    """Write one shard; a reader never sees it half done."""
    layers = [picture for each in films for picture in each.layers]
    metas: list[dict[str, Any]] = []
    first = 0
    for each in films:
        metas.append({**each.labels, "first": first, "pictures": len(each.layers)})
        first += len(each.layers)
    write_layers(path, layers, metas)
