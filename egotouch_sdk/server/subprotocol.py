"""The two spellings of one schema, by the name of their WebSocket subprotocol."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import Protocol

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.wire import decode, from_json, to_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb


class Subprotocol(Protocol):
    """How messages become WebSocket messages."""

    @property
    @abstractmethod
    def name(self) -> str:
        """The subprotocol's name, with the major version of the protocol in it."""

    @abstractmethod
    def encode(self, message: pb.ServerMessage) -> bytes | str:
        """Bytes are sent as a binary message, text as a text message."""

    @abstractmethod
    def decode(self, data: bytes | str) -> pb.ClientMessage:
        """The client's message; raises `ProtocolError` for anything else."""


class Protobuf:
    """Binary messages in protobuf."""

    name = "egotouch.v1.pb"

    def encode(self, message: pb.ServerMessage) -> bytes:
        """The message's bytes."""
        data: bytes = message.SerializeToString()
        return data

    def decode(self, data: bytes | str) -> pb.ClientMessage:
        """The client's message; raises `ProtocolError` for text and for bytes that are none."""
        if isinstance(data, str):
            raise ProtocolError(f"a text message came in {self.name}", hint=f"Send binary messages, or use {Json.name}")
        return decode(pb.ClientMessage, data)


class Json:
    """Text messages in the JSON form of the same schema."""

    name = "egotouch.v1.json"

    def encode(self, message: pb.ServerMessage) -> str:
        """The message as one line."""
        return to_json(message)

    def decode(self, data: bytes | str) -> pb.ClientMessage:
        """The client's message; raises `ProtocolError` for bytes and for text that is none."""
        if isinstance(data, bytes):
            raise ProtocolError(f"a binary message came in {self.name}", hint=f"Send text messages, or use {Protobuf.name}")
        return from_json(pb.ClientMessage, data)


SUBPROTOCOLS: dict[str, Subprotocol] = {spelling.name: spelling for spelling in (Protobuf(), Json())}


def choose(offered: Sequence[str]) -> str | None:
    """The first of the client's subprotocols that this server speaks."""
    return next((name for name in offered if name in SUBPROTOCOLS), None)
