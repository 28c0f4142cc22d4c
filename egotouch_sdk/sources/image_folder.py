"""Frames from still images: a folder in natural order, or a single picture."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import ConfigError, FrameError, SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.sources.base import FrameSource
from egotouch_sdk.sources.opencv import quiet
from egotouch_sdk.sources.presentation import FALLBACK_FPS, sound_fps

IMAGE_SUFFIXES = frozenset({".bmp", ".jpeg", ".jpg", ".png", ".tif", ".tiff", ".webp"})


def natural_key(name: str) -> tuple[tuple[int, int | str], ...]:
    """Sort key under which `frame9` comes before `frame10`, whatever the case."""
    return tuple((0, int(part)) if part.isdigit() else (1, part) for part in re.split(r"([0-9]+)", name.casefold()) if part)


def read_image(path: str | Path) -> npt.NDArray[np.uint8]:
    """A picture as (H, W, 3) uint8 BGR, turned upright by its EXIF orientation; 16-bit images are brought to 8 bits.

    Raises `SourceError` when the file is missing or is no image, `FrameError` for floating-point pixels.
    """
    path = Path(path)
    if not path.is_file():
        raise SourceError(f"no such image file: {path}", hint="Check the path")
    data = np.fromfile(path, np.uint8)
    with quiet():
        try:
            image = cv2.imdecode(data, cv2.IMREAD_COLOR | cv2.IMREAD_ANYDEPTH) if data.size else None
        except cv2.error:
            image = None
    if image is None:
        raise SourceError(f"cannot read {path} as an image", hint="Use a PNG, JPEG, WebP, BMP or TIFF file that an image viewer opens")
    if image.dtype == np.uint16:
        image = (np.asarray(image, np.uint16) >> 8).astype(np.uint8)
    if image.dtype != np.uint8:
        raise FrameError(f"{path} holds {image.dtype} pixels, need 8 or 16 bits per channel", hint="Scale it to 0..255 and save it as PNG")
    return np.ascontiguousarray(image, np.uint8)


class ImageFolderSource(FrameSource):
    """Reads the images of a folder in natural order, or one image file, as frames `1 / fps` seconds apart.

    Other files and hidden files in the folder are passed over. Images may differ in size.
    Raises `SourceError` for a folder without images and for a file that is no image.
    """

    def __init__(self, path: str | Path, *, fps: float = FALLBACK_FPS) -> None:
        path = Path(path)
        if sound_fps(fps) is None:
            raise ConfigError(f"fps is {fps}, need more than 0 and at most 1000")
        if path.is_file():
            self._files = [path]
        elif path.is_dir():
            names = (p for p in path.iterdir() if p.suffix.lower() in IMAGE_SUFFIXES and not p.name.startswith(".") and p.is_file())
            self._files = sorted(names, key=lambda p: natural_key(p.name))
        else:
            raise SourceError(f"no such folder: {path}", hint="Check the path")
        if not self._files:
            raise SourceError(f"no images in {path}", hint=f"Put files in it that end in {', '.join(sorted(IMAGE_SUFFIXES))}")
        self._fps = float(fps)
        first = read_image(self._files[0])
        self._height_px, self._width_px = int(first.shape[0]), int(first.shape[1])

    @property
    def is_live(self) -> bool:
        """False: files wait."""
        return False

    @property
    def width_px(self) -> int | None:
        """Width of the first image in pixels."""
        return self._width_px

    @property
    def height_px(self) -> int | None:
        """Height of the first image in pixels."""
        return self._height_px

    @property
    def fps(self) -> float | None:
        """The rate given at construction."""
        return self._fps

    @property
    def frame_count(self) -> int | None:
        """Number of images."""
        return len(self._files)

    def __iter__(self) -> Iterator[Frame]:
        for index, file in enumerate(self._files):
            yield Frame(read_image(file), round(index * 1e9 / self._fps), index)

    def close(self) -> None:
        """Nothing to release: each file is closed once read."""
