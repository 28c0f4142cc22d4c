from __future__ import annotations

import numpy as np
import pytest

from egotouch_sdk import hand_geometry
from egotouch_sdk.joints import HandJoint, Handedness
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


@pytest.mark.parametrize("handedness", list(Handedness))
@pytest.mark.parametrize("palm_up", [True, False])
@pytest.mark.parametrize("pointing_deg", [90, 0, -135])
def test_the_host_frame_has_x_to_the_thumb_and_y_to_the_fingers(handedness: Handedness, palm_up: bool, pointing_deg: float) -> None:
    host = make_hand(handedness, palm_up=palm_up, pointing_deg=pointing_deg)
    where = {joint: hand_geometry.host_frame_xy(host, tuple(host.xy_px(joint).tolist())) for joint in HandJoint}  # type: ignore[arg-type]
    assert where[HandJoint.WRIST] == pytest.approx((0, 0), abs=1e-5)
    assert where[HandJoint.MIDDLE_FINGER_MCP] == pytest.approx((0, 1), abs=1e-5)
    thumb, pinky = where[HandJoint.THUMB_TIP], where[HandJoint.PINKY_TIP]
    assert thumb is not None
    assert pinky is not None
    assert thumb[0] > 0.5
    assert pinky[0] < -0.3


def test_an_edge_on_host_has_no_frame() -> None:
    assert hand_geometry.host_frame_xy(make_hand(tilt_deg=89), (10.0, 10.0)) is None
