"""One connected client: a session tied to a socket."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from functools import lru_cache

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import Frame, Opcode
from websockets.protocol import State

from egotouch_sdk.clock import now_ns
from egotouch_sdk.server.close_code import CloseCode
from egotouch_sdk.server.metrics import Metrics
from egotouch_sdk.server.session import Session

#: More than this is not handed to the operating system in advance, so that what waits can still be merged and marked late.
WRITE_AHEAD_BYTES = 16 * 1024
#: What the kernel may keep besides, sent or not: three seconds of two fingers at 90 Hz.
KERNEL_BUFFER_BYTES = 64 * 1024
#: A blocked socket is looked at this often; merging loses nothing in the meantime.
BLOCKED_POLL_S = 0.01
#: How long a client may take to answer the close before the connection is cut.
CLOSE_PATIENCE_S = 2.0
#: RFC 6455, section 7.4.1: the connection broke without a close.
ABNORMAL_CLOSURE = 1006
#: Linux: bytes that the kernel keeps unsent before the socket counts as full.
_TCP_NOTSENT_LOWAT = getattr(socket, "TCP_NOTSENT_LOWAT", 25)


class Client:
    """Moves messages between a session and its WebSocket; everything happens on the event loop's thread."""

    def __init__(self, socket_: ServerConnection, session: Session, metrics: Metrics) -> None:
        self.session = session
        self._socket = socket_
        self._metrics = metrics
        self._wake = asyncio.Event()
        _keep_kernel_buffers_small(socket_)

    async def run(self) -> None:
        """Serve the client until one side ends the connection."""
        relay = asyncio.create_task(self._relay())
        try:
            async for data in self._socket:
                self.session.receive(data, now_ns())
                self.flush()
        except ConnectionClosed:
            pass
        finally:
            if self.session.close is None:
                relay.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await relay
            self._metrics.closed[int(self.session.close.code if self.session.close else ended_with(self._socket))] += 1

    def flush(self) -> None:
        """Hand over what the socket has room for; the relay does the rest."""
        while self._has_room:
            data = self.session.next_message(now_ns())
            if data is None:
                break
            if self._socket.protocol.state is State.OPEN:
                self._socket.transport.write(_frame(data))
                self._metrics.messages += 1
            if not self.session.has_waiting:
                break
        if self.session.close is not None or not self._has_room:
            self._wake.set()

    @property
    def _has_room(self) -> bool:
        return self._socket.transport.get_write_buffer_size() <= WRITE_AHEAD_BYTES

    async def _relay(self) -> None:
        """Wait for room while the socket is blocked, and close the connection when the session has ended."""
        while self.session.close is None:
            if self._has_room:
                await self._wake.wait()
            else:
                await asyncio.sleep(BLOCKED_POLL_S)
            self._wake.clear()
            self.flush()
        await hang_up(self._socket, self.session.close.code, self.session.close.reason)


@lru_cache(maxsize=8)
def _frame(data: bytes | str) -> bytes:
    """The message as the WebSocket frame that goes to every client: servers do not mask, and nothing here is compressed."""
    opcode, payload = (Opcode.TEXT, data.encode()) if isinstance(data, str) else (Opcode.BINARY, data)
    return Frame(opcode, payload).serialize(mask=False)


def ended_with(connection: ServerConnection) -> int:
    """The close code that came, else the one that was sent (a client that is stopped does not answer), else 1006."""
    close = connection.protocol.close_rcvd or connection.protocol.close_sent
    return close.code if close is not None else ABNORMAL_CLOSURE


async def hang_up(connection: ServerConnection, code: CloseCode, reason: str) -> None:
    """Close a connection with its code; cut it when the client does not answer."""
    try:
        await asyncio.wait_for(connection.close(code, reason), CLOSE_PATIENCE_S)
    except TimeoutError:
        connection.transport.abort()


def _keep_kernel_buffers_small(connection: ServerConnection) -> None:
    sock = connection.transport.get_extra_info("socket")
    if sock is not None and sock.family in {socket.AF_INET, socket.AF_INET6}:
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, KERNEL_BUFFER_BYTES)
        with contextlib.suppress(OSError):
            sock.setsockopt(socket.IPPROTO_TCP, _TCP_NOTSENT_LOWAT, WRITE_AHEAD_BYTES)
