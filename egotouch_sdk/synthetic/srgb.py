"""The sRGB transfer curve (IEC 61966-2-1), both ways."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def srgb_to_linear(srgb_255: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Linear values 0..1 of sRGB values 0..255, any shape."""
    value = np.asarray(srgb_255, dtype=np.float64) / 255
    return np.asarray(np.where(value < 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4), np.float64)


def linear_to_srgb(linear: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """sRGB codes 0..255 of linear values, any shape; values outside 0..1 are clipped."""
    value = np.clip(np.asarray(linear), 0.0, 1.0)
    return np.round(255 * np.where(value < 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)).astype(np.uint8)
