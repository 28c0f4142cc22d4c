"""What JPEG and H.264 leave of pictures: real encoders, not their imitation."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import MissingExtraError

Picture = npt.NDArray[np.uint8]

#: x264's preset: few searches per block as in a camera's encoder, which has no time for more (our choice).
_PRESET = "superfast"
_RATE = Fraction(1, 30)


def through_jpeg(picture: Picture, quality: int) -> Picture:
    """A picture, uint8 (H, W, 3) RGB, after JPEG of that quality (1..100)."""
    coded = cv2.imencode(".jpg", picture[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    return np.ascontiguousarray(np.asarray(cv2.imdecode(coded, cv2.IMREAD_COLOR))[..., ::-1], np.uint8)


def through_h264(pictures: Sequence[Picture], crf: int) -> list[Picture]:
    """A film of pictures, uint8 (H, W, 3) RGB of one size, after H.264 (4:2:0) at that constant rate factor (0 best, 51 worst).

    The first picture is coded alone, each later one from those before it, without a delay, as cameras stream. Raises
    `MissingExtraError` without PyAV.
    """
    try:
        import av
    except ImportError as error:
        raise MissingExtraError("H.264 in the training camera", "train") from error
    height, width = pictures[0].shape[:2]
    encoder = av.CodecContext.create("libx264", "w")
    encoder.width, encoder.height, encoder.pix_fmt = width + width % 2, height + height % 2, "yuv420p"
    encoder.time_base, encoder.thread_count = _RATE, 1
    encoder.options = {"crf": str(crf), "preset": _PRESET, "tune": "zerolatency"}
    decoder = av.CodecContext.create("h264", "r")
    decoder.thread_count = 1
    packets = [packet for picture in pictures for packet in encoder.encode(av.VideoFrame.from_ndarray(_even(picture), format="rgb24"))]
    packets += encoder.encode(None)
    decoded = [frame for packet in [*packets, None] for frame in decoder.decode(packet)]
    return [np.ascontiguousarray(frame.to_ndarray(format="rgb24")[:height, :width], np.uint8) for frame in decoded]


def _even(picture: Picture) -> Picture:
    """The picture with its last row and column doubled where their number is odd, which 4:2:0 cannot have."""
    height, width = picture.shape[:2]
    return np.ascontiguousarray(np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge"))
