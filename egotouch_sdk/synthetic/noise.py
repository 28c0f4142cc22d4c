"""Smooth and cellular noise on points in space: the raw material of baked skin."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt
from scipy.ndimage import map_coordinates
from scipy.signal import resample
from scipy.spatial import cKDTree

from egotouch_sdk.synthetic.linalg import Array

_CELLS = 32
_SAMPLES_PER_CELL = 4
#: Seeds of a cell pattern per (metre / cell size)^2; 0.09 m^2 is about the skin of a hand and half a forearm.
_CELL_AREA_M2 = 0.09


@lru_cache(maxsize=1)
def _lattice() -> npt.NDArray[np.float32]:
    """Periodic white noise of 32^3 cells, band-limited to four samples a cell; mean 0, standard deviation about 1."""
    values = np.random.default_rng(0).standard_normal((_CELLS,) * 3)
    for axis in range(3):
        values = resample(values, _CELLS * _SAMPLES_PER_CELL, axis=axis)
    return values.astype(np.float32)


def noise(points: Array, scale_m: float, seed: int) -> Array:
    """Smooth noise (n,) with mean about 0 and standard deviation about 1 at `points` (n, 3) in metres.

    `scale_m` is the size of a blob; the seed turns and shifts one periodic lattice, so equal seeds give equal noise.
    """
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    cell = points @ turn.T / scale_m + rng.uniform(0, _CELLS, 3)
    return np.asarray(map_coordinates(_lattice(), (cell * _SAMPLES_PER_CELL).T, order=1, mode="grid-wrap"), np.float64)


def cell_borders(points: Array, scale_m: float, seed: int) -> Array:
    """Worley noise F2 - F1 (n,) in cell sizes at surface `points` (n, 3) in metres: 0 on the borders between cells.

    Cells are about `scale_m` wide, their seeds lie near the surface (skin's polygonal furrows).
    """
    rng = np.random.default_rng(seed)
    count = int(_CELL_AREA_M2 / scale_m**2)
    seeds = points[rng.integers(0, len(points), count)] + rng.normal(0, 0.3 * scale_m, (count, 3))
    distance, _ = cKDTree(seeds).query(points, k=2)
    return np.asarray((distance[:, 1] - distance[:, 0]) / scale_m, np.float64)
