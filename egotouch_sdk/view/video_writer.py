"""Saving the annotated view as a video file."""

from __future__ import annotations

from pathlib import Path

import cv2

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources.opencv import quiet
from egotouch_sdk.sources.presentation import FALLBACK_FPS
from egotouch_sdk.view.palette import Image


class VideoWriter:
    """Writes BGR images of one size into an .mp4 (MPEG-4 Part 2, the one codec that every OpenCV wheel can encode).

    The file is playable once `close()` has run, however many frames were written.
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

    def write(self, image: Image) -> None:
        """Append one image."""
        self._writer.write(image)

    def close(self) -> None:
        """Write the index and close the file; may be called twice."""
        self._writer.release()
