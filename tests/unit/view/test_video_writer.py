from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources import VideoFileSource
from egotouch_sdk.view.video_writer import VideoWriter


def grey(level: int) -> np.ndarray:
    return np.full((48, 64, 3), level, np.uint8)


def levels(path: Path) -> list[int]:
    with VideoFileSource(path) as source:
        return [round(float(frame.image.mean()) / 50) * 50 for frame in source]


def test_what_was_written_can_be_played(tmp_path: Path) -> None:
    writer = VideoWriter(tmp_path / "out.mp4", fps=24.0, width_px=64, height_px=48)
    for index, level in enumerate((0, 100, 200)):
        writer.write(grey(level), round(index * 1e9 / 24))
    writer.close()
    with VideoFileSource(tmp_path / "out.mp4") as source:
        assert source.fps == 24.0
        assert [round(frame.image.mean(), -1) for frame in source] == [0, 100, 200]


def test_a_slow_source_plays_at_its_own_speed(tmp_path: Path) -> None:
    writer = VideoWriter(tmp_path / "out.mp4", fps=30.0, width_px=64, height_px=48)
    for time_ms, level in ((1000, 0), (1100, 100), (1200, 200)):
        writer.write(grey(level), time_ms * 10**6)
    writer.close()
    assert levels(tmp_path / "out.mp4") == [0, 0, 0, 100, 100, 100, 200]


def test_a_fast_source_leaves_pictures_out(tmp_path: Path) -> None:
    writer = VideoWriter(tmp_path / "out.mp4", fps=10.0, width_px=64, height_px=48)
    for index in range(21):
        writer.write(grey(200 if index >= 11 else 0), index * 50 * 10**6)
    writer.close()
    assert 10 <= len(levels(tmp_path / "out.mp4")) <= 12


def test_a_long_gap_is_shortened(tmp_path: Path) -> None:
    writer = VideoWriter(tmp_path / "out.mp4", fps=10.0, width_px=64, height_px=48)
    for time_s in (0, 3600, 3601):
        writer.write(grey(0), time_s * 10**9)
    writer.close()
    assert len(levels(tmp_path / "out.mp4")) == 61


@pytest.mark.parametrize("name", ["out.avi", "out", "gone/out.mp4"])
def test_a_path_that_cannot_be_written_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(SourceError, match=r"save|folder"):
        VideoWriter(tmp_path / name, fps=None, width_px=64, height_px=48)


def test_a_folder_in_the_way_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out.mp4").mkdir()
    with pytest.raises(SourceError, match="cannot write"):
        VideoWriter(tmp_path / "out.mp4", fps=None, width_px=64, height_px=48)
