"""A hovering finger with nothing but clutter behind it: the view of a hand that is nowhere near skin."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.camera import BACKGROUND, TOUCHING_HAND, LightLayers

#: Distance of the clutter behind the fingertip.
FAR_MM = 300.0


def in_the_air(layers: LightLayers, rng: np.random.Generator) -> LightLayers:
    """The same hand before random clutter, everything else gone; only for hovers, since it touches nothing then."""
    side = layers.segment.shape[0]
    hand = layers.segment == TOUCHING_HAND
    albedo = np.where(hand[..., None], layers.albedo, clutter(side, rng))
    level = np.float32(rng.uniform(0.3, 1.0)) * (1 + 0.3 * _smooth(side, 3, rng)[..., None])
    light = np.where(hand[..., None], layers.light, np.clip(level, 0.05, 1.5))
    segment = np.where(hand, TOUCHING_HAND, BACKGROUND)
    depth_mm = np.where(hand, layers.depth_mm, FAR_MM)
    return LightLayers(light.astype(np.float16), albedo.astype(np.uint8), segment.astype(np.uint8), depth_mm.astype(np.float16))


def clutter(side_px: int, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    """A background without hands, uint8 (side, side, 3): a colour, soft stains, and some hard-edged shapes."""
    colour = rng.uniform(10, 245) + rng.normal(0, 25, 3)
    stains = [_smooth(side_px, int(rng.integers(3, 24)), rng) for _ in range(3)]
    image = colour + rng.uniform(3, 40) * np.stack(stains, 2)
    image = np.clip(image, 0, 255).astype(np.uint8)
    for _ in range(rng.integers(0, 7)):
        corners = rng.uniform(-0.3, 1.3, (int(rng.integers(3, 6)), 1, 2)) * side_px
        cv2.fillPoly(image, [corners.astype(np.int32)], tuple(rng.uniform(0, 255, 3)), cv2.LINE_AA)
    return image


def _smooth(side_px: int, cells: int, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Noise of unit spread with about `cells` bumps across."""
    return np.asarray(
        cv2.resize(rng.standard_normal((cells, cells), np.float32), (side_px, side_px), interpolation=cv2.INTER_CUBIC), np.float32
    )
