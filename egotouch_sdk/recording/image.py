"""Pictures of a recording in Foxglove's own message type, so that Foxglove shows them as they are.

The type is `foxglove.CompressedImage` (foxglove/foxglove-sdk, schemas/proto; MIT), built here field by field: timestamp = 1,
data = 2, format = 3, frame_id = 4.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from google.protobuf import message_factory, timestamp_pb2
from google.protobuf.descriptor_pb2 import FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool

from egotouch_sdk.errors import RecordingError
from egotouch_sdk.frame import Frame

SCHEMA_NAME = "foxglove.CompressedImage"
#: JPEG quality 0..100; 85 shows skin without visible blocks (our choice).
JPEG_QUALITY = 85


def encode_image(frame: Frame) -> bytes:
    """The frame's picture as a serialised `foxglove.CompressedImage`; raises `RecordingError` when it cannot be coded."""
    import cv2

    ok, jpeg = cv2.imencode(".jpg", frame.image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    if not ok:
        raise RecordingError(f"a picture of {frame.width_px}x{frame.height_px} px cannot be coded as JPEG", hint="Record without video")
    message = _message_class()(data=jpeg.tobytes(), format="jpeg", frame_id="camera")
    message.timestamp.FromNanoseconds(frame.timestamp_ns)
    data: bytes = message.SerializeToString()
    return data


@cache
def image_schema() -> bytes:
    """The message type and what it imports as a serialised FileDescriptorSet."""
    data: bytes = FileDescriptorSet(file=_files()).SerializeToString()
    return data


def _files() -> list[FileDescriptorProto]:
    timestamp = FileDescriptorProto.FromString(timestamp_pb2.DESCRIPTOR.serialized_pb)
    image = FileDescriptorProto(name="foxglove/CompressedImage.proto", package="foxglove", syntax="proto3", dependency=[timestamp.name])
    fields = image.message_type.add(name="CompressedImage").field
    kinds = FieldDescriptorProto
    fields.add(name="timestamp", number=1, type=kinds.TYPE_MESSAGE, type_name=".google.protobuf.Timestamp", label=kinds.LABEL_OPTIONAL)
    fields.add(name="frame_id", number=4, type=kinds.TYPE_STRING, label=kinds.LABEL_OPTIONAL)
    fields.add(name="data", number=2, type=kinds.TYPE_BYTES, label=kinds.LABEL_OPTIONAL)
    fields.add(name="format", number=3, type=kinds.TYPE_STRING, label=kinds.LABEL_OPTIONAL)
    return [timestamp, image]


@cache
def _message_class() -> Any:
    pool = DescriptorPool()
    for file in _files():
        pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(SCHEMA_NAME))
