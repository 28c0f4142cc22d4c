"""A headset's own hands as they come in messages."""

from __future__ import annotations

import numpy as np
import pytest

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import WEBXR_INDEX, Handedness
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.server.headset_hands import hands_from_message
from egotouch_sdk.server.headset_source import HeadsetPipeline, HeadsetSource
from egotouch_sdk.wire.codec import hand_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.hands import host_hand, palm_centre, pointing_hand


def message() -> pb.ClientHands:
    host = host_hand()
    return pb.ClientHands(timestamp_ns=1, hands=[hand_to_proto(hand) for hand in (host, pointing_hand(palm_centre(host)))])


def test_mediapipes_joints_come_through() -> None:
    for hand, original in zip(hands_from_message(message()), message().hands, strict=True):
        assert np.allclose(hand.landmarks_px.ravel(), list(original.landmarks_px), atol=1e-3)
        centred = np.reshape(original.world_mm, (21, 3)) - np.reshape(original.world_mm, (21, 3)).mean(0)
        assert np.allclose(hand.world_mm, centred, atol=1e-3)


@pytest.mark.parametrize("columns", [2, 3])
def test_webxrs_joints_give_the_same_hand(columns: int) -> None:
    webxr = message()
    for hand in webxr.hands:
        for values, kept in ((hand.landmarks_px, columns), (hand.world_mm, 3)):
            joints = np.zeros((25, kept))
            joints[list(WEBXR_INDEX)] = np.reshape(values, (21, 3))[:, :kept]
            joints[[5, 10, 15, 20]] = joints[0]
            values[:] = joints.ravel().tolist()
    for hand, original in zip(hands_from_message(webxr), hands_from_message(message()), strict=True):
        assert hand.handedness is original.handedness
        assert np.allclose(hand.landmarks_px[:, :columns], original.landmarks_px[:, :columns], atol=1e-3)
        assert np.allclose(hand.world_mm, original.world_mm, atol=1e-3)


def test_a_score_that_is_not_given_is_full() -> None:
    hands = message()
    hands.hands[0].score = 0
    assert hands_from_message(hands)[0].score == 1.0


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e30, -20_000.0])
@pytest.mark.parametrize("field", ["landmarks_px", "world_mm"])
def test_absurd_numbers_are_refused(field: str, value: float) -> None:
    hands = message()
    getattr(hands.hands[0], field)[3] = value
    with pytest.raises(ProtocolError):
        hands_from_message(hands)


@pytest.mark.parametrize("field", ["landmarks_px", "world_mm"])
def test_a_hand_without_extent_is_refused(field: str) -> None:
    hands = message()
    getattr(hands.hands[0], field)[:] = [1.0] * 63
    with pytest.raises(ProtocolError, match=f"{field} is no hand"):
        hands_from_message(hands)


def test_whatever_is_let_in_does_not_stop_the_pipeline() -> None:
    random = np.random.default_rng(4)
    source = HeadsetSource()
    pipeline = HeadsetPipeline(TouchPipeline(), source)
    image = np.full((240, 320, 3), 127, np.uint8)
    let_in = 0
    for index in range(400):
        hands = message()
        for hand in hands.hands:
            spread = 10.0 ** random.uniform(-2, 4)
            if index % 2:
                hand.landmarks_px[:] = (np.array(hand.landmarks_px) + random.normal(0, spread, 63)).tolist()
            if index % 3:
                hand.world_mm[:] = (np.array(hand.world_mm) + random.normal(0, spread, 63)).tolist()
            if index % 7 == 0:
                hand.landmarks_px[:] = (random.uniform(0, 1, 21)[:, None] * random.normal(0, spread, 3)).ravel().tolist()
        try:
            source.hands = hands_from_message(hands)
        except ProtocolError:
            continue
        let_in += 1
        pipeline.process(Frame(image, index * 33_000_000, index))
    assert let_in > 100
    assert {hand.handedness for hand in source.hands or ()} == set(Handedness)
