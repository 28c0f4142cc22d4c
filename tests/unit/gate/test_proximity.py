from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from egotouch_sdk.config import GateConfig
from egotouch_sdk.gate import find_pairs
from egotouch_sdk.joints import FINGERS, Finger, HandJoint, Handedness
from egotouch_sdk.observation import GateReason, GateResult, HandObservation
from tests.support.hands import host_hand, make_hand, palm_centre, pointing_hand, with_tip_at

CONFIG = GateConfig()
PALM_PX = 166.0


def roles(result: GateResult) -> tuple[int, int]:
    """Hand ids of the touching hand and the host."""
    (pair,) = result.pairs
    return pair.touching.hand_id, pair.host.hand_id


def beside(host: HandObservation, palms: float) -> tuple[float, float]:
    """A point to the right of the host's outline, level with the middle of its palm."""
    return float(host.landmarks_px[:, 0].max()) + palms * PALM_PX, palm_centre(host)[1]


def test_no_hands() -> None:
    assert find_pairs([], CONFIG) == GateResult(GateReason.NO_HANDS)


def test_one_hand_has_no_host() -> None:
    assert find_pairs([pointing_hand((600, 400))], CONFIG) == GateResult(GateReason.NO_HOST)


@pytest.mark.parametrize("order", [1, -1])
def test_an_index_finger_over_the_palm_opens_the_gate(order: int) -> None:
    host = host_hand()
    result = find_pairs([pointing_hand(palm_centre(host)), host][::order], CONFIG)
    assert result.reason is GateReason.OPEN
    assert roles(result) == (1, 2)
    assert result.pairs[0].active_fingers == (Finger.INDEX,)
    assert result.pairs[0].distance_palms < 0.5


def test_the_left_hand_can_touch_the_right() -> None:
    host = make_hand(Handedness.RIGHT, hand_id=1, palm_up=True, wrist_px=(600.0, 500.0))
    touching = make_hand(Handedness.LEFT, hand_id=2, extended=(Finger.INDEX,), pointing_deg=45.0)
    assert roles(find_pairs([host, with_tip_at(touching, Finger.INDEX, palm_centre(host))], CONFIG)) == (2, 1)


@pytest.mark.parametrize("palm_up", [True, False])
@pytest.mark.parametrize("share", [0.3, 1.0, 2.0, 2.6])
@pytest.mark.parametrize("bend_deg", [-30.0, 0.0, 30.0])
def test_the_forearm_behind_the_wrist_is_part_of_the_limb(palm_up: bool, share: float, bend_deg: float) -> None:
    host = host_hand(palm_up=palm_up)
    wrist = host.xy_px(HandJoint.WRIST)
    bend = np.radians(bend_deg)
    tip = (float(wrist[0] + np.sin(bend) * share * PALM_PX), float(wrist[1] + np.cos(bend) * share * PALM_PX))
    result = find_pairs([pointing_hand(tip, pointing_deg=180.0), host], CONFIG)
    assert roles(result) == (1, 2)


def test_a_forearm_ends() -> None:
    host = host_hand()
    tip = (float(host.xy_px(HandJoint.WRIST)[0]), float(host.xy_px(HandJoint.WRIST)[1]) + 3.8 * PALM_PX)
    assert find_pairs([pointing_hand(tip, pointing_deg=180.0), host], CONFIG).reason is GateReason.TOO_FAR


def test_hands_far_apart_are_too_far() -> None:
    host = host_hand()
    assert find_pairs([pointing_hand(beside(host, 4.0), pointing_deg=90.0), host], CONFIG).reason is GateReason.TOO_FAR


def test_a_fist_over_the_palm_has_no_active_finger() -> None:
    fists = [make_hand(extended=(), hand_id=1, wrist_px=(640, 500)), host_hand(extended=())]
    assert find_pairs(fists, CONFIG).reason is GateReason.NO_ACTIVE_FINGER


