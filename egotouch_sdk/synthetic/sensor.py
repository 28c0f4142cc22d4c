"""The digital half of the training-time camera: noise, tone curve and sharpening, then the patch's resolution."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.observation import PATCH_PX
from egotouch_sdk.synthetic.camera_settings import CameraSettings

#: Luma weights (ITU-R BT.709), linear RGB.
LUMA = np.array([0.2126, 0.7152, 0.0722], np.float32)


def develop(image: npt.NDArray[np.float32], settings: CameraSettings, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    """Exposed linear light (100, 100, 3) to RGB codes, uint8 (n, n, 3), at the camera's own n pixels across the patch, at most 100."""
    native = min(settings.native_px, PATCH_PX)
    if native < PATCH_PX:
        image = np.asarray(cv2.resize(image, (native, native), interpolation=cv2.INTER_AREA), np.float32)
    grain = cv2.GaussianBlur(rng.standard_normal(image.shape, np.float32), (0, 0), settings.noise_grain_px)
    shot = np.sqrt(np.maximum(image, 0.0) * (settings.noise * 0.06) + settings.noise**2)
    image = np.maximum(image + grain * shot, 0.0)
    image = image * (1 + settings.shoulder) / (1 + settings.shoulder * image)
    tone = cv2.pow(np.minimum(image, 1.0), 1 / settings.gamma)
    tone = 0.5 + (tone - 0.5) * settings.contrast + settings.haze
    luma = (tone @ LUMA)[..., None]
    tone = luma + (tone - luma) * settings.saturation
    if settings.sharpening > 0:
        tone = tone + settings.sharpening * (tone - cv2.GaussianBlur(tone, (0, 0), 1.0))
    return np.clip(tone * 255 + 0.5, 0, 255).astype(np.uint8)


def upscale(codes: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """A square picture at the patch's resolution, uint8 (100, 100, 3)."""
    if codes.shape[0] < PATCH_PX:
        codes = np.asarray(cv2.resize(codes, (PATCH_PX, PATCH_PX), interpolation=cv2.INTER_LINEAR), np.uint8)
    return np.ascontiguousarray(codes, np.uint8)
