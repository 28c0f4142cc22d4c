"""What a region is, and what is none."""

from __future__ import annotations

from math import nan, pi

import pytest

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import Region
from egotouch_sdk.skin.polygon import crosses_itself, signed_area
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType
from tests.support.events import make_event

L_SHAPE = ((0, 0), (30, 0), (30, 10), (10, 10), (10, 30), (0, 30))


def test_a_notch_is_outside() -> None:
    region = Region(Surface.PALM, L_SHAPE)
    assert region.contains(5, 25) and region.contains(25, 5)
    assert not region.contains(20, 20)


def test_the_outline_belongs_to_the_region_whichever_way_round_it_is_given() -> None:
    for points in (L_SHAPE, L_SHAPE[::-1]):
        region = Region(Surface.PALM, points)
        assert all(region.contains(x, y) for x, y in [*L_SHAPE, (15, 0), (0, 15), (10, 20), (30, 5)])


def test_slop_grows_it_evenly() -> None:
    region = Region.rectangle(Surface.PALM, 0, 20, 20, 20)
    assert region.contains(12.9, 20, slop_mm=3) and not region.contains(13.1, 20, slop_mm=3)
    assert region.contains(12, 32, slop_mm=3) and not region.contains(12.5, 32.5, slop_mm=3)


def test_helpers_make_what_they_say() -> None:
    assert Region.rectangle(Surface.PALM, 5, 40, 20, 10).bounds_mm == (-5, 35, 15, 45)
    assert Region.rectangle(Surface.PALM, 5, 40, 20, 10).centre_mm == (5, 40)
    circle = Region.circle(Surface.PALM, 0, 40, 10)
    assert circle.contains(0, 49.9) and circle.contains(7.0, 47.0) and not circle.contains(7.2, 47.2)
    assert signed_area(circle.points_mm) == pytest.approx(pi * 100, rel=0.01)
    rounded = Region.rounded(Surface.PALM, 0, 40, 20, 10, 4)
    assert rounded.bounds_mm == pytest.approx((-10, 35, 10, 45))
    assert not rounded.contains(9.8, 44.8) and rounded.contains(8, 44)
    assert signed_area(rounded.points_mm) == pytest.approx(200 - (4 - pi) * 16, rel=0.01)
    assert signed_area(Region.rounded(Surface.PALM, 0, 0, 10, 10, 5).points_mm) == pytest.approx(pi * 25, rel=0.01)


@pytest.mark.parametrize(
    ("points", "what"),
    [
        ((), "0 corners"),
        (((0, 0), (10, 0)), "2 corners"),
        (tuple((k, k * k) for k in range(257)), "257 corners"),
        (((0, 0), (10, 0), (20, 0)), "empty"),
        (((0, 0), (0.1, 0), (0, 0.1)), "empty"),
        (((0, 0), (10, 0), (nan, 10)), "on no limb"),
        (((0, 0), (10, 0), (1e200, 1e200)), "on no limb"),
        (((0, 0), (10, 10), (20, 0), (20, 30), (5, -5)), "crosses"),
        (((0, 0), (30, 0), (30, 20), (30, 10), (0, 20)), "crosses"),  # an edge that runs back on itself
        (((0, 0), (20, 0), (20, 20), (10, 0), (0, 20)), "crosses"),  # a corner on another edge
        (((0, 0), (20, 0), (20, 0), (20, 20)), "crosses"),  # a corner twice
    ],
)
def test_what_is_no_region_is_refused(points: tuple[tuple[float, float], ...], what: str) -> None:
    with pytest.raises(LayoutError, match=what) as caught:
        Region(Surface.PALM, points)
    assert caught.value.hint


def test_a_figure_of_eight_crosses_itself() -> None:
    assert crosses_itself([(0, 0), (10, 10), (10, 0), (0, 10)])
    assert not crosses_itself(L_SHAPE)


@pytest.mark.parametrize("lengths", [(0, 10), (10, -1), (nan, 10)])
def test_lengths_are_above_zero(lengths: tuple[float, float]) -> None:
    with pytest.raises(LayoutError, match="is no length"):
        Region.rectangle(Surface.PALM, 0, 0, *lengths)


def test_round_corners_fit() -> None:
    with pytest.raises(LayoutError, match="corner_mm=6"):
        Region.rounded(Surface.PALM, 0, 0, 20, 10, 6)


def test_an_event_hits_only_on_the_same_surface_and_hand() -> None:
    region = Region.rectangle(Surface.PALM, 0, 50, 20, 20, host=Handedness.LEFT)
    assert region.is_hit(make_event(EventType.DOWN, hand=Handedness.RIGHT))
    assert not region.is_hit(make_event(EventType.DOWN, hand=Handedness.LEFT))
    assert not region.is_hit(make_event(EventType.DOWN, surface=Surface.BACK_OF_HAND))
