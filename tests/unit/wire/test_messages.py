"""The JSON form of messages."""

from __future__ import annotations

import json

import pytest

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire import decode, event_to_proto, from_json, to_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.events import make_event


def test_json_has_the_names_of_the_schema_and_every_number() -> None:
    event = json.loads(to_json(event_to_proto(make_event(EventType.DOWN, timestamp_ns=2**53 + 1))))
    assert event["type"] == "EVENT_TYPE_DOWN"
    assert event["timestamp_ns"] == "9007199254740993", "a double could not hold it"
    assert (event["dx_mm"], event["click_count"], event["coalesced"]) == (0.0, 0, [])
    assert "force_sigma_n" not in event


def test_json_is_one_line() -> None:
    assert "\n" not in to_json(pb.ClientMessage(hello=pb.Hello(client="two\nlines")))


@pytest.mark.parametrize("text", ['{"subscribe": {"max_rate_hz": 30}}', '{"subscribe": {"maxRateHz": 30}}'])
def test_both_spellings_are_read(text: str) -> None:
    assert from_json(pb.ClientMessage, text).subscribe.max_rate_hz == 30


def test_what_a_later_version_adds_is_passed_over() -> None:
    text = '{"subscribe": {"types": ["EVENT_TYPE_DOWN", "EVENT_TYPE_LICK"], "colour": "red"}, "trace": {}}'
    assert list(from_json(pb.ClientMessage, text).subscribe.types) == [pb.EVENT_TYPE_DOWN]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "7", '{"hello": 3}', '{"hello": {"token": "\\ud800"}}', '{"resume": {}} x', b"\xff\xfe", "[" * 5000]
)
def test_malformed_json_is_a_protocol_error(text: str | bytes) -> None:
    with pytest.raises(ProtocolError, match="no ClientMessage in JSON"):
        from_json(pb.ClientMessage, text)


@pytest.mark.parametrize("data", [b"\xff", b"\x0a\x05abc", b"\x0b", bytes(3)])
def test_malformed_bytes_are_a_protocol_error(data: bytes) -> None:
    with pytest.raises(ProtocolError, match="no ClientMessage"):
        decode(pb.ClientMessage, data)
