"""The committed classes are those of the schema, and the schema keeps what it promised."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest
from google.protobuf.descriptor_pb2 import FieldDescriptorProto, FileDescriptorProto

PROTO = Path(__file__).parents[3] / "proto"


def load(name: str) -> ModuleType:
    """One of the scripts beside the schema."""
    spec = spec_from_file_location(f"schema_{name}", PROTO / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


compatibility = load("compatibility")


def test_the_generated_classes_are_up_to_date() -> None:
    pytest.importorskip("grpc_tools")
    run = subprocess.run([sys.executable, str(PROTO / "generate.py"), "--check"], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")


def test_the_schema_keeps_what_the_last_release_promised() -> None:
    assert compatibility.breaches(compatibility.baseline(), compatibility.committed()) == []


def _message(schema: FileDescriptorProto, name: str):  # type: ignore[no-untyped-def]
    return next(message for message in schema.message_type if message.name == name)


def _renumber(schema: FileDescriptorProto) -> None:
    _message(schema, "TouchEvent").field[9].number = 99


def _rename(schema: FileDescriptorProto) -> None:
    _message(schema, "TouchEvent").field[9].name = "force"


def _retype(schema: FileDescriptorProto) -> None:
    _message(schema, "TouchEvent").field[9].type = FieldDescriptorProto.TYPE_DOUBLE


def _repeat(schema: FileDescriptorProto) -> None:
    _message(schema, "TouchEvent").field[9].label = FieldDescriptorProto.LABEL_REPEATED


def _leave_oneof(schema: FileDescriptorProto) -> None:
    _message(schema, "ClientMessage").field[0].ClearField("oneof_index")


def _drop_field(schema: FileDescriptorProto) -> None:
    del _message(schema, "TouchEvent").field[9]


def _drop_message(schema: FileDescriptorProto) -> None:
    del schema.message_type[0]


def _renumber_enum_value(schema: FileDescriptorProto) -> None:
    schema.enum_type[0].value[3].number = 99


def _drop_enum(schema: FileDescriptorProto) -> None:
    del schema.enum_type[0]


BREAKING = [_renumber, _rename, _retype, _repeat, _leave_oneof, _drop_field, _drop_message, _renumber_enum_value, _drop_enum]


@pytest.mark.parametrize("change", BREAKING)
def test_a_breaking_change_is_found(change: Callable[[FileDescriptorProto], None]) -> None:
    schema = compatibility.committed()
    change(schema)
    assert len(compatibility.breaches(compatibility.committed(), schema)) == 1


def test_new_parts_and_a_reserved_field_break_nothing() -> None:
    schema = compatibility.committed()
    event = _message(schema, "TouchEvent")
    gone = event.field[9]
    event.reserved_range.add(start=gone.number, end=gone.number + 1)
    event.reserved_name.append(gone.name)
    del event.field[9]
    event.field.add(name="new", number=99, type=FieldDescriptorProto.TYPE_FLOAT, label=FieldDescriptorProto.LABEL_OPTIONAL)
    schema.message_type.add(name="New")
    schema.enum_type[0].value.add(name="EVENT_TYPE_NEW", number=99)
    assert compatibility.breaches(compatibility.committed(), schema) == []
