"""Events and observations as protobuf messages and back.

Numbers of an event are float32 on the wire: 24 bits, an error of at most 6e-8 of the value. Integers are exact, and so is every
number of an observation, so that a recording replays to the same events.

Values that a newer peer may have added: `events_from_proto` leaves out events of an unknown type. A CANCEL with an unknown reason
counts as `TRACKING_LOST`, since a CANCEL must never get lost. An unknown finger, hand or surface is a `ProtocolError`; a server
sends such only to clients that named the feature in their Hello.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import copysign, pi

import numpy as np

from egotouch_sdk.errors import FrameError, ProtocolError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import NUM_JOINTS
from egotouch_sdk.observation import Fingertip, FloatArray, GateResult, HandObservation, TouchEstimate, TouchPair
from egotouch_sdk.touch_event import CancelReason, TouchEvent
from egotouch_sdk.wire import enums
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Fields that have the same name and meaning on both sides.
_SAME = (
    "pointer_id", "contact_id", "timestamp_ns", "touch_probability", "force_n", "x_mm", "y_mm", "dx_mm", "dy_mm", "velocity_x_mm_s",
    "velocity_y_mm_s", "image_x", "image_y", "click_count",
)  # fmt: skip
#: pi and pi/2 grow by this much at most when they are rounded to float32.
_FLOAT32_SLACK_RAD = 1e-6


def event_to_proto(event: TouchEvent) -> pb.TouchEvent:
    """The event as a message."""
    message = pb.TouchEvent(
        type=enums.EVENT_TYPES.number(event.type),
        hand=enums.HANDEDNESS.number(event.hand),
        finger=enums.FINGERS.number(event.finger),
        surface=enums.SURFACES.number(event.surface),
        pitch_rad=event.pitch_rad,
        yaw_rad=event.yaw_rad,
        reason=event.reason and enums.CANCEL_REASONS.number(event.reason),
        coalesced=[event_to_proto(older) for older in event.coalesced],
        **{name: getattr(event, name) for name in _SAME},
    )
    if event.down_time_ns is not None:
        message.down_time_ns = event.down_time_ns
    if event.force_sigma_n is not None:
        message.force_sigma_n = event.force_sigma_n
    return message


def event_from_proto(message: pb.TouchEvent) -> TouchEvent:
    """The event in a message; raises `ProtocolError` when a value is missing, unknown or out of range."""
    try:
        return TouchEvent(
            type=enums.EVENT_TYPES.member(message.type),
            hand=enums.HANDEDNESS.member(message.hand),
            finger=enums.FINGERS.member(message.finger),
            surface=enums.SURFACES.member(message.surface),
            pitch_rad=_angle(message.pitch_rad, pi / 2),
            yaw_rad=_angle(message.yaw_rad, pi),
            reason=(enums.CANCEL_REASONS.get(message.reason) or CancelReason.TRACKING_LOST) if message.reason else None,
            down_time_ns=message.down_time_ns if message.HasField("down_time_ns") else None,
            force_sigma_n=message.force_sigma_n if message.HasField("force_sigma_n") else None,
            coalesced=events_from_proto(message.coalesced),
            **{name: getattr(message, name) for name in _SAME},
        )
    except FrameError as error:
        raise ProtocolError(error.message, hint=error.hint) from error


def events_from_proto(messages: Iterable[pb.TouchEvent]) -> tuple[TouchEvent, ...]:
    """The events in the messages, without those of a type that this version does not know; else as `event_from_proto`."""
    return tuple(event_from_proto(message) for message in messages if message.type == 0 or enums.EVENT_TYPES.get(message.type))


def observation_to_proto(observation: FrameObservation) -> pb.FrameObservation:
    """The observation as a message; a fingertip's picture is left out."""
    return pb.FrameObservation(
        index=observation.index,
        timestamp_ns=observation.timestamp_ns,
        width_px=observation.width_px,
        height_px=observation.height_px,
        hands=[hand_to_proto(hand) for hand in observation.hands],
        gate=enums.GATE_REASONS.number(observation.gate.reason),
        pairs=[_pair_to_proto(pair) for pair in observation.gate.pairs],
        fingertips=[_fingertip_to_proto(*both) for both in zip(observation.fingertips, observation.estimates, strict=True)],
    )


