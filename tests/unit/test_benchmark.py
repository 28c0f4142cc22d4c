from threading import Thread

import numpy as np
import pytest

from egotouch_sdk import benchmark
from egotouch_sdk.benchmark import NetworkTime, fit_720p, network_time
from egotouch_sdk.frame import Frame
from egotouch_sdk.touch import TouchModel
from tests.support.study import told_patch


@pytest.mark.parametrize("size_px", [(1280, 720), (640, 480), (480, 640), (1920, 1080)])
def test_any_clip_becomes_720p_with_its_picture_undistorted(size_px: tuple[int, int]) -> None:
    width, height = size_px
    image = np.full((height, width, 3), 50, np.uint8)
    image[height // 4 : 3 * height // 4, width // 4 : 3 * width // 4] = 200
    fitted = fit_720p(Frame(image, 5, 3))
    rows, columns = np.nonzero(fitted.image[:, :, 0] > 125)
    assert (fitted.width_px, fitted.height_px, fitted.timestamp_ns, fitted.index) == (1280, 720, 5, 3)
    assert np.ptp(columns) / np.ptp(rows) == pytest.approx(width / height, rel=0.02)


def test_calls_side_by_side_count_once(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter((100, 180, 200, 230))
    monkeypatch.setattr(benchmark, "now_ns", lambda: next(times))
    spent = NetworkTime()
    spent.begin()
    spent.begin()
    spent.end()
    spent.end()
    assert spent.total_ns == 80
    spent.begin()
    spent.end()
    assert spent.total_ns == 110


def test_network_calls_are_timed_from_every_thread_and_only_inside_the_block() -> None:
    model = TouchModel()
    with network_time() as spent:
        thread = Thread(target=lambda: model.estimate([told_patch(0.0)]))
        thread.start()
        thread.join()
        inside = spent.total_ns
    model.estimate([told_patch(0.0)])
    assert spent.total_ns == inside > 0
