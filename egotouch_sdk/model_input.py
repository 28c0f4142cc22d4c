"""From patches to the touch model's input, the same in live use, training and evaluation."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.observation import PATCH_PX

#: Added to a patch's own standard deviation so that a flat patch is not blown up to noise (our choice, images in 0..1).
STD_FLOOR = 0.05


def normalise(patches: npt.NDArray[np.uint8]) -> npt.NDArray[np.float32]:
    """Scale patches so that exposure and contrast cancel and colour stays.

    `patches` uint8 (N, 100, 100, 3) RGB. Each patch is scaled to 0..1, its own mean over all pixels and channels is
    subtracted, and it is divided by its own standard deviation + 0.05.
    Returns float32 (N, 3, 100, 100), contiguous. Raises `FrameError` for another shape or type.
    """
    if patches.dtype != np.uint8 or patches.ndim != 4 or patches.shape[1:] != (PATCH_PX, PATCH_PX, 3):
        raise FrameError(f"patches are {patches.dtype} {patches.shape}, need uint8 (N, {PATCH_PX}, {PATCH_PX}, 3)")
    planes = np.ascontiguousarray(patches.transpose(0, 3, 1, 2), np.float32)
    flat = planes.reshape(len(planes), 3 * PATCH_PX * PATCH_PX)
    flat *= np.float32(1 / 255)
    flat -= flat.mean(axis=1, keepdims=True)
    std = np.sqrt(np.einsum("ij,ij->i", flat, flat) / flat.shape[1])
    flat /= (std + STD_FLOOR)[:, None]
    return planes
