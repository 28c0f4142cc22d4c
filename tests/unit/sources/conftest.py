from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

WriteVideo = Callable[..., Path]


@pytest.fixture
def write_video(tmp_path: Path) -> WriteVideo:
    """Writes a video whose frame `i` is uniformly grey `40 + 4 * i`, so that each frame can be told from its neighbours."""

    def write(
        name: str = "clip.mp4", frames: int = 20, fps: float = 30.0, size_px: tuple[int, int] = (96, 64), fourcc: str = "mp4v"
    ) -> Path:
        path = tmp_path / name
        writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*fourcc), fps, size_px)
        assert writer.isOpened()
        for index in range(frames):
            writer.write(np.full((size_px[1], size_px[0], 3), 40 + 4 * (index % 50), np.uint8))
        writer.release()
        return path

    return write
