"""Procedural things behind the hands: desk, cloth, floor, clutter."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.linalg import Array, unit
from egotouch_sdk.synthetic.render import Backdrop
from egotouch_sdk.synthetic.srgb import srgb_to_linear

_SIZE = 256


def draw_texture(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """A random linear albedo texture (256, 256, 3): plain, striped, checked or mottled, with some objects on it."""
    base = srgb_to_linear(np.clip(rng.uniform(25, 235) * np.exp(rng.normal(0, rng.choice([0.07, 0.25], p=[0.7, 0.3]), 3)), 5, 245))
    y, x = np.mgrid[0:_SIZE, 0:_SIZE] / _SIZE
    noise = sum(cv2.resize(rng.standard_normal((2**k, 2**k)), (_SIZE, _SIZE), interpolation=cv2.INTER_CUBIC) / 1.6**k for k in range(2, 8))
    checks = rng.integers(3, 14)
    pattern = (
        1 + 0.08 * noise,
        1 + 0.12 * np.sin(2 * np.pi * (x * rng.uniform(4, 12) + 0.2 * noise)) + 0.08 * noise,
        1 + 0.3 * ((np.floor(x * checks) + np.floor(y * checks)) % 2 - 0.5) + 0.05 * noise,
        1 + 0.3 * noise,
    )[rng.integers(4)]
    image = np.ascontiguousarray(base * np.clip(pattern, 0.05, 3)[..., None])
    for _ in range(rng.integers(0, 14)):
        p = rng.integers(0, _SIZE, 2)
        q = p + rng.integers(5, 80, 2)
        cv2.rectangle(image, p.tolist(), q.tolist(), srgb_to_linear(rng.uniform(10, 245, 3)).tolist(), -1)
    return np.clip(cv2.GaussianBlur(image.astype(np.float32), (0, 0), rng.uniform(0.5, 3)), 0.004, 0.95).astype(np.float32)


def draw_backdrop(rng: np.random.Generator, contact: Array, view: Array, up: Array) -> Backdrop:
    """A random plane 8 to 50 cm behind the contact point, roughly facing the camera."""
    return Backdrop(contact - view * rng.uniform(0.08, 0.5), unit(view + rng.normal(0, 0.25, 3)), up, draw_texture(rng))


def calm_texture(rng: np.random.Generator, srgb: tuple[int, int, int]) -> npt.NDArray[np.float32]:
    """A quiet table top of one colour (linear albedo, 256 x 256): grain along one axis and slow variation, for clips."""
    y, x = np.mgrid[0:_SIZE, 0:_SIZE] / _SIZE
    slow = sum(cv2.resize(rng.standard_normal((2**k, 2**k)), (_SIZE, _SIZE), interpolation=cv2.INTER_CUBIC) / 1.6**k for k in range(2, 6))
    grain = cv2.GaussianBlur(rng.standard_normal((_SIZE, _SIZE)), (0, 0), sigmaX=14, sigmaY=0.8) * 5
    pattern = 1 + 0.06 * slow + 0.08 * grain + 0.05 * np.sin(2 * np.pi * (18 * y + 0.4 * slow + 0 * x))
    return np.clip(srgb_to_linear(np.array(srgb)) * np.clip(pattern, 0.3, 2)[..., None], 0.004, 0.95).astype(np.float32)
