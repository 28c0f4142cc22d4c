"""The topics of a recording and the schemas that the file carries for them, so that other programs can open it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from google.protobuf.descriptor_pb2 import DescriptorProto, FileDescriptorProto, FileDescriptorSet

from egotouch_sdk.wire.gen import egotouch_pb2 as pb

HEADER = "/egotouch/header"
OBSERVATION = "/egotouch/observation"
EVENTS = "/egotouch/events"
END = "/egotouch/end"
IMAGE = "/egotouch/image"


@cache
def schema_of(name: str) -> bytes:
    """The message type called `egotouch.v1.{name}` and the types that it uses, as a serialised FileDescriptorSet."""
    whole = FileDescriptorProto.FromString(pb.DESCRIPTOR.serialized_pb)
    needed = _with_used(name, {message.name: message for message in whole.message_type}, set())
    part = FileDescriptorProto(name=whole.name, package=whole.package, syntax=whole.syntax)
    part.message_type.extend(message for message in whole.message_type if message.name in needed)
    part.enum_type.extend(enum for enum in whole.enum_type if enum.name in needed)
    data: bytes = FileDescriptorSet(file=[part]).SerializeToString()
    return data


def _with_used(name: str, messages: Mapping[str, DescriptorProto], found: set[str]) -> set[str]:
    """Names of a message and all messages and enums that its fields have, added to `found`."""
    if name not in found:
        found.add(name)
        for field in messages[name].field if name in messages else ():
            if field.type_name:
                _with_used(field.type_name.rpartition(".")[2], messages, found)
    return found
