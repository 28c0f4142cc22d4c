"""A client with a real socket, and a server to talk to."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from egotouch_sdk.clock import now_ns
from egotouch_sdk.server import EventServer, Limits, Settings
from egotouch_sdk.server.limits import SECOND_NS
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire import from_json, to_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.client_model import ClientModel
from tests.support.events import make_event

_opened: list[ClientConnection] = []

#: Nothing in these tests takes long; what takes longer has failed.
PATIENCE_S = 30.0
#: A machine that holds a test up for a while makes nothing late and nobody slow.
PATIENT = Limits(hello_timeout_ns=30 * SECOND_NS, input_ttl_ns=30 * SECOND_NS, patience_ns=30 * SECOND_NS, journal_ns=120 * SECOND_NS)


@asynccontextmanager
async def running_server(settings: Settings | None = None, **changes: Any) -> AsyncIterator[EventServer]:
    """A server on a free port of the loopback address, patient unless told otherwise."""
    server = EventServer(replace(settings or Settings(limits=PATIENT), port=0, **changes))
    await server.start()
    try:
        yield server
    finally:
        await server.stop()
        while _opened:
            await _opened.pop().close()


class SocketClient:
    """One client library over any number of connections to one server."""

    def __init__(self, server: EventServer, subprotocol: str = "egotouch.v1.pb") -> None:
        self.server = server
        self.model = ClientModel()
        self.connection: ClientConnection | None = None
        self._subprotocol = subprotocol

    async def open(self, **options: Any) -> None:
        """Open the WebSocket and say nothing."""
        offered = options.pop("subprotocols", [Subprotocol(self._subprotocol)])
        url = f"{'wss' if self.server.settings.tls else 'ws'}://127.0.0.1:{self.server.port}/"
        self.connection = await connect(url, subprotocols=offered, compression=None, max_size=None, **options)
        _opened.append(self.connection)

    async def join(self, **hello: Any) -> pb.Welcome:
        """Open, say Hello and wait for the Welcome."""
        await self.open()
        await self.send(self.model.hello(**hello))
        count = len(self.model.welcomes)
        while len(self.model.welcomes) == count:
            await self.receive()
        return self.model.welcomes[-1]

    async def send(self, message: pb.ClientMessage) -> None:
        """Send one message."""
        assert self.connection is not None
        await self.connection.send(to_json(message) if self._subprotocol.endswith("json") else message.SerializeToString())

    async def receive(self) -> pb.ServerMessage:
        """The next message, after the model has taken it in."""
        assert self.connection is not None
        async with asyncio.timeout(PATIENCE_S):
            data = await self.connection.recv()
        message = from_json(pb.ServerMessage, data) if isinstance(data, str) else pb.ServerMessage.FromString(data)
        self.model.take(message)
        return message

    async def hear(self, *types: EventType) -> None:
        """Exactly these events come next."""
        while len(self.model.acted) < len(types):
            await self.receive()
        assert self.model.take_types() == list(types)

    async def catch_up(self) -> None:
        """Take in everything up to a clock reply, which comes after all that the server has sent before."""
        await self.send(pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=now_ns())))
        while not (await self.receive()).HasField("clock_reply"):
            pass

    async def expect_closed(self) -> tuple[int, str]:
        """The server closes; its code and reason."""
        assert self.connection is not None
        try:
            async with asyncio.timeout(PATIENCE_S):
                while True:
                    await self.connection.recv()
        except ConnectionClosed:
            return self.connection.close_code or 0, self.connection.close_reason or ""

    async def cut(self) -> None:
        """Lose the network: no closing handshake."""
        assert self.connection is not None
        self.connection.transport.abort()
        await self.connection.wait_closed()


class SocketFinger:
    """A finger whose events a running server publishes, one frame each."""

    def __init__(self, server: EventServer, pointer_id: int = 1) -> None:
        self.server = server
        self.pointer_id = pointer_id
        self.contact_id = 0
        self.down_ns = 0
        self.frame = 0

    def publish(self, *types: EventType) -> int:
        """One frame with events of these types; its time."""
        self.frame += 1
        time_ns = now_ns()
        if EventType.DOWN in types:
            self.contact_id, self.down_ns = self.contact_id + 1, time_ns
        events = [
            make_event(
                event_type,
                time_ns,
                pointer_id=self.pointer_id,
                contact_id=self.contact_id,
                down_time_ns=None if event_type.is_hover else self.down_ns,
            )
            for event_type in types
        ]
        self.server.publish(self.frame, time_ns, events)
        return time_ns
