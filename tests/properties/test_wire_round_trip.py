"""What goes over the wire arrives, and nothing else does."""

from __future__ import annotations

import json
from contextlib import suppress

from google.protobuf.message import Message
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.touch_event import TouchEvent
from egotouch_sdk.wire import (
    decode,
    event_from_proto,
    event_to_proto,
    events_from_proto,
    from_json,
    observation_from_proto,
    observation_to_proto,
    to_json,
)
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.properties.wire_strategies import observations, touch_events
from tests.support.wire import exact, float32_fields

#: Largest relative error of a number rounded to float32, and the smallest step near zero.
FLOAT32_STEP, TINY = 2**-24, 2**-149


@given(touch_events())
def test_an_event_arrives_with_numbers_in_32_bits(event: TouchEvent) -> None:
    arrived = event_from_proto(decode(pb.TouchEvent, event_to_proto(event).SerializeToString()))
    got = arrived.to_dict()
    for name, value in float32_fields(event).items():
        if name in ("pitch_rad", "yaw_rad"):
            assert abs(got[name] - getattr(event, name)) <= FLOAT32_STEP * abs(getattr(event, name)) + TINY
        elif name != "coalesced":
            assert got[name] == value, name
    assert len(arrived.coalesced) == len(event.coalesced)
    assert event_from_proto(event_to_proto(arrived)) == arrived, "a second way changes nothing"


@given(observations())
@settings(max_examples=50)
def test_an_observation_arrives_bit_for_bit(observation: FrameObservation) -> None:
    arrived = observation_from_proto(decode(pb.FrameObservation, observation_to_proto(observation).SerializeToString()))
    assert exact(arrived) == exact(observation)


@given(st.lists(touch_events(), max_size=3))
def test_json_says_the_same_as_bytes(events: list[TouchEvent]) -> None:
    message = pb.ServerMessage(offset=3, batch=pb.EventBatch(frame_index=7, events=[event_to_proto(event) for event in events]))
    assert from_json(pb.ServerMessage, to_json(message)) == message


def _read(message: Message) -> None:
    with suppress(ProtocolError):
        events_from_proto(message.batch.events if isinstance(message, pb.ServerMessage) else [])
    with suppress(ProtocolError):
        observation_from_proto(message) if isinstance(message, pb.FrameObservation) else None


@given(st.binary(max_size=200), st.sampled_from([pb.ClientMessage, pb.ServerMessage, pb.FrameObservation]))
def test_random_bytes_are_a_message_or_a_protocol_error(data: bytes, kind: type[Message]) -> None:
    with suppress(ProtocolError):
        _read(decode(kind, data))


@given(st.lists(touch_events(), min_size=1, max_size=2), st.data())
def test_changed_bytes_are_a_message_or_a_protocol_error(events: list[TouchEvent], data: st.DataObject) -> None:
    good = bytearray(pb.ServerMessage(batch=pb.EventBatch(events=[event_to_proto(event) for event in events])).SerializeToString())
    for _ in range(data.draw(st.integers(1, 4))):
        good[data.draw(st.integers(0, len(good) - 1))] = data.draw(st.integers(0, 255))
    with suppress(ProtocolError):
        _read(decode(pb.ServerMessage, bytes(good)))


_KEYS = ["hello", "token", "resume", "epoch", "subscribe", "types", "maxRateHz", "frame", "jpeg", "hands", "landmarks_px", "no_such"]
_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(_KEYS), inner, max_size=3),
    max_leaves=8,
)


@given(_JSON | st.text(max_size=40) | st.binary(max_size=40))
@settings(max_examples=300)
def test_any_json_is_a_message_or_a_protocol_error(value: object) -> None:
    text = value if isinstance(value, str | bytes) else json.dumps(value)
    with suppress(ProtocolError):
        from_json(pb.ClientMessage, text)
