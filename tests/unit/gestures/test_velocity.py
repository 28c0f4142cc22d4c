from __future__ import annotations

from math import hypot

import numpy as np
import pytest

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.gestures.velocity import VelocityTracker

FPS = [15, 30, 60, 90]


def tracked(fps: float, places_mm: list[tuple[float, float]]) -> VelocityTracker:
    tracker = VelocityTracker(GestureConfig())
    for index, (x_mm, y_mm) in enumerate(places_mm):
        tracker.add(round(index * 1e9 / fps), x_mm, y_mm)
    return tracker


@pytest.mark.parametrize("fps", [8, *FPS])
def test_a_steady_finger_has_its_speed_after_two_frames(fps: float) -> None:
    places = [(120.0 * i / fps, -40.0 * i / fps) for i in range(12)]
    assert tracked(fps, places[:1]).velocity_mm_s() == (0.0, 0.0)
    for count in range(2, 13):
        assert tracked(fps, places[:count]).velocity_mm_s() == pytest.approx((120.0, -40.0))


def test_it_is_the_line_of_least_squares_over_the_last_100_ms() -> None:
    rng = np.random.default_rng(0)
    places = rng.normal(0, 2, (40, 2))
    times_s = np.arange(40) / 60
    recent = times_s >= times_s[-1] - 0.1 - 1e-6
    expected = np.polyfit(times_s[recent], places[recent], 1)[0]
    assert tracked(60, [(float(x), float(y)) for x, y in places]).velocity_mm_s() == pytest.approx(expected)


@pytest.mark.parametrize("fps", FPS)
def test_noise_of_half_a_millimetre_is_no_fling(fps: float) -> None:
    """A resting fingertip whose landmark trembles stays below the fling speed, nearly always."""
    rng = np.random.default_rng(1)
    flung = 0
    for _ in range(500):
        tracker = tracked(fps, [(float(x), float(y)) for x, y in rng.normal(0, 0.5, (20, 2))])
        flung += hypot(*tracker.velocity_mm_s()) >= 50 <= tracker.latest_speed_mm_s()
    assert flung <= 5


@pytest.mark.parametrize("fps", FPS)
def test_a_finger_at_rest_has_no_speed_of_late(fps: float) -> None:
    places = [(10.0 * i, 0.0) for i in range(10)]
    resting = [places[-1]] * max(2, round(0.045 * fps) + 1)
    assert tracked(fps, places).latest_speed_mm_s() == pytest.approx(10 * fps)
    assert tracked(fps, places + resting).latest_speed_mm_s() == pytest.approx(0.0)


@pytest.mark.parametrize("fps", FPS)
def test_nothing_is_known_after_a_gap_of_more_than_two_frames(fps: float) -> None:
    tracker = tracked(fps, [(10.0 * i, 0.0) for i in range(10)])
    last_ns, frame_ns = round(9 * 1e9 / fps), 1e9 / fps
    limit_ns = round(max(2 * frame_ns, 40e6))
    assert not tracker.has_gap(last_ns + limit_ns - 1000)
    assert tracker.has_gap(last_ns + limit_ns + 1000)
    tracker.add(last_ns + limit_ns + 1000, 500.0, 0.0)
    assert tracker.velocity_mm_s() == (0.0, 0.0)
