"""Messages as bytes and as JSON; whatever is malformed is a `ProtocolError`."""

from __future__ import annotations

from typing import TypeVar

from google.protobuf import json_format
from google.protobuf.message import DecodeError, Message

from egotouch_sdk.errors import ProtocolError

M = TypeVar("M", bound=Message)

_HINT = "Send protobuf in the subprotocol egotouch.v1.pb and JSON in egotouch.v1.json"


def decode(kind: type[M], data: bytes) -> M:
    """The message of type `kind` in `data`; fields of a newer schema are ignored. Raises `ProtocolError` for anything else."""
    message: M = kind()
    try:
        message.ParseFromString(data)
    except (DecodeError, TypeError) as error:
        raise ProtocolError(f"{len(data)} bytes are no {kind.__name__}", hint=_HINT) from error
    return message


def to_json(message: Message) -> str:
    """One line of JSON: protobuf's canonical form, with the schema's own field names and with zeros written out.

    So a client without protobuf reads `event.dx_mm` as in Python and never meets an undefined number. 64-bit integers are strings
    and enum values names (`"EVENT_TYPE_DOWN"`), as canonical JSON wants it. Fields marked `optional` and sub-messages are left
    out while unset.
    """
    text: str = json_format.MessageToJson(
        message, preserving_proto_field_name=True, always_print_fields_with_no_presence=True, indent=None, ensure_ascii=False
    )
    return text


def from_json(kind: type[M], text: str | bytes) -> M:
    """The message of type `kind` in `text`, in canonical JSON with either spelling of field names; unknown fields and enum names are
    ignored, as in the binary form. Raises `ProtocolError` for anything else.
    """
    if text.lstrip()[:1] not in ("{", b"{"):
        raise ProtocolError(f"the text is no {kind.__name__} in JSON", hint=_HINT)
    try:
        message: M = json_format.Parse(text, kind(), ignore_unknown_fields=True)
    except (json_format.ParseError, UnicodeDecodeError, RecursionError) as error:
        raise ProtocolError(f"the text is no {kind.__name__} in JSON", hint=_HINT) from error
    return message
