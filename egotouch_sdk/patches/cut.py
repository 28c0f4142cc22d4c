"""The one crop, used live, in training and in evaluation."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, hypot

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.observation import PATCH_MM, PATCH_PX

#: Patch resolution on the skin, 2.5 px per mm (100 px for 40 mm; EgoTouch, UIST'24, section 4).
PATCH_PX_PER_MM = PATCH_PX / PATCH_MM
#: Pixel coordinate of the patch's centre; whole numbers are pixel centres, so 100 px span -0.5 .. 99.5.
PATCH_CENTRE_PX = (PATCH_PX - 1) / 2
#: Most samples per patch pixel and axis when minifying; 8 covers a 12-megapixel close-up (our choice).
MAX_OVERSAMPLING = 8


def cut_patch(
    image_bgr: npt.NDArray[np.uint8],
    tip_px: Sequence[float] | npt.NDArray[np.floating],
    up_px: Sequence[float] | npt.NDArray[np.floating],
    px_per_mm: float,
    mirror: bool,
) -> npt.NDArray[np.uint8]:
    """Cut the 40 x 40 mm around a fingertip out of an image, turned so that the finger points up.

    `image_bgr` (H, W, 3) uint8. `tip_px` (2,) is the fingertip in image pixels (x right, y down, whole numbers are
    pixel centres); it lands on the patch's exact centre, 49.5. `up_px` (2,) is the finger's direction DIP to TIP, of any
    length. `px_per_mm` is the image's scale at the tip, > 0. `mirror` flips left and right, for a left touching hand.
    Beyond the image the border pixel is repeated. Shrinking averages every image pixel it covers, so there is no aliasing.

    Returns uint8 (100, 100, 3) RGB. Raises `FrameError` when the direction has no length or the scale is not positive.
    """
    up_x, up_y = float(up_px[0]), float(up_px[1])
    length = hypot(up_x, up_y)
    if not (length > 0.0 and np.isfinite(length)):
        raise FrameError("the finger's direction has no length", hint="Give the vector from the DIP joint to the tip in pixels")
    if not (px_per_mm > 0.0 and np.isfinite(px_per_mm)):
        raise FrameError(f"px_per_mm is {px_per_mm}, need > 0")
    step = px_per_mm / PATCH_PX_PER_MM
    oversampling = min(max(ceil(step), 1), MAX_OVERSAMPLING)
    to_image = _patch_to_image(tip_px, (up_x / length, up_y / length), step, oversampling, mirror)
    side = PATCH_PX * oversampling
    patch = cv2.warpAffine(
        image_bgr, to_image, (side, side), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_REPLICATE
    )
    if oversampling > 1:
        patch = cv2.resize(patch, (PATCH_PX, PATCH_PX), interpolation=cv2.INTER_AREA)
    return np.asarray(cv2.cvtColor(patch, cv2.COLOR_BGR2RGB), np.uint8)


def _patch_to_image(
    tip_px: Sequence[float] | npt.NDArray[np.floating],
    up: tuple[float, float],
    step: float,
    oversampling: int,
    mirror: bool,
) -> npt.NDArray[np.float64]:
    """Affine map (2, 3) from the oversampled patch to the image; `step` is image px per patch px."""
    fine = step / oversampling
    centre = (PATCH_PX * oversampling - 1) / 2
    side = -1.0 if mirror else 1.0
    right_x, right_y = -up[1] * fine * side, up[0] * fine * side
    down_x, down_y = -up[0] * fine, -up[1] * fine
    return np.array(
        [
            [right_x, down_x, float(tip_px[0]) - centre * (right_x + down_x)],
            [right_y, down_y, float(tip_px[1]) - centre * (right_y + down_y)],
        ]
    )
