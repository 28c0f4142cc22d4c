"""One way to open any source."""

from __future__ import annotations

from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources.base import FrameSource
from egotouch_sdk.sources.camera import CameraSource
from egotouch_sdk.sources.image_folder import IMAGE_SUFFIXES, ImageFolderSource
from egotouch_sdk.sources.presentation import FALLBACK_FPS
from egotouch_sdk.sources.video_file import VideoFileSource


def open_source(
    spec: int | str | Path, *, fps: float | None = None, width_px: int | None = None, height_px: int | None = None
) -> FrameSource:
    """Open what `spec` names: a camera index (`0`), a device (`/dev/video0`), a URL, a video, an image or a folder of images.

    `fps` is the rate of a folder (default 30), replaces the times of a video, and is asked of a camera; `width_px` and
    `height_px` are asked of a camera and ignored elsewhere. Raises `SourceError` when there is nothing to read.
    """
    text = str(spec)
    if text.isdigit():
        return CameraSource(int(text), width_px=width_px, height_px=height_px, fps=fps)
    path = Path(text)
    if "://" in text or path.is_char_device():
        return CameraSource(text, width_px=width_px, height_px=height_px, fps=fps)
    if path.is_dir() or (path.is_file() and path.suffix.lower() in IMAGE_SUFFIXES):
        return ImageFolderSource(path, fps=fps or FALLBACK_FPS)
    if path.is_file():
        return VideoFileSource(path, fps=fps)
    raise SourceError(f"no such source: {text}", hint="Give a camera index (0), a URL, a video file, an image or a folder of images")
