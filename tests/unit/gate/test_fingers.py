from __future__ import annotations

import pytest

from egotouch_sdk.config import GateConfig
from egotouch_sdk.gate import active_fingers
from egotouch_sdk.joints import FINGERS, Finger
from egotouch_sdk.observation import HandObservation
from tests.support.hands import FOUR, make_hand

CONFIG = GateConfig()


@pytest.mark.parametrize("tilt_deg", [0.0, 45.0, 80.0])
@pytest.mark.parametrize("extended", [(), (Finger.INDEX,), (Finger.THUMB,), (Finger.INDEX, Finger.MIDDLE), FOUR, FINGERS])
def test_stretched_fingers_are_active_and_curled_ones_are_not(extended: tuple[Finger, ...], tilt_deg: float) -> None:
    assert active_fingers(make_hand(extended=extended, tilt_deg=tilt_deg), CONFIG) == extended


@pytest.mark.parametrize("bends", [(5.0, 20.0, 10.0), (30.0, 40.0, 20.0), (60.0, 40.0, 10.0), (50.0, 50.0, 15.0)])
def test_a_finger_that_pokes_or_presses_is_active(bends: tuple[float, float, float]) -> None:
    assert Finger.INDEX in active_fingers(make_hand(extended=(), bends_deg={Finger.INDEX: bends}), CONFIG)


def test_a_half_curled_finger_stays_active_but_does_not_become_so() -> None:
    half = make_hand(extended=(), bends_deg={Finger.INDEX: (0.0, 85.0, 30.0)})
    assert active_fingers(half, CONFIG) == ()
    assert active_fingers(half, CONFIG, already=(Finger.INDEX,)) == (Finger.INDEX,)


def test_pixels_alone_are_enough() -> None:
    hand = make_hand(extended=(Finger.INDEX,))
    flat = HandObservation(1, hand.handedness, 1.0, hand.landmarks_px, hand.world_mm * 0)
    assert active_fingers(flat, CONFIG) == (Finger.INDEX,)
