from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError, FrameError, SourceError
from egotouch_sdk.sources import PushSource, WhenFull

IMAGE = np.zeros((40, 40, 3), np.uint8)


def test_the_newest_frame_wins_and_the_gap_shows() -> None:
    source = PushSource()
    for stamp_ns in (10, 20, 30):
        source.push(IMAGE, stamp_ns)
    source.close()
    assert [(frame.timestamp_ns, frame.index) for frame in source] == [(30, 2)]


def test_a_larger_queue_keeps_the_newest_frames_in_order() -> None:
    source = PushSource(capacity=2)
    for stamp_ns in (10, 20, 30):
        source.push(IMAGE, stamp_ns)
    source.close()
    assert [frame.timestamp_ns for frame in source] == [20, 30]


def test_blocking_loses_nothing() -> None:
    source = PushSource(capacity=2, when_full=WhenFull.BLOCK)

    def push_all() -> None:
        for stamp_ns in range(50):
            source.push(IMAGE, stamp_ns, timeout_s=10)
        source.close()

    with ThreadPoolExecutor() as pool:
        pushing = pool.submit(push_all)
        assert [frame.timestamp_ns for frame in source] == list(range(50))
        pushing.result()


def test_blocking_gives_up_when_nobody_takes_frames() -> None:
    source = PushSource(when_full=WhenFull.BLOCK)
    source.push(IMAGE, 1)
    with pytest.raises(SourceError, match=r"no frame was taken within 0\.01 s"):
        source.push(IMAGE, 2, timeout_s=0.01)


def test_frames_without_a_time_are_stamped_by_the_monotonic_clock() -> None:
    source = PushSource(capacity=2)
    first, second = source.push(IMAGE), source.push(IMAGE)
    assert 0 < first.timestamp_ns < second.timestamp_ns


@pytest.mark.parametrize("stamp_ns", [10, 9])
def test_a_time_that_does_not_rise_is_refused_and_nothing_is_queued(stamp_ns: int) -> None:
    source = PushSource(capacity=5)
    source.push(IMAGE, 10)
    with pytest.raises(FrameError, match="does not rise"):
        source.push(IMAGE, stamp_ns)
    source.close()
    assert len(list(source)) == 1


@pytest.mark.parametrize(
    "image",
    [np.zeros((40, 40, 3), np.float32), np.zeros((40, 40), np.uint8), np.zeros((1, 1, 3), np.uint8), None, "image"],
    ids=["float", "grey", "one_pixel", "none", "text"],
)
def test_a_bad_image_is_refused_at_the_push(image: object) -> None:
    with pytest.raises(FrameError):
        PushSource().push(image, 1)


def test_pushing_after_the_end_is_refused() -> None:
    source = PushSource()
    source.close()
    with pytest.raises(SourceError, match="closed"):
        source.push(IMAGE)


def test_a_queue_without_room_is_refused() -> None:
    with pytest.raises(ConfigError, match="capacity is 0"):
        PushSource(capacity=0)