def observation_from_proto(message: pb.FrameObservation) -> FrameObservation:
    """The observation in a message; raises `ProtocolError` when a value is missing, unknown or out of range."""
    try:
        return FrameObservation(
            index=message.index,
            timestamp_ns=message.timestamp_ns,
            width_px=message.width_px,
            height_px=message.height_px,
            hands=tuple(hand_from_proto(hand) for hand in message.hands),
            gate=GateResult(enums.GATE_REASONS.member(message.gate), tuple(_pair_from_proto(pair) for pair in message.pairs)),
            fingertips=tuple(_fingertip_from_proto(tip) for tip in message.fingertips),
            estimates=tuple(_estimate_from_proto(tip) for tip in message.fingertips),
        )
    except FrameError as error:
        raise ProtocolError(error.message, hint=error.hint) from error


def hand_to_proto(hand: HandObservation) -> pb.Hand:
    """One hand with its landmarks as a message."""
    return pb.Hand(
        hand_id=hand.hand_id,
        handedness=enums.HANDEDNESS.number(hand.handedness),
        score=hand.score,
        landmarks_px=hand.landmarks_px.ravel().tolist(),
        world_mm=hand.world_mm.ravel().tolist(),
    )


def hand_from_proto(message: pb.Hand) -> HandObservation:
    """The hand in a message; raises `ProtocolError` when a value is missing, unknown or out of range."""
    landmarks, world = _joints(message.landmarks_px, "landmarks_px"), _joints(message.world_mm, "world_mm")
    try:
        return HandObservation(message.hand_id, enums.HANDEDNESS.member(message.handedness), message.score, landmarks, world)
    except FrameError as error:
        raise ProtocolError(error.message, hint=error.hint) from error


def _pair_to_proto(pair: TouchPair) -> pb.TouchPair:
    return pb.TouchPair(
        touching=hand_to_proto(pair.touching),
        host=hand_to_proto(pair.host),
        distance_palms=pair.distance_palms,
        active_fingers=[enums.FINGERS.number(finger) for finger in pair.active_fingers],
    )


def _pair_from_proto(message: pb.TouchPair) -> TouchPair:
    fingers = tuple(enums.FINGERS.member(number) for number in message.active_fingers)
    return TouchPair(hand_from_proto(message.touching), hand_from_proto(message.host), message.distance_palms, fingers)


def _fingertip_to_proto(tip: Fingertip, estimate: TouchEstimate) -> pb.Fingertip:
    return pb.Fingertip(
        hand_id=tip.hand_id,
        handedness=enums.HANDEDNESS.number(tip.handedness),
        finger=enums.FINGERS.number(tip.finger),
        tip_x_px=tip.tip_px[0],
        tip_y_px=tip.tip_px[1],
        px_per_mm=tip.px_per_mm,
        r_palms=tip.r_palms,
        theta_rad=tip.theta_rad,
        touch_probability=estimate.touch_probability,
        force_n=estimate.force_n,
        force_sigma_n=estimate.force_sigma_n,
    )


def _fingertip_from_proto(message: pb.Fingertip) -> Fingertip:
    return Fingertip(
        hand_id=message.hand_id,
        handedness=enums.HANDEDNESS.member(message.handedness),
        finger=enums.FINGERS.member(message.finger),
        tip_px=(message.tip_x_px, message.tip_y_px),
        px_per_mm=message.px_per_mm,
        r_palms=message.r_palms,
        theta_rad=message.theta_rad,
    )


def _estimate_from_proto(message: pb.Fingertip) -> TouchEstimate:
    sigma_n = message.force_sigma_n if message.HasField("force_sigma_n") else None
    return TouchEstimate(message.hand_id, enums.FINGERS.member(message.finger), message.touch_probability, message.force_n, sigma_n)


def _joints(values: Iterable[float], name: str) -> FloatArray:
    array = np.fromiter(values, np.float32)
    if array.size != 3 * NUM_JOINTS:
        raise ProtocolError(f"{name} has {array.size} numbers, need {3 * NUM_JOINTS}")
    return array.reshape(NUM_JOINTS, 3)


def _angle(value: float, limit: float) -> float:
    return copysign(limit, value) if limit < abs(value) < limit + _FLOAT32_SLACK_RAD else value
