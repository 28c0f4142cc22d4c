"""A headset's own joints."""

import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.hands.pushed import JointAxes, PushedHands, hand_from_joints
from egotouch_sdk.joints import WEBXR_INDEX, Handedness

RNG = np.random.default_rng(0)
METRES = RNG.uniform(-0.05, 0.05, (25, 3)) + np.array([0.1, -0.2, 0.5])
PIXELS = METRES[:, :2] * 1500 + np.array([320, 240])
IMAGE = np.zeros((48, 64, 3), np.uint8)
MS = 1_000_000


def hand(side=Handedness.RIGHT):
    return hand_from_joints(side, PIXELS, METRES)


def test_webxr_order_equals_mediapipe_order():
    index = list(WEBXR_INDEX)
    a, b = hand(), hand_from_joints(Handedness.RIGHT, PIXELS[index], METRES[index])
    assert np.array_equal(a.landmarks_px, b.landmarks_px)
    assert np.array_equal(a.world_mm, b.world_mm)


def test_metric_joints_are_centred_millimetres():
    assert hand().world_mm.mean(0) == pytest.approx(0, abs=1e-3)
    assert np.ptp(hand().world_mm[:, 0]) == pytest.approx(np.ptp(METRES[list(WEBXR_INDEX), 0]) * 1000, rel=1e-5)


def test_depth_follows_from_metres_in_the_scale_of_x_and_y():
    z = hand().landmarks_px[:, 2]
    assert z[0] == 0
    expected = (METRES[list(WEBXR_INDEX), 2] - METRES[0, 2]) * 1500
    assert z == pytest.approx(expected, rel=1e-4, abs=1e-3)


def test_given_depth_is_kept():
    given = np.column_stack([PIXELS, np.arange(25.0)])
    assert hand_from_joints(Handedness.LEFT, given, METRES).landmarks_px[:, 2] == pytest.approx(list(WEBXR_INDEX))


def test_webxr_axes_point_up_and_towards_the_viewer():
    flipped = hand_from_joints(Handedness.RIGHT, PIXELS, METRES * (1, -1, -1), axes=JointAxes.WEBXR)
    assert np.allclose(flipped.world_mm, hand().world_mm, atol=1e-3)
    assert np.allclose(flipped.landmarks_px, hand().landmarks_px, atol=1e-2)


@pytest.mark.parametrize(
    ("pixels", "metres", "message"),
    [
        (PIXELS[:20], METRES, "joints_px has shape"),
        (PIXELS, METRES[:, :2], "joints_m has shape"),
        (PIXELS, np.where(np.arange(75).reshape(25, 3) == 7, np.nan, METRES), "not finite"),
        (PIXELS, "hand", "not a table"),
        (PIXELS * 0, METRES, "one point"),
        (PIXELS, METRES * 0, "one point"),
    ],
)
def test_wrong_joints_are_refused(pixels, metres, message):
    with pytest.raises(FrameError, match=message):
        hand_from_joints(Handedness.RIGHT, pixels, metres)


def test_a_frame_takes_the_hands_nearest_in_time():
    source = PushedHands(max_gap_ms=10)
    assert isinstance(source, HandSource)
    source.push(0, [hand(Handedness.LEFT)])
    source.push(30 * MS, [hand(Handedness.RIGHT), hand(Handedness.LEFT)])
    assert [h.handedness for h in source.track(Frame(IMAGE, 4 * MS, 0))] == ["left"]
    assert source.track(Frame(IMAGE, 16 * MS, 1)) == ()
    assert [h.handedness for h in source.track(Frame(IMAGE, 28 * MS, 2))] == ["left", "right"]
    assert source.track(Frame(IMAGE, 50 * MS, 3)) == ()


def test_time_must_rise_until_reset():
    source = PushedHands()
    source.push(5, [])
    source.track(Frame(IMAGE, 5, 0))
    with pytest.raises(FrameError, match="not after"):
        source.push(5, [])
    with pytest.raises(FrameError, match="not after"):
        source.track(Frame(IMAGE, 5, 1))
    source.reset()
    source.push(1, [hand()])
    assert len(source.track(Frame(IMAGE, 1, 0))) == 1


def test_two_hands_of_one_side_are_refused():
    with pytest.raises(FrameError, match="same side"):
        PushedHands().push(0, [hand(), hand()])


def test_wrong_settings_are_refused():
    with pytest.raises(ConfigError):
        PushedHands(max_gap_ms=-1)
