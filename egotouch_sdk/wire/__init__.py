"""The wire protocol `egotouch.v1`: protobuf messages and what they stand for."""

from egotouch_sdk.wire.codec import event_from_proto, event_to_proto, events_from_proto, observation_from_proto, observation_to_proto
from egotouch_sdk.wire.messages import decode, from_json, to_json

__all__ = [
    "decode",
    "event_from_proto",
    "event_to_proto",
    "events_from_proto",
    "from_json",
    "observation_from_proto",
    "observation_to_proto",
    "to_json",
]
