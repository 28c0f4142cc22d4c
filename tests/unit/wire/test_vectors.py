"""The golden vectors, replayed as every client library replays them."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest
from google.protobuf.internal.decoder import _DecodeVarint

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire import decode, events_from_proto, from_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

VECTORS = Path(__file__).parents[3] / "proto" / "vectors"
NAMES = sorted(path.stem for path in VECTORS.glob("*.log"))
TWINS = sorted(path.stem for path in VECTORS.glob("*.bin") if path.stem.endswith(("_truncated", "_invalid")))


def reference_client() -> Any:
    """A fresh client that keeps every rule."""
    spec = spec_from_file_location("reference_client", VECTORS / "reference_client.py")
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module.ReferenceClient()


def delimited(data: bytes) -> Iterator[bytes]:
    """The parts of a .bin file; an empty one is a lost connection."""
    position = 0
    while position < len(data):
        size, start = _DecodeVarint(data, position)
        position = start + size
        yield data[start:position]


def messages_of(name: str) -> list[pb.ServerMessage | None]:
    """The server's messages, None for a lost connection."""
    return [decode(pb.ServerMessage, part) if part else None for part in delimited((VECTORS / f"{name}.bin").read_bytes())]


def log_of(messages: list[pb.ServerMessage | None]) -> list[str]:
    """What a client tells its app."""
    client = reference_client()
    for message in messages:
        if message is None:
            client.lose_connection()
        else:
            client.receive(message)
    if messages[-1] is None:
        client.cancel_all()
    assert client.held == {}
    log: list[str] = client.log
    return log


def test_there_is_a_vector_for_every_kind_of_touch_and_fault() -> None:
    assert set(NAMES) >= {"tap", "drag", "long_click", "force_press", "tracking_lost", "resumed", "not_resumed", "lost", "newer_server"}
    told = {line.removeprefix("late ").split()[1] for name in NAMES for line in (VECTORS / f"{name}.log").read_text().splitlines()}
    assert told == set(EventType)


@pytest.mark.parametrize("name", NAMES)
def test_a_client_makes_the_calls_of_the_log(name: str) -> None:
    assert log_of(messages_of(name)) == (VECTORS / f"{name}.log").read_text().splitlines()


@pytest.mark.parametrize("name", NAMES)
def test_json_holds_the_same_messages(name: str) -> None:
    content = json.loads((VECTORS / f"{name}.json").read_text())
    from_text = [entry if entry is None else from_json(pb.ServerMessage, json.dumps(entry)) for entry in content]
    from_bytes = messages_of(name)
    for message in from_bytes:
        if message is not None:
            message.DiscardUnknownFields()
    assert from_text == from_bytes


#: Streams of which the client gets all: no connection is lost, and nothing is left out because it is late.
UNBROKEN = [name for name in NAMES if None not in messages_of(name) and name != "late"]


@pytest.mark.parametrize("name", UNBROKEN)
def test_an_unbroken_stream_keeps_the_grammar(name: str) -> None:
    verifier = GrammarVerifier()
    for message in messages_of(name):
        assert message is not None
        verifier.feed(events_from_proto(message.batch.events))
    assert verifier.violations == []


@pytest.mark.parametrize("name", TWINS)
def test_a_spoiled_message_is_refused_and_none_of_it_is_told(name: str) -> None:
    *sound, spoiled = delimited((VECTORS / f"{name}.bin").read_bytes())
    client = reference_client()
    for part in sound:
        client.receive(decode(pb.ServerMessage, part)) if part else client.lose_connection()
    told = list(client.log)
    with pytest.raises(ProtocolError):
        client.receive(decode(pb.ServerMessage, spoiled))
    whole = (VECTORS / f"{name.rpartition('_')[0]}.log").read_text().splitlines()
    assert client.log == told == whole[: len(told)]
    assert len(told) < len(whole)


def test_client_messages_are_the_same_in_both_forms() -> None:
    content = json.loads((VECTORS / "client_messages.json").read_text())
    from_bytes = [decode(pb.ClientMessage, part) for part in delimited((VECTORS / "client_messages.bin").read_bytes())]
    assert [from_json(pb.ClientMessage, json.dumps(entry)) for entry in content] == from_bytes
    assert {message.WhichOneof("body") for message in from_bytes} >= {"hello", "subscribe", "clock_request", "heartbeat", "simulated"}
