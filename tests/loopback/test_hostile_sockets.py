"""Whatever comes on the TCP port: its sender is closed with a documented code, nobody else notices, and nothing stays behind."""

from __future__ import annotations

import asyncio
import random
from collections.abc import AsyncIterator, Coroutine
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from egotouch_sdk.server import CloseCode, EventServer, event_server
from egotouch_sdk.touch_event import EventType as E
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.socket_client import PATIENCE_S, SocketClient, SocketFinger, running_server

HELLO = pb.ClientMessage(hello=pb.Hello()).SerializeToString()
BINARY, TEXT, MORE, PING, PONG, CLOSE = 2, 1, 0, 9, 10, 8
PROTOCOL_ERROR = 1002
#: RFC 6455's own codes that the WebSocket layer answers bytes with which make no frames, no UTF-8 or too much.
LAYER_CODES = {PROTOCOL_ERROR, 1007, CloseCode.TOO_LARGE}
DOCUMENTED = {int(code) for code in CloseCode} | LAYER_CODES | {1000, 1005}


def run(test: Coroutine[Any, Any, None], seconds: float = 240) -> None:
    asyncio.run(asyncio.wait_for(test, seconds))


class RawSocket:
    """A TCP connection that says what it likes."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer

    @classmethod
    async def connect(cls, server: EventServer) -> RawSocket:
        """Only TCP."""
        return cls(*await asyncio.open_connection("127.0.0.1", server.port))

    @classmethod
    async def open(cls, server: EventServer, subprotocol: str = "egotouch.v1.pb") -> RawSocket:
        """With the WebSocket handshake behind it."""
        raw = await cls.connect(server)
        raw.writer.write(handshake(server, subprotocol))
        async with asyncio.timeout(PATIENCE_S):
            assert b" 101 " in await raw.reader.readuntil(b"\r\n\r\n")
        return raw

    def send(self, opcode: int, payload: bytes, *, final: bool = True, masked: bool = True) -> None:
        """One frame."""
        self.writer.write(frame(opcode, payload, final=final, masked=masked))

    async def closed_with(self) -> int | None:
        """The code in the server's close frame; None when it only cut the connection."""
        async with asyncio.timeout(PATIENCE_S):
            try:
                while True:
                    first, length = await self.reader.readexactly(2)
                    if length > 125:
                        length = int.from_bytes(await self.reader.readexactly(2 if length == 126 else 8), "big")
                    payload = await self.reader.readexactly(length)
                    if first & 15 == CLOSE:
                        return int.from_bytes(payload[:2], "big") if payload else 1005
            except (asyncio.IncompleteReadError, ConnectionError):
                return None
            finally:
                self.cut()

    def cut(self) -> None:
        """Be gone."""
        self.writer.transport.abort()


def handshake(server: EventServer, subprotocol: str) -> bytes:
    return (
        f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        f"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: {subprotocol}\r\n\r\n"
    ).encode()


def frame(opcode: int, payload: bytes, *, final: bool = True, masked: bool = True) -> bytes:
    size = len(payload)
    head = bytes([(128 if final else 0) | opcode])
    mask = 128 if masked else 0
    if size < 126:
        head += bytes([mask | size])
    elif size < 1 << 16:
        head += bytes([mask | 126]) + size.to_bytes(2, "big")
    else:
        head += bytes([mask | 127]) + size.to_bytes(8, "big")
    return head + (bytes(4) if masked else b"") + payload  # a mask of zeros changes nothing


@asynccontextmanager
async def watched_server() -> AsyncIterator[EventServer]:
    """A server with a client that must hear a finger throughout, every frame of it; afterwards no task and no file is left over."""
    async with running_server() as server:
        client, finger = SocketClient(server), SocketFinger(server)
        await client.join()
        finger.publish(E.HOVER_ENTER)
        finger.publish(E.DOWN)
        files, tasks = open_files(), len(asyncio.all_tasks())
        sliding = asyncio.create_task(slide(finger))
        hearing = asyncio.create_task(hear_every_frame(client))
        yield server
        sliding.cancel()
        finger.publish(E.UP, E.CLICK)
        async with asyncio.timeout(PATIENCE_S):
            assert await hearing == finger.frame
            while (open_files(), len(asyncio.all_tasks())) != (files, tasks):
                await asyncio.sleep(0.02)
        assert server.metrics.clients == 1 and client.model.contacts == set()


async def slide(finger: SocketFinger) -> None:
    while True:
        await asyncio.sleep(0.011)
        finger.publish(E.MOVE)


async def hear_every_frame(client: SocketClient) -> int:
    """Frames heard up to the click, also those that became part of a later one."""
    frames = 0
    while not client.model.acted or client.model.acted[-1].type is not E.CLICK:
        message = await client.receive()
        if message.HasField("batch"):
            frames += max(1 + len(event.coalesced) for event in message.batch.events)
    return frames


def open_files() -> int:
    return len(list(Path("/proc/self/fd").iterdir())) if Path("/proc/self/fd").exists() else 0


