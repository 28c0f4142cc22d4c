"""Turning, shifting, scaling or mirroring picture and landmarks together leaves the network's input as it was."""

from __future__ import annotations

from math import cos, pi, sin

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.patches import extract, polar
from tests.support.hands import host_hand, palm_centre, pointing_hand

ANGLES = st.floats(-pi, pi)
POINTS = st.tuples(st.floats(-500, 500), st.floats(-500, 500))
#: Mean absolute difference of two patches, in grey levels of 255, that resampling alone may cause.
RESAMPLING_LEVELS = 2.5


def scene() -> tuple[np.ndarray, TouchPair]:
    """A smooth random picture and a finger over a palm in it."""
    noise = np.random.default_rng(0).integers(0, 256, (90, 120, 3)).astype(np.uint8)
    image = cv2.resize(noise, (960, 720), interpolation=cv2.INTER_CUBIC)
    host = host_hand(wrist_px=(480.0, 460.0))
    return image, TouchPair(pointing_hand(palm_centre(host)), host, 0.0, (Finger.INDEX,))


def transformed(hand: HandObservation, matrix: np.ndarray) -> HandObservation:
    """The hand in a picture that was warped by a similarity (2, 3)."""
    scale = np.sqrt(abs(np.linalg.det(matrix[:, :2])))
    pixels = hand.landmarks_px.astype(float)
    pixels[:, :2] = pixels[:, :2] @ matrix[:, :2].T + matrix[:, 2]
    pixels[:, 2] *= scale
    world = hand.world_mm.astype(float)
    world[:, :2] = world[:, :2] @ (matrix[:, :2] / scale).T
    side = hand.handedness.other if np.linalg.det(matrix[:, :2]) < 0 else hand.handedness
    return HandObservation(hand.hand_id, side, hand.score, pixels, world)


@given(angle=ANGLES, scale=st.floats(0.7, 1.8), shift=st.tuples(st.floats(-60, 60), st.floats(-60, 60)), mirror=st.booleans())
@settings(max_examples=60, deadline=None)
def test_a_similarity_leaves_the_patch_as_it_was(angle: float, scale: float, shift: tuple[float, float], mirror: bool) -> None:
    image, pair = scene()
    tip = pair.touching.xy_px(Finger.INDEX.tip).astype(float)
    linear = scale * np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]]) @ np.diag([-1.0 if mirror else 1.0, 1.0])
    matrix = np.column_stack([linear, np.array([700.0, 700.0]) + shift - linear @ tip])
    warped = cv2.warpAffine(image, matrix, (1400, 1400), flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    moved = TouchPair(transformed(pair.touching, matrix), transformed(pair.host, matrix), 0.0, pair.active_fingers)
    (before,), (after,) = extract(Frame(image, 0, 0), pair), extract(Frame(warped, 0, 0), moved)
    assert after.px_per_mm == pytest.approx(scale * before.px_per_mm, rel=1e-3)
    assert np.abs(after.image.astype(int) - before.image).mean() < RESAMPLING_LEVELS
    assert after.r_palms == pytest.approx(before.r_palms, abs=1e-4)
    assert after.theta_rad == pytest.approx(before.theta_rad, abs=1e-4)


@given(POINTS, POINTS, POINTS, ANGLES, st.floats(0.2, 5), POINTS, st.booleans())
@settings(max_examples=200, deadline=None)
def test_r_and_theta_do_not_depend_on_the_camera(
    wrist: tuple[float, float],
    knuckle: tuple[float, float],
    tip: tuple[float, float],
    angle: float,
    scale: float,
    shift: tuple[float, float],
    mirror: bool,
) -> None:
    axis, reach = np.subtract(knuckle, wrist), np.subtract(tip, wrist)
    if np.hypot(*axis) < 10 or np.hypot(*reach) < 1:
        return
    linear = scale * np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]]) @ np.diag([-1.0 if mirror else 1.0, 1.0])
    r, theta = polar(wrist, knuckle, tip, False)
    moved_r, moved_theta = polar(*(linear @ np.asarray(point) + shift for point in (wrist, knuckle, tip)), mirror)
    assert moved_r == pytest.approx(r, rel=1e-6)
    assert abs((moved_theta - theta + pi) % (2 * pi) - pi) < 1e-6
    assert -pi < theta <= pi
