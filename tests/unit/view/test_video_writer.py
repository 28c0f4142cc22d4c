from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources import VideoFileSource
from egotouch_sdk.view.video_writer import VideoWriter


def test_what_was_written_can_be_played(tmp_path: Path) -> None:
    writer = VideoWriter(tmp_path / "out.mp4", fps=24.0, width_px=64, height_px=48)
    for level in (0, 100, 200):
        writer.write(np.full((48, 64, 3), level, np.uint8))
    writer.close()
    with VideoFileSource(tmp_path / "out.mp4") as source:
        assert source.fps == 24.0
        assert [round(frame.image.mean(), -1) for frame in source] == [0, 100, 200]


@pytest.mark.parametrize("name", ["out.avi", "out", "gone/out.mp4"])
def test_a_path_that_cannot_be_written_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(SourceError, match=r"save|folder"):
        VideoWriter(tmp_path / name, fps=None, width_px=64, height_px=48)


def test_a_folder_in_the_way_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out.mp4").mkdir()
    with pytest.raises(SourceError, match="cannot write"):
        VideoWriter(tmp_path / "out.mp4", fps=None, width_px=64, height_px=48)
