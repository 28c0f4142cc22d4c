from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError, FrameError, SourceError
from egotouch_sdk.sources import ImageFolderSource, read_image
from egotouch_sdk.sources.image_folder import natural_key


def save(path: Path, value: int = 128, size_px: tuple[int, int] = (64, 48)) -> Path:
    assert cv2.imwrite(str(path), np.full((size_px[1], size_px[0], 3), value, np.uint8))
    return path


def test_natural_order_reads_numbers_as_numbers() -> None:
    names = ["frame10.png", "frame9.png", "Frame1.png", "a.png", "12.png", "frame2b.png"]
    assert sorted(names, key=natural_key) == ["12.png", "a.png", "Frame1.png", "frame2b.png", "frame9.png", "frame10.png"]


def test_images_come_in_natural_order_at_the_given_rate(tmp_path: Path) -> None:
    for number in (10, 9, 1):
        save(tmp_path / f"frame{number}.png", number)
    with ImageFolderSource(tmp_path, fps=20.0) as source:
        frames = list(source)
    assert [int(frame.image[0, 0, 0]) for frame in frames] == [1, 9, 10]
    assert [frame.timestamp_ns for frame in frames] == [0, 50_000_000, 100_000_000]
    assert (source.frame_count, source.fps, source.is_live) == (3, 20.0, False)


def test_other_and_hidden_files_are_passed_over(tmp_path: Path) -> None:
    save(tmp_path / "a.png")
    save(tmp_path / ".b.png")
    (tmp_path / "notes.txt").write_text("no image")
    assert ImageFolderSource(tmp_path).frame_count == 1


def test_images_may_change_size(tmp_path: Path) -> None:
    save(tmp_path / "1.png", size_px=(64, 48))
    save(tmp_path / "2.png", size_px=(100, 50))
    assert [(frame.width_px, frame.height_px) for frame in ImageFolderSource(tmp_path)] == [(64, 48), (100, 50)]


def test_one_picture_is_a_source_of_one_frame(tmp_path: Path) -> None:
    (frame,) = ImageFolderSource(save(tmp_path / "photo.png"))
    assert (frame.timestamp_ns, frame.index) == (0, 0)


def test_a_folder_without_images_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="no images in"):
        ImageFolderSource(tmp_path)


def test_a_missing_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="no such folder"):
        ImageFolderSource(tmp_path / "gone")


@pytest.mark.parametrize("content", [b"", b"not an image"])
def test_a_file_that_is_no_image_is_refused_by_name(tmp_path: Path, content: bytes) -> None:
    save(tmp_path / "1.png")
    (tmp_path / "2.png").write_bytes(content)
    with pytest.raises(SourceError, match=r"2\.png as an image"):
        list(ImageFolderSource(tmp_path))


def test_a_one_pixel_image_is_refused(tmp_path: Path) -> None:
    source = ImageFolderSource(save(tmp_path / "dot.png", size_px=(1, 1)))
    with pytest.raises(FrameError, match="1x1 px"):
        next(iter(source))


def test_a_16_bit_image_is_brought_to_8_bits(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "deep.png"), np.full((40, 40, 3), 0x8040, np.uint16))
    image = read_image(tmp_path / "deep.png")
    assert image.dtype == np.uint8
    assert int(image[0, 0, 0]) == 0x80


def test_a_grey_image_becomes_bgr(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "grey.png"), np.full((40, 40), 7, np.uint8))
    assert read_image(tmp_path / "grey.png").shape == (40, 40, 3)


def test_a_floating_point_image_is_refused(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "float.tiff"), np.full((40, 40, 3), 0.5, np.float32))
    with pytest.raises(FrameError, match="float32 pixels"):
        read_image(tmp_path / "float.tiff")


@pytest.mark.parametrize("fps", [0.0, -5.0, float("nan")])
def test_an_impossible_rate_is_refused(tmp_path: Path, fps: float) -> None:
    save(tmp_path / "1.png")
    with pytest.raises(ConfigError, match="fps"):
        ImageFolderSource(tmp_path, fps=fps)