def test_only_fingers_over_the_limb_count() -> None:
    host = host_hand()
    touching = with_tip_at(make_hand(hand_id=1, extended=(Finger.THUMB, Finger.INDEX), pointing_deg=150.0), Finger.INDEX, beside(host, 0.2))
    assert find_pairs([touching, host], CONFIG).pairs[0].active_fingers == (Finger.INDEX,)


def test_a_finger_beside_the_limb_stays_but_does_not_enter() -> None:
    host = host_hand()
    over = find_pairs([pointing_hand(beside(host, 0.2), pointing_deg=180.0), host], CONFIG)
    assert over.is_open
    away = [pointing_hand(beside(host, 0.4), pointing_deg=180.0), host]
    assert find_pairs(away, CONFIG).reason is GateReason.TOO_FAR
    assert find_pairs(away, CONFIG, over).is_open
    gone = [pointing_hand(beside(host, 0.6), pointing_deg=180.0), host]
    assert find_pairs(gone, CONFIG, over).reason is GateReason.TOO_FAR


def test_a_pointing_hand_touches_the_flat_one_even_when_it_covers_its_fingers() -> None:
    host = host_hand()
    from_above = pointing_hand(palm_centre(host), pointing_deg=-90.0)
    assert roles(find_pairs([from_above, host], CONFIG)) == (1, 2)


def test_roles_stay_while_both_fit() -> None:
    a = with_tip_at(make_hand(hand_id=1, extended=(Finger.INDEX,), pointing_deg=160.0), Finger.INDEX, (600, 400))
    b = with_tip_at(make_hand(Handedness.LEFT, hand_id=2, extended=(Finger.INDEX,), pointing_deg=20.0), Finger.INDEX, (606, 400))
    first = find_pairs([a, b], CONFIG)
    held = GateResult(GateReason.OPEN, (replace(first.pairs[0], touching=first.pairs[0].host, host=first.pairs[0].touching),))
    assert roles(find_pairs([a, b], CONFIG, first)) == roles(first)
    assert roles(find_pairs([a, b], CONFIG, held)) == roles(first)[::-1]


def test_a_hand_that_is_only_carried_on_does_not_touch() -> None:
    host = host_hand()
    hidden = pointing_hand(palm_centre(host), score=0.4)
    assert find_pairs([hidden, host], CONFIG).reason is GateReason.TOO_FAR


def test_a_hidden_host_can_be_touched() -> None:
    host = host_hand(score=0.2)
    assert roles(find_pairs([pointing_hand(palm_centre(host)), host], CONFIG)) == (1, 2)


@pytest.mark.parametrize("scale", [0.5, 1.0, 3.0])
def test_distance_is_in_the_hosts_palms_at_any_size(scale: float) -> None:
    host = host_hand(px_per_mm=2.0 * scale)
    tip = (float(host.landmarks_px[:, 0].max()) + 0.2 * PALM_PX * scale, palm_centre(host)[1])
    result = find_pairs([pointing_hand(tip, pointing_deg=180.0, px_per_mm=2.0 * scale), host], CONFIG)
    expected = find_pairs([pointing_hand(beside(host_hand(), 0.2), pointing_deg=180.0), host_hand()], CONFIG)
    assert result.pairs[0].distance_palms == pytest.approx(expected.pairs[0].distance_palms, rel=0.05)


def test_hands_with_all_landmarks_on_one_spot_do_no_harm() -> None:
    point = HandObservation(2, Handedness.LEFT, 1.0, np.zeros((21, 3)), np.zeros((21, 3)))
    assert find_pairs([pointing_hand((900, 400)), point], CONFIG).reason is GateReason.TOO_FAR
    assert find_pairs([point, replace(point, hand_id=3)], CONFIG).reason is GateReason.NO_ACTIVE_FINGER


def test_a_third_hand_does_not_disturb() -> None:
    host = host_hand()
    onlooker = make_hand(hand_id=3, wrist_px=(2400, 500), extended=FINGERS)
    assert roles(find_pairs([onlooker, pointing_hand(palm_centre(host)), host], CONFIG)) == (1, 2)
