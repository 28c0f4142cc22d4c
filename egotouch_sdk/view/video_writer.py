"""Saving the annotated view as a video file."""

from __future__ import annotations

from pathlib import Path

import cv2

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources.opencv import quiet
from egotouch_sdk.sources.presentation import FALLBACK_FPS
from egotouch_sdk.view.palette import Image

#: A longer gap between two pictures is shortened to this in the file (our choice).
MAX_HOLD_S = 5.0


class VideoWriter:
    """Writes BGR images of one size into an .mp4 (MPEG-4 Part 2, the one codec that every OpenCV wheel can encode).

    The file has a constant rate, `fps` (default 30): a picture is repeated until the next one is due and left out when the next
    one is due at once, so the file plays at the speed of the source. It is playable once `close()` has run.
    Raises `SourceError` when the file cannot be created.
    """

    def __init__(self, path: str | Path, *, fps: float | None, width_px: int, height_px: int) -> None:
        self.path = Path(path)
        if self.path.suffix.lower() != ".mp4":
            raise SourceError(f"cannot save a video as {self.path}", hint="Give a file name that ends in .mp4")
        if not self.path.parent.is_dir():
            raise SourceError(f"there is no folder {self.path.parent} to save {self.path.name} in", hint="Create it first")
        fourcc = cv2.VideoWriter.fourcc(*"mp4v")
        with quiet():
            self._writer = cv2.VideoWriter(str(self.path), fourcc, fps or FALLBACK_FPS, (width_px, height_px))
        if not self._writer.isOpened():
            raise SourceError(f"cannot write {self.path}", hint="Check that the folder is writable and the disk is not full")
        self._fps = fps or FALLBACK_FPS
        self._origin_ns: int | None = None
        self._written = 0
        self._last: Image | None = None

    def write(self, image: Image, timestamp_ns: int) -> None:
        """Show `image` from `timestamp_ns` on; times rise."""
        if self._origin_ns is None:
            self._origin_ns = timestamp_ns
        due = round((timestamp_ns - self._origin_ns) * self._fps / 1e9)
        self._hold(due)
        if self._written <= due:
            self._append(image)
        self._last = image

    def _hold(self, until: int) -> None:
        """Repeat the last picture up to frame number `until`; a long gap moves the origin instead."""
        surplus = until - max(self._written - 1, 0) - round(MAX_HOLD_S * self._fps)
        if surplus > 0 and self._origin_ns is not None:
            self._origin_ns += round(surplus * 1e9 / self._fps)
            until -= surplus
        while self._last is not None and self._written < until:
            self._append(self._last)

    def _append(self, image: Image) -> None:
        self._writer.write(image)
        self._written += 1

    def close(self) -> None:
        """Write the index and close the file; may be called twice."""
        self._writer.release()
