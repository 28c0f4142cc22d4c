"""Place and angles on hands of known geometry, as a tracker sees them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame import locate
from egotouch_sdk.joints import Finger, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair
from egotouch_sdk.surface import Surface
from tests.support.hands import host_hand, palm_centre, pointing_hand


def pair_at(tip_px: tuple[float, float], host: HandObservation | None = None) -> TouchPair:
    return TouchPair(pointing_hand(tip_px), host or host_hand(), 0.0, (Finger.INDEX,))


def place(pair: TouchPair, config: HostConfig | None = None, *, mirrored: bool = False) -> HostPoint:
    point = locate(pair, Finger.INDEX, config or HostConfig(), mirrored=mirrored)
    assert point is not None
    return point


def transformed(hand: HandObservation, turn_rad: float = 0.0, scale: float = 1.0, flip: bool = False) -> HandObservation:
    """The same hand in a picture that was turned, scaled and shifted, or in its mirror image."""
    landmarks = hand.landmarks_px.astype(np.float64) * scale
    c, s = math.cos(turn_rad), math.sin(turn_rad)
    landmarks[:, :2] = landmarks[:, :2] @ np.array([[c, s], [-s, c]]) + (70.0, -30.0)
    if flip:
        landmarks[:, 0] *= -1.0
    return HandObservation(hand.hand_id, hand.handedness, hand.score, landmarks, hand.world_mm)


def other_side(hand: HandObservation) -> HandObservation:
    return HandObservation(hand.hand_id, hand.handedness.other, hand.score, hand.landmarks_px, hand.world_mm)


def same(a: HostPoint, b: HostPoint) -> bool:
    numbers = [(p.x_mm, p.y_mm, p.pitch_rad, math.sin(p.yaw_rad), math.cos(p.yaw_rad)) for p in (a, b)]
    return a.surface is b.surface and numbers[0] == pytest.approx(numbers[1], abs=0.05)


def test_the_middle_of_the_palm() -> None:
    host = host_hand()
    point = place(pair_at(palm_centre(host), host))
    assert point.surface is Surface.PALM
    assert point.y_mm == pytest.approx(49.0, abs=12.0)
    assert point.x_mm == pytest.approx(-5.0, abs=12.0)


def test_the_back_of_the_hand() -> None:
    host = host_hand(palm_up=False)
    assert place(pair_at(palm_centre(host), host)).surface is Surface.BACK_OF_HAND


@pytest.mark.parametrize(("palm_up", "surface"), [(True, Surface.INNER_FOREARM), (False, Surface.OUTER_FOREARM)])
def test_behind_the_wrist_is_the_forearm(palm_up: bool, surface: Surface) -> None:
    host = host_hand(palm_up=palm_up)
    x, y = host.xy_px(HandJoint.WRIST).tolist()
    point = place(pair_at((x, y + 160.0), host))
    assert point.surface is surface
    assert point.y_mm == pytest.approx(-80.0, abs=20.0)
    assert abs(point.x_mm) < 20.0


@pytest.mark.parametrize("palm_up", [True, False])
def test_the_thumb_side_is_positive(palm_up: bool) -> None:
    host = host_hand(palm_up=palm_up)
    index, pinky = host.xy_px(HandJoint.INDEX_FINGER_MCP).tolist(), host.xy_px(HandJoint.PINKY_MCP).tolist()
    assert place(pair_at(index, host)).x_mm > 5.0 > -5.0 > place(pair_at(pinky, host)).x_mm


@pytest.mark.parametrize("turn_deg", [0, 37, 90, 181, 270])
@pytest.mark.parametrize("scale", [0.4, 1.0, 3.0])
def test_turning_and_scaling_the_picture_changes_nothing(turn_deg: float, scale: float) -> None:
    pair = pair_at((620.0, 400.0))
    moved = TouchPair(*(transformed(h, math.radians(turn_deg), scale) for h in (pair.touching, pair.host)), 0.0, pair.active_fingers)
    assert same(place(pair), place(moved))


def test_a_mirror_image_changes_nothing_when_it_is_known() -> None:
    pair = pair_at((620.0, 400.0))
    mirror = TouchPair(*(transformed(h, flip=True) for h in (pair.touching, pair.host)), 0.0, pair.active_fingers)
    assert same(place(pair), place(mirror, mirrored=True))


def test_left_and_right_hands_are_alike() -> None:
    pair = pair_at((620.0, 400.0))
    swapped = TouchPair(*(other_side(transformed(h, flip=True)) for h in (pair.touching, pair.host)), 0.0, pair.active_fingers)
    assert swapped.host.handedness is Handedness.RIGHT
    assert same(place(pair), place(swapped))


def test_the_wearers_own_palm_scales_the_place_alone() -> None:
    pair = pair_at((620.0, 400.0))
    usual, large = place(pair), place(pair, HostConfig(palm_mm=83.0 * 1.1))
    assert (large.x_mm, large.y_mm) == pytest.approx((usual.x_mm * 1.1, usual.y_mm * 1.1))
    assert (large.pitch_rad, large.yaw_rad) == (usual.pitch_rad, usual.yaw_rad)


def test_a_host_on_one_spot_has_no_place() -> None:
    spot = HandObservation(2, Handedness.LEFT, 1.0, np.zeros((21, 3)), np.zeros((21, 3)))
    assert locate(pair_at((620.0, 400.0), spot), Finger.INDEX) is None
