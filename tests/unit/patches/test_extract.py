from __future__ import annotations

import numpy as np
import pytest

from egotouch_sdk.config import PatchesConfig
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import FINGERS, Finger, Handedness
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.patches import PatchRefusal, extract, refusal, tip_px_per_mm
from tests.support.hands import host_hand, make_hand, palm_centre, pointing_hand, with_tip_at


@pytest.fixture
def frame() -> Frame:
    image = np.random.default_rng(3).integers(0, 256, (720, 1280, 3)).astype(np.uint8)
    return Frame(image, 0, 0)


def pair(touching: HandObservation, host: HandObservation | None = None, fingers: tuple[Finger, ...] = (Finger.INDEX,)) -> TouchPair:
    return TouchPair(touching, host or host_hand(), 0.0, fingers)


def test_a_patch_says_where_it_comes_from(frame: Frame) -> None:
    (patch,) = extract(frame, pair(pointing_hand((600.0, 400.0))))
    assert (patch.hand_id, patch.handedness, patch.finger) == (1, Handedness.RIGHT, Finger.INDEX)
    assert patch.tip_px == pytest.approx((600, 400), abs=1e-3)
    assert patch.px_per_mm == pytest.approx(2.0, rel=0.05)


def test_patches_follow_the_order_of_the_fingers(frame: Frame) -> None:
    fingers = (Finger.RING, Finger.THUMB, Finger.INDEX)
    patches = extract(frame, pair(make_hand(wrist_px=(600, 600)), fingers=fingers))
    assert tuple(patch.finger for patch in patches) == fingers


def test_a_tip_outside_the_frame_is_left_out(frame: Frame) -> None:
    hand = pointing_hand((1290.0, 400.0))
    assert refusal(frame, hand, Finger.INDEX) is PatchRefusal.OUTSIDE_FRAME
    assert extract(frame, pair(hand)) == ()


def test_a_tip_on_the_last_pixel_is_cut(frame: Frame) -> None:
    assert len(extract(frame, pair(pointing_hand((1279.0, 719.0))))) == 1


def test_a_finger_that_points_at_the_camera_is_left_out(frame: Frame) -> None:
    hand = make_hand(wrist_px=(600, 400), tilt_deg=85.0, bends_deg={Finger.INDEX: (5.0, 0.0, 0.0)})
    assert refusal(frame, hand, Finger.INDEX) is PatchRefusal.NO_DIRECTION
    assert extract(frame, pair(hand)) == ()


def test_a_hand_too_far_away_is_left_out(frame: Frame) -> None:
    hand = pointing_hand((600.0, 400.0), px_per_mm=0.3)
    assert refusal(frame, hand, Finger.INDEX) is PatchRefusal.TOO_SMALL
    assert refusal(frame, hand, Finger.INDEX, PatchesConfig(min_px_per_mm=0.2)) is None


@pytest.mark.parametrize("finger", FINGERS)
@pytest.mark.parametrize("tilt_deg", [0.0, 40.0, 60.0])
def test_the_scale_does_not_depend_on_foreshortening(finger: Finger, tilt_deg: float) -> None:
    assert tip_px_per_mm(make_hand(tilt_deg=tilt_deg, px_per_mm=3.0), finger) == pytest.approx(3.0, rel=0.05)


def test_a_wrong_fingertip_cannot_pull_the_scale_far_from_the_hands() -> None:
    hand = make_hand(px_per_mm=2.0)
    stretched = hand.landmarks_px.copy()
    stretched[Finger.INDEX.tip, 1] -= 200
    scale = tip_px_per_mm(HandObservation(1, hand.handedness, 1.0, stretched, hand.world_mm), Finger.INDEX)
    assert scale == pytest.approx(2.0 * 1.12, rel=0.03)


def test_the_scale_does_not_depend_on_the_metric_landmarks() -> None:
    hand = make_hand(px_per_mm=2.0)
    flat = HandObservation(1, hand.handedness, 1.0, hand.landmarks_px, np.zeros((21, 3)))
    assert tip_px_per_mm(flat, Finger.INDEX) == pytest.approx(2.0, rel=0.05)


def test_an_edge_on_host_is_unknown(frame: Frame) -> None:
    host = host_hand(tilt_deg=88.0)
    (patch,) = extract(frame, pair(pointing_hand(palm_centre(host)), host))
    assert (patch.r_palms, patch.theta_rad) == (0.0, 0.0)


def mirror_hand(hand: HandObservation, width_px: int) -> HandObservation:
    """The same hand in the mirrored picture, where it looks like the other side's."""
    flip = np.array([-1, 1, 1])
    pixels = hand.landmarks_px * flip + [width_px - 1, 0, 0]
    return HandObservation(hand.hand_id, hand.handedness.other, hand.score, pixels, hand.world_mm * flip)


def test_a_left_hand_gives_the_patch_of_the_right_hand_in_the_mirror(frame: Frame) -> None:
    right = pair(pointing_hand((600.0, 400.0)))
    left = pair(mirror_hand(right.touching, 1280), mirror_hand(right.host, 1280))
    mirror_frame = Frame(np.ascontiguousarray(frame.image[:, ::-1]), 0, 0)
    (a,), (b,) = extract(frame, right), extract(mirror_frame, left)
    assert np.abs(a.image.astype(int) - b.image).max() <= 2
    assert (a.r_palms, a.theta_rad) == pytest.approx((b.r_palms, b.theta_rad), abs=1e-5)


def test_a_selfie_of_a_right_hand_is_cut_like_a_left_hand(frame: Frame) -> None:
    hand = with_tip_at(make_hand(Handedness.RIGHT), Finger.INDEX, (600, 400))
    looks_left = HandObservation(1, Handedness.LEFT, 1.0, hand.landmarks_px, hand.world_mm)
    (selfie,) = extract(frame, pair(hand), mirrored=True)
    (plain,) = extract(frame, pair(looks_left))
    np.testing.assert_array_equal(selfie.image, plain.image)
    assert selfie.theta_rad == plain.theta_rad
