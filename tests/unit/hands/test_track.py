"""One hand from frame to frame: velocity, distrust and coasting."""

import numpy as np
import pytest

from egotouch_sdk.hands.association import hand_baseline_px, is_same_hand, is_same_palm
from egotouch_sdk.hands.landmarker import LocatedHand
from egotouch_sdk.hands.palm_detector import PalmDetection
from egotouch_sdk.hands.track import Track, frame_evidence
from tests.support.located import flat_hand

MS = 1_000_000
COAST_NS = 150 * MS


def located(x=0.0, y=0.0, right=0.98, presence=0.9):
    return LocatedHand(flat_hand(x, y), np.zeros((21, 3), np.float32), presence, right)


def moving_track(frames, step_px=10.0):
    """A hand seen `frames` times, 10 ms apart, moving right."""
    track = Track(0, located(), 4.0, 0)
    for k in range(1, frames):
        track = track.followed(located(step_px * k), 4.0, 10 * MS * k)
    return track


def test_velocity_is_that_of_the_palm():
    assert moving_track(5).velocity_px_per_s == pytest.approx((1000, 0), rel=1e-4)


def test_a_covered_hand_moves_on_and_fades():
    track = moving_track(5)
    cover = [flat_hand(60, 0)]
    scores = []
    for k in range(1, 5):
        carried = track.coasted(track.seen_ns + 30 * MS * k, COAST_NS, cover)
        assert carried.coasting
        assert carried.landmarks_px[0, 0] - track.landmarks_px[0, 0] == pytest.approx(30 * k, rel=1e-3)
        scores.append(carried.score(track.seen_ns + 30 * MS * k, COAST_NS))
    assert 0.5 > scores[0] > scores[1] > scores[2] > scores[3] > 0


def test_a_carried_hand_ends_after_its_time():
    track = moving_track(5)
    assert track.coasted(track.seen_ns + COAST_NS, COAST_NS, [flat_hand(160, 0)]) is not None
    assert track.coasted(track.seen_ns + COAST_NS + 1, COAST_NS, [flat_hand(160, 0)]) is None


def test_no_phantom_of_a_hand_that_nothing_covers():
    track = moving_track(5)
    assert track.coasted(track.seen_ns + MS, COAST_NS, []) is None
    assert track.coasted(track.seen_ns + MS, COAST_NS, [flat_hand(2000, 0)]) is None


def test_no_phantom_of_a_hand_seen_twice_only():
    assert moving_track(2).coasted(11 * MS, COAST_NS, [flat_hand(10, 0)]) is None


def test_seeing_the_hand_again_ends_the_coasting():
    track = moving_track(5)
    carried = track.coasted(track.seen_ns + 30 * MS, COAST_NS, [flat_hand(60, 0)])
    again = carried.followed(located(75), 4.0, track.seen_ns + 35 * MS)
    assert not again.coasting
    assert again.landmarks_px[0, 0] == located(75).landmarks_px[0, 0]
    assert again.score(track.seen_ns + 35 * MS, COAST_NS) == pytest.approx(0.9)


def test_a_jump_or_another_side_is_distrusted():
    track = moving_track(1)
    still, jump, other_side = (track.distrust(*pair) for pair in ((located(), 4.0), (located(100), 4.0), (located(), -4.0)))
    assert still == 0
    assert jump == pytest.approx(100 / hand_baseline_px(flat_hand()), rel=1e-4)
    assert other_side == pytest.approx(4.0)


def test_a_mirrored_image_swaps_the_evidence():
    assert frame_evidence(located(right=0.9), mirrored=False) == pytest.approx(-frame_evidence(located(right=0.9), mirrored=True))


def test_same_hand_needs_ten_near_landmarks():
    hand = flat_hand()
    apart = hand + np.array([0.3 * hand_baseline_px(hand), 0, 0], np.float32)
    assert is_same_hand(hand, hand + 0.1 * hand_baseline_px(hand))
    assert is_same_hand(hand, np.where(np.arange(21)[:, None] < 11, apart, hand))
    assert not is_same_hand(hand, np.where(np.arange(21)[:, None] < 12, apart, hand))


def test_palms_are_compared_by_keypoints_not_by_boxes():
    keypoints = flat_hand()[[0, 5, 9, 13, 17, 1, 2], :2]
    palm = PalmDetection(np.array([-50.0, -50, 50, 50]), keypoints, 0.9)
    assert is_same_palm(palm, keypoints + 20)
    turned = -keypoints + keypoints.mean(0) * 2  # the same place, pointing the other way
    assert not is_same_palm(palm, turned + 30)
