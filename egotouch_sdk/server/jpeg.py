"""JPEG pictures from outside: how large they claim to be is known before anything is unpacked."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.frame import MIN_SIDE_PX

#: 4K UHD; 25 MB when unpacked (our choice).
MAX_PIXELS = 3840 * 2160
_SOI = b"\xff\xd8\xff"
#: Start of frame: baseline, extended and progressive, Huffman coded (ITU-T T.81, table B.1).
_FRAME_STARTS = frozenset({0xC0, 0xC1, 0xC2})
#: Markers that no length follows: TEM, RST0 to RST7, SOI.
_BARE = frozenset({0x01, *range(0xD0, 0xD9)})
_ENDS = frozenset({0xD9, 0xDA})
_HINT = "Send a whole baseline or progressive JPEG of 8 bits"


def jpeg_size(data: bytes) -> tuple[int, int]:
    """Width and height in pixels as the header says; raises `FrameError` for anything but a JPEG of a sensible size."""
    if not data.startswith(_SOI):
        raise FrameError(f"{len(data)} bytes are no JPEG", hint=_HINT)
    at = 2
    while at + 9 <= len(data) and data[at] == 0xFF:
        marker = data[at + 1]
        if marker in _FRAME_STARTS:
            height, width = int.from_bytes(data[at + 5 : at + 7]), int.from_bytes(data[at + 7 : at + 9])
            return _checked(width, height)
        if marker in _ENDS:
            break
        at += 1 if marker == 0xFF else 2 if marker in _BARE else 2 + int.from_bytes(data[at + 2 : at + 4])
    raise FrameError("the JPEG's header says no size", hint=_HINT)


def decode_jpeg(data: bytes) -> npt.NDArray[np.uint8]:
    """The picture (H, W, 3) BGR as its rows are coded, whatever EXIF says of its orientation; raises `FrameError` when there is none."""
    import cv2

    jpeg_size(data)
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)
    except cv2.error:
        image = None
    if image is None:
        raise FrameError("the JPEG is damaged or cut off", hint=_HINT)
    return np.asarray(image, np.uint8)


def _checked(width: int, height: int) -> tuple[int, int]:
    if min(width, height) < MIN_SIDE_PX or width * height > MAX_PIXELS:
        raise FrameError(f"the picture is {width}x{height} px", hint=f"Send {MIN_SIDE_PX} px a side to {MAX_PIXELS} px in all")
    return width, height
