"""Simulated scenes refuse what cannot be."""

from __future__ import annotations

from math import nan, pi
from typing import Any

import pytest

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import Finger
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, SimulatedView
from egotouch_sdk.surface import Surface, surface_at

PLACE: dict[str, Any] = {"surface": Surface.PALM, "x_mm": 0.0, "y_mm": 40.0}


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"x_mm": nan}, "x_mm=nan"),
        ({"hover_mm": -1.0}, "hover_mm=-1.0"),
        ({"pitch_rad": 1.6}, "pitch_rad=1.6"),
        ({"yaw_rad": -3.2}, "yaw_rad=-3.2"),
        ({"force_n": 3.6}, "force_n=3.6"),
        ({"force_n": 1.0, "hover_mm": 2.0}, "presses with 1.0 N at 2.0 mm"),
        ({"y_mm": -1.0}, "y_mm=-1.0 is not on the palm"),
        ({"surface": Surface.OUTER_FOREARM}, "is not on the outer_forearm"),
    ],
)
def test_a_finger_that_cannot_be_is_refused(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(FrameError, match=message):
        SimulatedFinger(**(PLACE | fields))


def test_a_finger_is_there_only_once() -> None:
    finger = SimulatedFinger(**PLACE)
    with pytest.raises(FrameError, match="twice"):
        SimulatedScene((finger, finger))


def test_a_hand_cannot_touch_both_sides() -> None:
    with pytest.raises(FrameError, match="both sides"):
        SimulatedScene((SimulatedFinger(**PLACE), SimulatedFinger(Surface.BACK_OF_HAND, 0.0, 40.0, finger=Finger.MIDDLE)))


@pytest.mark.parametrize("fields", [{"px_per_mm": 0.0}, {"tilt_rad": pi / 2}, {"turn_rad": nan}])
def test_a_camera_that_sees_nothing_is_refused(fields: dict[str, float]) -> None:
    with pytest.raises(FrameError):
        SimulatedView(**fields)


@pytest.mark.parametrize("palm_side", [True, False])
def test_the_wrist_parts_hand_and_forearm(palm_side: bool) -> None:
    assert surface_at(0.0, palm_side=palm_side) in (Surface.PALM, Surface.BACK_OF_HAND)
    assert surface_at(-0.1, palm_side=palm_side) in (Surface.INNER_FOREARM, Surface.OUTER_FOREARM)
