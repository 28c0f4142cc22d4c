"""Small vector helpers for the generator; lengths in metres, float64."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]
Mask: TypeAlias = npt.NDArray[np.bool_]


def unit(vector: Array) -> Array:
    """`vector` scaled to length 1; shape (3,)."""
    return np.asarray(vector / np.linalg.norm(vector), np.float64)


def reject_from(vector: Array, axis: Array) -> Array:
    """The part of `vector` (3,) at right angles to the unit vector `axis`, scaled to length 1."""
    return unit(vector - axis * float(vector @ axis))


def smoothstep(low: float, high: float, value: Array) -> Array:
    """Hermite step from 0 at `low` to 1 at `high`, elementwise."""
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t), np.float64)


def bone_frame(axis: Array, dorsal: Array) -> Array:
    """Rotation (3, 3) whose columns are WebXR bone axes: +x right, +y dorsal, -z along `axis` (both unit, at right angles)."""
    return np.stack([np.cross(dorsal, -axis), dorsal, -axis], 1)
