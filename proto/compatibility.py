"""Tells whether old clients still understand the schema: `python proto/compatibility.py`, or `--accept` to make it the new baseline.

The baseline is the schema of the last release, a descriptor set as `protoc` and `buf` write it. What it says is never taken back:
numbers, names, types and labels of fields, numbers and names of enum values. A field may go only when its number and its name are
reserved. New messages, fields and enum values are fine.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from google.protobuf.descriptor_pb2 import (
    DescriptorProto,
    EnumDescriptorProto,
    FieldDescriptorProto,
    FileDescriptorProto,
    FileDescriptorSet,
)

BASELINE = Path(__file__).parent / "egotouch" / "v1" / "baseline.binpb"


def breaches(old: FileDescriptorProto, new: FileDescriptorProto) -> list[str]:
    """What `new` takes back of what `old` promised, one sentence each."""
    found = [] if old.package == new.package else [f"the package was {old.package} and is {new.package}"]
    messages = {message.name: message for message in new.message_type}
    enums = {enum.name: enum for enum in new.enum_type}
    for message in old.message_type:
        found += _message_breaches(message, messages[message.name]) if message.name in messages else [f"{message.name} is gone"]
    for enum in old.enum_type:
        found += _enum_breaches(enum, enums[enum.name]) if enum.name in enums else [f"{enum.name} is gone"]
    return found


def _message_breaches(old: DescriptorProto, new: DescriptorProto) -> Iterator[str]:
    fields = {field.number: field for field in new.field}
    reserved = {number for span in new.reserved_range for number in range(span.start, span.end)}
    for field in old.field:
        name = f"{old.name}.{field.name}"
        if field.number in fields:
            if _promise(old, field) != _promise(new, fields[field.number]):
                yield f"{name} = {field.number} has another name, type, label or oneof"
        elif field.number not in reserved or field.name not in new.reserved_name:
            yield f"{name} = {field.number} is gone and its number and name are not both reserved"


def _promise(message: DescriptorProto, field: FieldDescriptorProto) -> tuple[object, ...]:
    oneof = message.oneof_decl[field.oneof_index].name if field.HasField("oneof_index") else None
    return field.name, field.type, field.type_name, field.label, field.proto3_optional, oneof


def _enum_breaches(old: EnumDescriptorProto, new: EnumDescriptorProto) -> Iterator[str]:
    names = {value.number: value.name for value in new.value}
    for value in old.value:
        if names.get(value.number) != value.name:
            yield f"{value.name} = {value.number} is gone or has another name"


def committed() -> FileDescriptorProto:
    """The schema that the committed classes were generated from."""
    from egotouch_sdk.wire.gen import egotouch_pb2

    return FileDescriptorProto.FromString(egotouch_pb2.DESCRIPTOR.serialized_pb)


def baseline() -> FileDescriptorProto:
    """The schema of the last release."""
    (schema,) = FileDescriptorSet.FromString(BASELINE.read_bytes()).file
    return schema


def accept() -> int:
    """Compile the schema into the baseline, names for JSON included, which generated classes leave out and `buf` compares."""
    from grpc_tools import protoc

    schema = BASELINE.parent / "egotouch.proto"
    code: int = protoc.main(["protoc", f"-I{BASELINE.parents[2]}", f"--descriptor_set_out={BASELINE}", str(schema)])
    return code


def main(arguments: list[str]) -> int:
    """Compare with the baseline, or replace it."""
    if "--accept" in arguments:
        return accept()
    found = breaches(baseline(), committed())
    for breach in found:
        sys.stderr.write(f"{breach}\n")
    return 1 if found else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
