"""Opening captures with OpenCV without its messages on stderr."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

# FFmpeg's own log level (-8 is AV_LOG_QUIET, libavutil/log.h) is read when OpenCV first opens a video.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")

import cv2

#: OpenCV 4 has the two functions at the top level, OpenCV 5 in a module of their own.
_LOGGING: Any = cv2 if hasattr(cv2, "setLogLevel") else cv2.utils.logging
#: `LOG_LEVEL_SILENT` of both.
_SILENT = 0


@contextmanager
def quiet() -> Iterator[None]:
    """Silence OpenCV's logger while the block runs; our typed errors say what is wrong instead."""
    level = _LOGGING.getLogLevel()
    _LOGGING.setLogLevel(_SILENT)
    try:
        yield
    finally:
        _LOGGING.setLogLevel(level)


def open_capture(target: str | int, backend: int = cv2.CAP_ANY, params: list[int] | None = None) -> cv2.VideoCapture | None:
    """An opened `cv2.VideoCapture`, or None when OpenCV cannot open `target`."""
    with quiet():
        try:
            capture = cv2.VideoCapture(target, backend, params or [])
        except cv2.error:
            return None
        if capture.isOpened():
            return capture
        capture.release()
        return None
