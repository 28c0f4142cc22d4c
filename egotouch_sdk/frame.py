"""One camera image with its capture time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError

#: Smallest side that hand tracking can work on; below it a frame is refused (our choice).
MIN_SIDE_PX = 32


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One image from a camera: `image` (H, W, 3) uint8 BGR, stamped at capture.

    `timestamp_ns` is integer, monotonic and strictly rising within one source; `index` counts frames from 0.
    Raises `FrameError` for a wrong dtype, shape, size or a negative time.
    """

    image: npt.NDArray[np.uint8]
    timestamp_ns: int
    index: int

    def __post_init__(self) -> None:
        image: object = self.image
        if not isinstance(image, np.ndarray) or image.ndim != 3 or image.shape[2] != 3:
            shape = getattr(image, "shape", None)
            raise FrameError(f"frame image has shape {shape}, need (height, width, 3)", hint="Convert it to BGR first")
        if image.dtype != np.uint8:
            raise FrameError(f"frame image is {image.dtype}, need uint8", hint="Scale it to 0..255 and convert with astype(np.uint8)")
        if min(image.shape[:2]) < MIN_SIDE_PX:
            size = f"{image.shape[1]}x{image.shape[0]}"
            raise FrameError(f"frame image is {size} px, need at least {MIN_SIDE_PX} px a side", hint="Use a larger image")
        if self.timestamp_ns < 0 or self.index < 0:
            raise FrameError(f"frame has timestamp_ns={self.timestamp_ns}, index={self.index}; both must be >= 0")

    @property
    def width_px(self) -> int:
        """Image width in pixels."""
        return int(self.image.shape[1])

    @property
    def height_px(self) -> int:
        """Image height in pixels."""
        return int(self.image.shape[0])
