import math

import pytest

from egotouch_sdk.config import HostConfig
from egotouch_sdk.filters import HostPointFilter
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.surface import Surface

FRAME_NS = 33_333_333


def point(x_mm: float = 0.0, yaw_rad: float = 0.0, surface: Surface = Surface.PALM, pitch_rad: float = 0.5) -> HostPoint:
    return HostPoint(surface, x_mm, 50.0, pitch_rad, yaw_rad)


def test_a_first_point_passes_unchanged() -> None:
    got = HostPointFilter().apply(1, Finger.INDEX, point(3.0, 1.0), 0)
    assert (got.x_mm, got.y_mm, got.pitch_rad, got.yaw_rad) == pytest.approx((3.0, 50.0, 0.5, 1.0))


def test_jitter_at_rest_shrinks() -> None:
    smooth = HostPointFilter()
    ways = []
    for i in range(60):
        got = smooth.apply(1, Finger.INDEX, point(1.0 if i % 2 else -1.0), i * FRAME_NS)
        ways.append(abs(got.x_mm))
    assert max(ways[30:]) < 0.7


def test_fingers_and_hands_do_not_mix() -> None:
    smooth = HostPointFilter()
    smooth.apply(1, Finger.INDEX, point(0.0), 0)
    assert smooth.apply(1, Finger.MIDDLE, point(30.0), FRAME_NS).x_mm == 30.0
    assert smooth.apply(2, Finger.INDEX, point(20.0), FRAME_NS).x_mm == 20.0


def test_yaw_goes_the_short_way_round() -> None:
    smooth = HostPointFilter()
    smooth.apply(1, Finger.INDEX, point(yaw_rad=math.radians(175)), 0)
    for i in range(1, 30):
        got = smooth.apply(1, Finger.INDEX, point(yaw_rad=math.radians(-175)), i * FRAME_NS)
        assert abs(got.yaw_rad) >= math.radians(174.9)
    assert got.yaw_rad == pytest.approx(math.radians(-175), abs=0.01)


@pytest.mark.parametrize(
    ("after", "gap_frames"),
    [(point(9.0, surface=Surface.BACK_OF_HAND), 1), (point(39.0), 4), (point(41.0), 1)],
    ids=["another surface", "a gap", "a jump"],
)
def test_it_starts_afresh_after(after: HostPoint, gap_frames: int) -> None:
    smooth = HostPointFilter(HostConfig(gap_ms=100.0, jump_mm=40.0))
    smooth.apply(1, Finger.INDEX, point(0.0), 0)
    assert smooth.apply(1, Finger.INDEX, after, gap_frames * FRAME_NS).x_mm == after.x_mm


def test_a_short_gap_is_bridged() -> None:
    smooth = HostPointFilter()
    smooth.apply(1, Finger.INDEX, point(0.0), 0)
    assert 0.0 < smooth.apply(1, Finger.INDEX, point(2.0), 3 * FRAME_NS).x_mm < 2.0


def test_a_reset_filter_is_like_a_new_one() -> None:
    used = HostPointFilter()
    used.apply(1, Finger.INDEX, point(0.0), 5 * FRAME_NS)
    used.reset()
    assert used.apply(1, Finger.INDEX, point(7.0), 0).x_mm == 7.0
