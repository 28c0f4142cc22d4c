from __future__ import annotations

import numpy as np
import pytest

from egotouch_sdk import hand_geometry
from egotouch_sdk.joints import Handedness
from egotouch_sdk.observation import HandObservation
from tests.support.hands import make_hand


@pytest.mark.parametrize("tilt_deg", [0, 30, 60, 80])
def test_the_palm_keeps_most_of_its_length_when_foreshortened(tilt_deg: float) -> None:
    flat = hand_geometry.palm_length_px(make_hand())
    assert flat == pytest.approx(166, rel=0.01)
    assert hand_geometry.palm_length_px(make_hand(tilt_deg=tilt_deg)) > 0.65 * flat


def test_a_palm_is_never_shorter_than_a_pixel() -> None:
    point = HandObservation(1, Handedness.LEFT, 1.0, np.zeros((21, 3)), np.zeros((21, 3)))
    assert hand_geometry.palm_length_px(point) == 1.0


@pytest.mark.parametrize("tilt_deg", [0, 45, 80])
def test_the_scale_of_a_hand(tilt_deg: float) -> None:
    assert hand_geometry.px_per_mm(make_hand(tilt_deg=tilt_deg, px_per_mm=3.2)) == pytest.approx(3.2, rel=0.02)


def test_a_hand_on_one_spot_still_has_a_scale() -> None:
    assert hand_geometry.px_per_mm(HandObservation(1, Handedness.LEFT, 1.0, np.zeros((21, 3)), np.zeros((21, 3)))) > 0


@pytest.mark.parametrize("tilt_deg", [0, 60])
def test_a_host_seen_from_above_has_an_axis_and_one_on_edge_has_none(tilt_deg: float) -> None:
    assert hand_geometry.has_axis(make_hand(tilt_deg=tilt_deg))
    assert not hand_geometry.has_axis(make_hand(tilt_deg=89))
