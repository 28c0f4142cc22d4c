"""A motion JPEG stream on the loopback address stands for the camera: OpenCV reads it like any network camera."""

import itertools
from collections.abc import Iterator
from threading import Event, Thread

import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.sources import CameraSource
from egotouch_sdk.view.server import ViewServer


class StreamingCamera:
    """Sends grey pictures, a little brighter each time, until stopped."""

    def __init__(self) -> None:
        self.server = ViewServer()
        self.url = self.server.url + "stream.mjpg"
        self._stop = Event()
        self._thread = Thread(target=self._send)
        self._thread.start()

    def _send(self) -> None:
        level = 0
        while not self._stop.wait(0.01):
            self.server.show(np.full((120, 160, 3), level % 200, np.uint8))
            level += 1

    def unplug(self) -> None:
        self._stop.set()
        self._thread.join()
        self.server.close()

    def fall_silent(self) -> None:
        self._stop.set()
        self._thread.join()


@pytest.fixture
def streaming() -> Iterator[StreamingCamera]:
    camera = StreamingCamera()
    yield camera
    camera.unplug()


def test_frames_are_stamped_in_rising_monotonic_time(streaming: StreamingCamera) -> None:
    with CameraSource(streaming.url) as camera:
        frames = [frame for frame, _ in zip(camera, range(10), strict=False)]
        assert camera.is_live
    assert (frames[0].width_px, frames[0].height_px) == (160, 120)
    assert all(a.timestamp_ns < b.timestamp_ns and a.index < b.index for a, b in itertools.pairwise(frames))


def test_a_slow_consumer_gets_the_newest_frame(streaming: StreamingCamera) -> None:
    with CameraSource(streaming.url) as camera:
        frames = iter(camera)
        first = next(frames)
        Event().wait(0.5)
        assert next(frames).index > first.index + 1


def test_an_unplugged_camera_is_a_source_error(streaming: StreamingCamera) -> None:
    with CameraSource(streaming.url) as camera:
        frames = iter(camera)
        next(frames)
        streaming.unplug()
        with pytest.raises(SourceError, match="unplugged"):
            for _ in frames:
                pass


def test_a_silent_camera_is_a_source_error(streaming: StreamingCamera) -> None:
    with CameraSource(streaming.url, stall_timeout_s=3.0) as camera:
        frames = iter(camera)
        next(frames)
        streaming.fall_silent()
        with pytest.raises(SourceError, match=r"sent no frame for 3 s|unplugged"):
            for _ in frames:
                pass


@pytest.mark.parametrize("target", [97, "http://127.0.0.1:9/video"])
def test_a_missing_camera_is_a_source_error_without_noise(target: int | str, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SourceError, match="cannot open camera"):
        CameraSource(target)
    assert capfd.readouterr().err == ""
