"""What a reader of the wire makes of gaps, limits and news from a later version."""

from __future__ import annotations

from math import pi

import pytest

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire import (
    decode,
    enums,
    event_from_proto,
    event_to_proto,
    events_from_proto,
    observation_from_proto,
    observation_to_proto,
)
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.events import make_event
from tests.support.hands import make_hand

FROM_THE_FUTURE = 99
TABLES = {
    "EventType": enums.EVENT_TYPES,
    "Finger": enums.FINGERS,
    "Handedness": enums.HANDEDNESS,
    "Surface": enums.SURFACES,
    "CancelReason": enums.CANCEL_REASONS,
    "GateReason": enums.GATE_REASONS,
}


@pytest.mark.parametrize("name", TABLES)
def test_every_number_of_the_schema_has_a_member_but_zero(name: str) -> None:
    numbers = [value.number for value in pb.DESCRIPTOR.enum_types_by_name[name].values]
    assert [number for number in numbers if TABLES[name].get(number) is None] == [0]
    assert all(TABLES[name].number(TABLES[name].member(number)) == number for number in numbers if number)


def test_every_field_of_an_event_is_in_the_schema_under_its_name() -> None:
    assert {field.name for field in pb.TouchEvent.DESCRIPTOR.fields} == set(TOUCH_EVENT_FIELDS)


TOUCH_EVENT_FIELDS = make_event(EventType.MOVE).__dataclass_fields__


@pytest.mark.parametrize("angle", [{"yaw_rad": pi}, {"yaw_rad": -pi}, {"pitch_rad": pi / 2}])
def test_a_right_angle_survives_its_rounding(angle: dict[str, float]) -> None:
    event = make_event(EventType.MOVE, **angle)
    arrived = event_from_proto(event_to_proto(event))
    assert (arrived.yaw_rad, arrived.pitch_rad) == pytest.approx((event.yaw_rad, event.pitch_rad), rel=1e-7)


def test_an_angle_beyond_rounding_is_refused() -> None:
    message = event_to_proto(make_event(EventType.MOVE))
    message.pitch_rad = 1.58
    with pytest.raises(ProtocolError, match="pitch_rad"):
        event_from_proto(message)


def test_an_event_of_a_later_type_is_left_out() -> None:
    messages = [event_to_proto(make_event(kind)) for kind in (EventType.DOWN, EventType.MOVE, EventType.UP)]
    messages[1].type = FROM_THE_FUTURE
    assert [event.type for event in events_from_proto(messages)] == [EventType.DOWN, EventType.UP]
    with pytest.raises(ProtocolError, match="no EventType 99"):
        event_from_proto(messages[1])


def test_a_cancel_with_a_later_reason_still_cancels() -> None:
    message = event_to_proto(make_event(EventType.CANCEL))
    message.reason = FROM_THE_FUTURE
    (event,) = events_from_proto([message])
    assert (event.type, event.reason) == (EventType.CANCEL, CancelReason.TRACKING_LOST)


@pytest.mark.parametrize("name", ["type", "finger", "hand", "surface"])
def test_an_event_without_a_needed_field_is_refused(name: str) -> None:
    message = event_to_proto(make_event(EventType.DOWN))
    message.ClearField(name)
    with pytest.raises(ProtocolError):
        events_from_proto([message])


OUT_OF_RANGE = {"force_n": -1.0, "touch_probability": 1.5, "click_count": 1, "x_mm": float("inf"), "yaw_rad": float("nan")}


@pytest.mark.parametrize("name", OUT_OF_RANGE)
def test_a_value_out_of_range_is_refused(name: str) -> None:
    message = event_to_proto(make_event(EventType.DOWN))
    setattr(message, name, OUT_OF_RANGE[name])
    with pytest.raises(ProtocolError):
        event_from_proto(message)


def test_a_cancel_without_a_reason_is_refused() -> None:
    message = event_to_proto(make_event(EventType.CANCEL))
    message.ClearField("reason")
    with pytest.raises(ProtocolError, match="reason"):
        event_from_proto(message)


def test_a_hand_with_a_missing_joint_is_refused() -> None:
    message = observation_to_proto(FrameObservation(0, 0, 640, 480, hands=(make_hand(),)))
    del message.hands[0].world_mm[-3:]
    with pytest.raises(ProtocolError, match="world_mm has 60 numbers, need 63"):
        observation_from_proto(message)


def test_an_observation_without_a_gate_is_refused() -> None:
    with pytest.raises(ProtocolError, match="GateReason 0"):
        observation_from_proto(pb.FrameObservation(width_px=640, height_px=480))


def test_fields_of_a_later_version_are_passed_over() -> None:
    unknown_field_200 = b"\xc2\x0c\x03new"
    data = event_to_proto(make_event(EventType.DOWN, finger=Finger.THUMB)).SerializeToString() + unknown_field_200
    assert event_from_proto(decode(pb.TouchEvent, data)).finger is Finger.THUMB
