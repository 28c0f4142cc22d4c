"""One way to open any source."""

from __future__ import annotations

from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources.base import FrameSource, ObservationSource
from egotouch_sdk.sources.camera import CameraSource
from egotouch_sdk.sources.image_folder import IMAGE_SUFFIXES, ImageFolderSource
from egotouch_sdk.sources.presentation import FALLBACK_FPS
from egotouch_sdk.sources.video_file import VideoFileSource

#: Files that are simulator scripts.
SCRIPT_SUFFIXES = frozenset({".yaml", ".yml"})
RECORDING_SUFFIX = ".mcap"

_HINT = "Give a camera index (0), a URL, a video file, an image, a folder of images, a recording (.mcap) or a simulator script (.yaml)"


def open_source(
    spec: int | str | Path, *, fps: float | None = None, width_px: int | None = None, height_px: int | None = None
) -> FrameSource | ObservationSource:
    """Open what `spec` names: a camera index (`0`), a device (`/dev/video0`), a URL, a video, an image or a folder of images.

    A recording (`.mcap`) and a simulator script (`.yaml`, `.yml`) open as sources of observations.
    `fps` is the rate of a folder (default 30), replaces the times of a video and the rate of a script, and is asked of a camera;
    `width_px` and `height_px` are asked of a camera and ignored elsewhere. Raises `SourceError` when there is nothing to read.
    """
    text = str(spec)
    if text.isdigit():
        return CameraSource(int(text), width_px=width_px, height_px=height_px, fps=fps)
    path = Path(text)
    if "://" in text or path.is_char_device():
        return CameraSource(text, width_px=width_px, height_px=height_px, fps=fps)
    if path.is_dir() or (path.is_file() and path.suffix.lower() in IMAGE_SUFFIXES):
        return ImageFolderSource(path, fps=fps or FALLBACK_FPS)
    if path.is_file() and path.suffix.lower() in SCRIPT_SUFFIXES:
        from egotouch_sdk.simulator import ScriptSource

        return ScriptSource(path, fps=fps)
    if path.is_file() and path.suffix.lower() == RECORDING_SUFFIX:
        from egotouch_sdk.recording import RecordingSource

        return RecordingSource(path)
    if path.is_file():
        return VideoFileSource(path, fps=fps)
    raise SourceError(f"no such source: {text}", hint=_HINT)


def open_frames(
    spec: int | str | Path, *, fps: float | None = None, width_px: int | None = None, height_px: int | None = None
) -> FrameSource:
    """As `open_source`, for what needs pictures; raises `SourceError` for a source of observations."""
    source = open_source(spec, fps=fps, width_px=width_px, height_px=height_px)
    if isinstance(source, ObservationSource):
        source.close()
        raise SourceError(f"{spec} has no pictures", hint="Give a camera, a video, an image or a folder of images")
    return source
