"""Frames of a video file at their presentation times."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from egotouch_sdk.errors import SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.sources.base import FrameSource, SourceWarning
from egotouch_sdk.sources.opencv import open_capture
from egotouch_sdk.sources.presentation import PresentationTimes, sound_fps

#: A file may announce slightly more frames than it holds (edit lists, rounding); more missing than this is worth a warning.
MISSING_FRAMES_TOLERATED = 2
MISSING_SHARE_TOLERATED = 0.05
#: Reads that may fail in a row before the file counts as over: a damaged stretch is passed over (our choice, about 2 s).
FAILED_READS_TOLERATED = 60


class VideoFileSource(FrameSource):
    """Reads a video file; timestamps are presentation times with the first frame at 0 and always rise.

    `fps` replaces the file's own times by a constant rate. Each iteration starts at the first frame.
    Raises `SourceError` when the file is missing, is no video, or holds not one frame that decodes. A file that breaks off
    early or is damaged delivers what decodes and then ends with a `SourceWarning`.
    """

    def __init__(self, path: str | Path, *, fps: float | None = None) -> None:
        self.path = Path(path)
        if not self.path.is_file():
            raise SourceError(f"no such video file: {self.path}", hint="Check the path")
        self._constant_fps = fps
        self._capture = self._open()
        self._fresh = True
        self._fps = fps or sound_fps(self._capture.get(cv2.CAP_PROP_FPS))
        self._width_px = int(self._capture.get(cv2.CAP_PROP_FRAME_WIDTH)) or None
        self._height_px = int(self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT)) or None
        count = int(self._capture.get(cv2.CAP_PROP_FRAME_COUNT))
        self._frame_count = count if count > 0 else None

    @property
    def is_live(self) -> bool:
        """False: a file waits."""
        return False

    @property
    def width_px(self) -> int | None:
        """Image width in pixels as the file's header says."""
        return self._width_px

    @property
    def height_px(self) -> int | None:
        """Image height in pixels as the file's header says."""
        return self._height_px

    @property
    def fps(self) -> float | None:
        """Frames per second of the header, or None where that is nonsense."""
        return self._fps

    @property
    def frame_count(self) -> int | None:
        """Number of frames of the header; an estimate for some containers."""
        return self._frame_count

    def __iter__(self) -> Iterator[Frame]:
        if not self._fresh:
            self.close()
            self._capture = self._open()
        self._fresh = False
        times = PresentationTimes(self._fps, constant_fps=self._constant_fps)
        index = 0
        failed = 0
        while failed < FAILED_READS_TOLERATED:
            ok, image = self._capture.read()
            if not ok:
                failed += 1
                continue
            failed = 0
            yield Frame(np.asarray(image, np.uint8), times.next_ns(self._capture.get(cv2.CAP_PROP_POS_MSEC)), index)
            index += 1
        self._check_end(index, times.repaired)

    def close(self) -> None:
        """Close the file."""
        self._capture.release()

    def _open(self) -> cv2.VideoCapture:
        capture = open_capture(str(self.path), cv2.CAP_FFMPEG)
        if capture is None:
            raise SourceError(
                f"cannot read {self.path} as a video (not a video, cut off before its index, or an unknown codec)",
                hint="Check that a player opens it, or convert it to H.264 in an .mp4",
            )
        return capture

    def _check_end(self, delivered: int, repaired: int) -> None:
        if delivered == 0:
            raise SourceError(f"not one frame of {self.path} can be decoded", hint="Record or convert the file again")
        announced = self._frame_count or delivered
        if announced - delivered > max(MISSING_FRAMES_TOLERATED, MISSING_SHARE_TOLERATED * announced):
            warnings.warn(f"{self.path} is damaged or cut off: {delivered} of {announced} frames decoded", SourceWarning, stacklevel=3)
        if repaired:
            warnings.warn(f"{self.path} states times that do not rise; {repaired} were replaced", SourceWarning, stacklevel=3)
