"""Regions of interest: MediaPipe's rules, and that crop and image coordinates are each other's inverse."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.errors import FrameError
from egotouch_sdk.hands.roi import Roi, crop_matrix, landmarks_to_image, roi_from_landmarks, roi_from_palm, world_to_image_axes

ROIS = st.builds(
    Roi, st.floats(-2000, 4000), st.floats(-2000, 4000), st.floats(10, 3000), st.floats(-math.pi, math.pi, exclude_max=True)
)


def upright_palm():
    keypoints = np.zeros((7, 2))
    keypoints[0], keypoints[2] = (100, 200), (100, 120)  # wrist below middle MCP
    return np.array([60.0, 120.0, 140.0, 220.0]), keypoints


def test_palm_region_moves_up_by_half_the_box_and_grows():
    roi = roi_from_palm(*upright_palm())
    assert (roi.x_px, roi.y_px, roi.size_px, roi.rotation_rad) == pytest.approx((100, 170 - 50, 260, 0))


def test_palm_region_follows_a_quarter_turn():
    box, keypoints = upright_palm()
    keypoints[2] = (180, 200)  # fingers point right
    roi = roi_from_palm(box, keypoints)
    assert roi.rotation_rad == pytest.approx(math.pi / 2)
    assert (roi.x_px, roi.y_px) == pytest.approx((150, 170))


def hand_landmarks():
    rng = np.random.default_rng(4)
    points = rng.uniform(-40, 40, (21, 3))
    points[0, :2], points[[5, 9, 13], :2] = (0, 90), (0, -10)
    return points


@given(st.floats(-3.1, 3.1), st.floats(0.2, 5), st.floats(-500, 500), st.floats(-500, 500))
def test_landmark_region_turns_scales_and_moves_with_the_hand(angle, scale, dx, dy):
    still = roi_from_landmarks(hand_landmarks())
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s], [s, c]]) * scale
    moved = roi_from_landmarks(np.column_stack([hand_landmarks()[:, :2] @ turn.T + (dx, dy), np.zeros(21)]))
    assert (moved.x_px, moved.y_px) == pytest.approx(turn @ (still.x_px, still.y_px) + (dx, dy), abs=1e-6)
    assert moved.size_px == pytest.approx(still.size_px * scale)
    difference = moved.rotation_rad - still.rotation_rad - angle
    assert math.remainder(difference, 2 * math.pi) == pytest.approx(0, abs=1e-9)
    assert -math.pi <= moved.rotation_rad < math.pi


@given(ROIS, st.floats(0, 224), st.floats(0, 224), st.floats(-100, 100))
def test_landmarks_invert_the_crop(roi, x, y, z):
    image = landmarks_to_image(np.array([[x, y, z]] * 21), roi, 224).astype(np.float64)
    back = crop_matrix(roi, 224) @ (image[0, 0], image[0, 1], 1)
    tolerance = 2e-3 * 224 / roi.size_px + 1e-3  # landmarks are float32 image pixels
    assert back == pytest.approx((x, y), abs=tolerance)
    assert image[0, 2] == pytest.approx(z / 224 / 0.4 * roi.size_px, rel=1e-5, abs=1e-4)


def test_world_turns_about_the_viewing_axis_only():
    world = world_to_image_axes(np.array([[10.0, 0, 5]] * 21), Roi(0, 0, 100, math.pi / 2))
    assert world[0] == pytest.approx([0, 10, 5], abs=1e-5)


@pytest.mark.parametrize("values", [(0, 0, 0, 0), (0, 0, -1, 0), (math.nan, 0, 1, 0), (0, 0, math.inf, 0)])
def test_unusable_regions_are_refused(values):
    with pytest.raises(FrameError, match="region of interest"):
        Roi(*values)


def test_landmarks_in_one_point_make_no_region():
    with pytest.raises(FrameError):
        roi_from_landmarks(np.full((21, 3), 5.0))