def test_random_bytes_instead_of_a_handshake() -> None:
    async def test() -> None:
        dice = random.Random(1)
        async with watched_server() as server:
            for _ in range(150):
                raw = await RawSocket.connect(server)
                start = dice.choice([b"", b"GET / HTTP/1.1\r\n", b"\x16\x03\x01\x02\x00", b"POST / HTTP/1.1\r\n\r\n"])
                raw.writer.write(start + dice.randbytes(dice.randrange(200)) + b"\r\n\r\n")
                raw.writer.write_eof()
                async with asyncio.timeout(PATIENCE_S):
                    answer = await read_to_end(raw)
                assert b" 101 " not in answer and b"Traceback" not in answer
                raw.cut()

    run(test())


async def read_to_end(raw: RawSocket) -> bytes:
    try:
        return await raw.reader.read()
    except ConnectionError:
        return b""


def test_random_bytes_instead_of_frames_and_messages() -> None:
    async def test() -> None:
        dice = random.Random(2)
        async with watched_server() as server:
            codes = set()
            for index in range(300):
                raw = await RawSocket.open(server, dice.choice(["egotouch.v1.pb", "egotouch.v1.json"]))
                if dice.random() < 0.5:
                    raw.send(BINARY, HELLO)
                if index % 2:
                    raw.writer.write(dice.randbytes(dice.randrange(2, 300)))
                    raw.writer.write_eof()
                else:
                    raw.send(dice.choice([BINARY, TEXT]), dice.randbytes(dice.randrange(300)))
                    raw.send(BINARY, b"\xff")
                codes.add(await raw.closed_with())
            assert codes - {None} <= DOCUMENTED and {CloseCode.MALFORMED, PROTOCOL_ERROR} <= codes

    run(test())


@pytest.mark.parametrize(
    ("frames", "code"),
    [
        ([(BINARY, HELLO, True, False)], PROTOCOL_ERROR),  # a client must mask
        ([(BINARY | 64, HELLO, True, True)], PROTOCOL_ERROR),  # an extension that nobody agreed to
        ([(3, HELLO, True, True)], PROTOCOL_ERROR),  # an opcode that does not exist
        ([(MORE, HELLO, True, True)], PROTOCOL_ERROR),  # goes on with nothing
        ([(BINARY, HELLO, False, True), (BINARY, HELLO, True, True)], PROTOCOL_ERROR),  # begins again in the middle
        ([(PING, bytes(126), True, True)], PROTOCOL_ERROR),  # a control frame over 125 bytes
        ([(TEXT, b"\xff\xfe", True, True)], 1007),
        ([(BINARY, bytes((1 << 20) + 1), True, True)], CloseCode.TOO_LARGE),
        ([(BINARY, bytes(1 << 16), False, True), *[(MORE, bytes(1 << 16), False, True)] * 16], CloseCode.TOO_LARGE),
        ([(BINARY, HELLO, True, True), (BINARY, HELLO, True, True)], CloseCode.WRONG_ORDER),
        ([(BINARY, HELLO[:1], False, True), (MORE, HELLO[1:], True, True), (TEXT, b"{}", True, True)], CloseCode.MALFORMED),
    ],
)
def test_frames_that_break_the_rules(frames: list[tuple[int, bytes, bool, bool]], code: int) -> None:
    async def test() -> None:
        async with watched_server() as server:
            raw = await RawSocket.open(server)
            for opcode, payload, final, masked in frames:
                raw.send(opcode, payload, final=final, masked=masked)
            assert await raw.closed_with() == code

    run(test())


def test_a_flood_of_empty_fragments_is_too_large() -> None:
    async def test() -> None:
        async with watched_server() as server:
            raw = await RawSocket.open(server)
            raw.send(BINARY, HELLO)
            raw.send(BINARY, b"", final=False)
            raw.writer.write(frame(MORE, b"", final=False) * 20_000)
            assert await raw.closed_with() == CloseCode.TOO_LARGE

    run(test())


def test_a_flood_of_pings_is_answered_and_holds_nobody_up() -> None:
    async def test() -> None:
        async with watched_server() as server:
            raw = await RawSocket.open(server)
            raw.send(BINARY, HELLO)
            for _ in range(50):
                raw.writer.write(frame(PING, b"0123456789") * 100)
                await asyncio.sleep(0)
            raw.send(CLOSE, (1000).to_bytes(2, "big"))
            assert await raw.closed_with() == 1000

    run(test())


def test_slow_loris_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(event_server, "OPEN_PATIENCE_S", 3.0)

    async def test() -> None:
        async with watched_server() as server:
            silent, dribbling = [await RawSocket.connect(server) for _ in range(20)], await RawSocket.connect(server)
            dribble = asyncio.create_task(write_slowly(dribbling, handshake(server, "egotouch.v1.pb")))
            for raw in (*silent, dribbling):
                async with asyncio.timeout(PATIENCE_S):
                    assert b" 101 " not in await read_to_end(raw)
                raw.cut()
            dribble.cancel()

    run(test())


async def write_slowly(raw: RawSocket, data: bytes) -> None:
    for byte in data:
        raw.writer.write(bytes([byte]))
        await asyncio.sleep(0.05)


def test_a_thousand_connections_leave_nothing_behind() -> None:
    async def test() -> None:
        dice = random.Random(3)
        async with watched_server() as server:
            for _ in range(1000):
                raw = await (RawSocket.open(server) if dice.random() < 0.5 else RawSocket.connect(server))
                if dice.random() < 0.5:
                    raw.send(BINARY, HELLO)
                raw.cut()

    run(test())
