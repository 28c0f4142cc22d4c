import itertools
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import FrameError, SourceError
from egotouch_sdk.sources import SourceWarning, VideoFileSource


def test_frames_come_in_order_with_presentation_times_from_zero(write_video) -> None:
    with VideoFileSource(write_video(frames=20, fps=25.0)) as source:
        frames = list(source)
    assert [frame.index for frame in frames] == list(range(20))
    assert [frame.timestamp_ns for frame in frames] == [40_000_000 * index for index in range(20)]
    brightness = [frame.image.mean() for frame in frames]
    assert brightness == sorted(set(brightness))


def test_announces_what_the_header_says(write_video) -> None:
    with VideoFileSource(write_video(frames=7, fps=12.5, size_px=(96, 64))) as source:
        assert (source.width_px, source.height_px, source.fps, source.frame_count, source.is_live) == (96, 64, 12.5, 7, False)


def test_a_second_iteration_starts_at_the_first_frame_again(write_video) -> None:
    with VideoFileSource(write_video(frames=5)) as source:
        first = [frame.timestamp_ns for frame in source]
        assert [frame.timestamp_ns for frame in source] == first


def test_a_given_rate_replaces_the_files_own_times(write_video) -> None:
    with VideoFileSource(write_video(frames=4, fps=30.0), fps=10.0) as source:
        assert [frame.timestamp_ns for frame in source] == [0, 100_000_000, 200_000_000, 300_000_000]


@pytest.mark.parametrize("content", [b"", b"this is a text, not a video\n" * 50, b"\x00\x00\x00\x18ftypmp42" + b"\x00" * 64])
def test_a_file_that_is_no_video_is_refused_by_name(tmp_path: Path, content: bytes, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "notes.mp4"
    path.write_bytes(content)
    with pytest.raises(SourceError, match=r"notes\.mp4 as a video"):
        VideoFileSource(path)
    assert capfd.readouterr().err == ""


def test_a_missing_file_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"no such video file: .*gone\.mp4"):
        VideoFileSource(tmp_path / "gone.mp4")


def test_an_mp4_cut_off_before_its_index_is_refused(write_video) -> None:
    path = write_video(frames=30)
    path.write_bytes(path.read_bytes()[:-800])
    with pytest.raises(SourceError, match="cut off before its index"):
        VideoFileSource(path)


def test_a_truncated_stream_delivers_what_decodes_and_warns(write_video) -> None:
    path = write_video("clip.avi", frames=40, fourcc="MJPG")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with VideoFileSource(path) as source, pytest.warns(SourceWarning, match="of 40 frames decoded"):
        frames = list(source)
    assert 5 <= len(frames) <= 30
    assert [frame.index for frame in frames] == list(range(len(frames)))


def test_a_damaged_stretch_is_passed_over_and_times_still_rise(tmp_path: Path) -> None:
    path = tmp_path / "noise.mp4"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), 30.0, (160, 120))
    noise = np.random.default_rng(1)
    for _ in range(60):
        writer.write(noise.integers(0, 255, (120, 160, 3), np.uint8))
    writer.release()
    data = bytearray(path.read_bytes())
    third, half = len(data) // 3, len(data) // 2
    data[third:half] = bytes(half - third)
    path.write_bytes(data)
    with VideoFileSource(path) as source, pytest.warns(SourceWarning, match="damaged or cut off"):
        stamps = [frame.timestamp_ns for frame in source]
    assert 40 < len(stamps) < 60
    assert stamps[-1] > 1_800_000_000
    assert all(a < b for a, b in itertools.pairwise(stamps))


def test_a_video_too_small_to_work_on_is_refused(write_video) -> None:
    with VideoFileSource(write_video(size_px=(16, 16))) as source, pytest.raises(FrameError, match="16x16 px"):
        next(iter(source))


def test_closing_twice_is_fine(write_video) -> None:
    source = VideoFileSource(write_video())
    source.close()
    source.close()
