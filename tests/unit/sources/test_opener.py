from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources import FrameSource, ImageFolderSource, VideoFileSource, open_source


def test_a_video_file_opens_as_such(write_video) -> None:
    with open_source(write_video(), fps=10.0) as source:
        assert isinstance(source, VideoFileSource)
        assert source.fps == 10.0


def test_a_folder_and_a_picture_open_as_images(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "photo.JPG"), np.zeros((40, 40, 3), np.uint8))
    assert isinstance(open_source(tmp_path), ImageFolderSource)
    assert isinstance(open_source(str(tmp_path / "photo.JPG")), ImageFolderSource)


@pytest.mark.parametrize("spec", [95, "95"])
def test_a_number_is_a_camera(spec: int | str) -> None:
    with pytest.raises(SourceError, match="cannot open camera 95"):
        open_source(spec)


def test_a_url_is_a_camera() -> None:
    with pytest.raises(SourceError, match="cannot open camera rtsp://"):
        open_source("rtsp://127.0.0.1:9/stream")


def test_nothing_there_says_what_can_be_given(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"no such source: .*gone.* Give a camera index"):
        open_source(tmp_path / "gone")


def test_every_source_keeps_the_protocol(write_video) -> None:
    assert isinstance(open_source(write_video()), FrameSource)
