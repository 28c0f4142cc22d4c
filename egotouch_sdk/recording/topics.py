"""The topics of a recording and the schemas that the file carries for them, so that other programs can open it."""

from __future__ import annotations

from functools import cache

from google.protobuf.descriptor_pb2 import FileDescriptorProto, FileDescriptorSet

from egotouch_sdk.wire.gen import egotouch_pb2 as pb

HEADER = "/egotouch/header"
OBSERVATION = "/egotouch/observation"
EVENTS = "/egotouch/events"
END = "/egotouch/end"
IMAGE = "/egotouch/image"


@cache
def own_schema() -> bytes:
    """The whole schema of egotouch as a serialised FileDescriptorSet."""
    data: bytes = FileDescriptorSet(file=[FileDescriptorProto.FromString(pb.DESCRIPTOR.serialized_pb)]).SerializeToString()
    return data
