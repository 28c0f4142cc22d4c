"""What a wide lens does to a small patch away from the middle of the picture: it stretches, darkens outwards and splits colours."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin, tan

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.observation import PATCH_PX

FloatImage = npt.NDArray[np.float32]

#: Farthest that a hand is from the lens's axis: half the field of view of an 80 degree camera.
MAX_FIELD_RAD = radians(40.0)
#: How much darker a patch's outer edge may be than its middle for each radian of field: 40 mm at 0.4 m (our choice of distance).
_PATCH_RAD = 0.1
#: Light of a plain lens falls off with this power of the field angle's cosine; lens shading correction takes out a part (our choice).
_FALL_OFF = 4.0
#: Largest shift of red against green, and of green against blue, at the edge of the field, in patch pixels (our choice: a pixel of 1080p).
_MAX_FRINGE_PX = 1.2


@dataclass(frozen=True, slots=True)
class Lens:
    """Where in the field of a lens a patch lies, and what that lens leaves uncorrected.

    `field_rad` is the angle from the axis, `outwards_rad` the direction away from it in the patch (0 right, towards +y down).
    `barrel` is 0 for a picture as of a pinhole, which stretches outwards, to 1 for equal angles (fisheye), which stretches along the rim.
    `shading` 0..1 is the share of the cosine-fourth fall-off that remains, `fringe_px` the shift of red and, the other way, of blue.
    """

    field_rad: float
    outwards_rad: float
    barrel: float
    shading: float
    fringe_px: float

    def stretch(self) -> npt.NDArray[np.float64]:
        """Area-keeping map (2, 2) from the scene to the picture around the patch's middle."""
        pinhole, rim = 1 / cos(self.field_rad), max(self.field_rad, 1e-6) / sin(max(self.field_rad, 1e-6))
        ratio = pinhole ** (1 - self.barrel) / rim**self.barrel
        c, s = cos(self.outwards_rad), sin(self.outwards_rad)
        turn = np.array([[c, -s], [s, c]])
        return np.asarray(turn @ np.diag([ratio**0.5, ratio**-0.5]) @ turn.T)

    def fall_off(self) -> FloatImage:
        """Factor on the light (100, 100, 1), 1 in the middle."""
        slope = self.shading * _FALL_OFF * tan(self.field_rad) * _PATCH_RAD
        at = (np.arange(PATCH_PX, dtype=np.float32) + 0.5) / PATCH_PX - 0.5
        outwards = cos(self.outwards_rad) * at[None, :] + sin(self.outwards_rad) * at[:, None]
        return np.exp(-slope * outwards).astype(np.float32)[..., None]

    def split_colours(self, image: FloatImage) -> FloatImage:
        """The picture (100, 100, 3) with red shifted outwards and blue inwards."""
        dx, dy = self.fringe_px * cos(self.outwards_rad), self.fringe_px * sin(self.outwards_rad)
        return np.stack([_shift(image[..., 0], dx, dy), image[..., 1], _shift(image[..., 2], -dx, -dy)], 2)


def draw_lens(rng: np.random.Generator) -> Lens:
    """A place in the field, every part of its area equally likely, and a lens somewhere between pinhole and fisheye."""
    field_rad = MAX_FIELD_RAD * float(np.sqrt(rng.random()))
    return Lens(
        field_rad=field_rad,
        outwards_rad=float(rng.uniform(0, 2 * np.pi)),
        barrel=float(rng.random()),
        shading=float(rng.uniform(0.0, 0.8)),
        fringe_px=float(np.clip(rng.normal(0, 0.4), -1, 1)) * _MAX_FRINGE_PX * field_rad / MAX_FIELD_RAD,
    )


def _shift(channel: FloatImage, dx: float, dy: float) -> FloatImage:
    move = np.array([[1.0, 0.0, dx], [0.0, 1.0, dy]])
    return np.asarray(cv2.warpAffine(channel, move, channel.shape[::-1], borderMode=cv2.BORDER_REPLICATE), np.float32)
