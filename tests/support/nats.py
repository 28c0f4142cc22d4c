"""A real NATS server and somebody who listens to it."""

from __future__ import annotations

import asyncio
import contextlib
import os
import shutil
import signal
import subprocess
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from typing import Any

import pytest

from tests.support.ports import free_port
from tests.support.socket_client import PATIENCE_S

NATS_SERVER = shutil.which("nats-server", path="/usr/sbin:/usr/bin:/usr/local/bin:/sbin:/bin") or shutil.which("nats-server")

needs_nats = pytest.mark.skipif(NATS_SERVER is None, reason="nats-server is not installed (Debian package nats-server)")


class NatsServer:
    """A NATS server that can be killed and started again on its port."""

    def __init__(self, *options: str) -> None:
        self.port = free_port()
        self._options = options
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def url(self) -> str:
        """Its address without credentials."""
        return f"nats://127.0.0.1:{self.port}"

    def start(self) -> None:
        """Start, without waiting until it listens."""
        assert NATS_SERVER is not None
        command = [NATS_SERVER, "-a", "127.0.0.1", "-p", str(self.port), *self._options]
        self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def freeze(self) -> None:
        """Stop answering without closing anything; returns when nothing of the server runs any more."""
        assert self._process is not None
        self._process.send_signal(signal.SIGSTOP)
        os.waitpid(self._process.pid, os.WUNTRACED)

    def thaw(self) -> None:
        """Go on after `freeze`."""
        assert self._process is not None
        self._process.send_signal(signal.SIGCONT)

    def kill(self) -> None:
        """Kill -9."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None


@contextmanager
def nats_server(*options: str) -> Iterator[NatsServer]:
    """A NATS server that runs while the block lasts."""
    server = NatsServer(*options)
    server.start()
    try:
        yield server
    finally:
        server.kill()


class Listener:
    """Hears everything that is published under a subject."""

    def __init__(self) -> None:
        self.messages: asyncio.Queue[Any] = asyncio.Queue()

    async def hear(self, count: int) -> list[Any]:
        """The next messages."""
        async with asyncio.timeout(PATIENCE_S):
            return [await self.messages.get() for _ in range(count)]


@asynccontextmanager
async def listening(server: NatsServer, subject: str = "egotouch.v1.>", **login: Any) -> AsyncIterator[Listener]:
    """Somebody who listens while the block lasts."""
    from nats.aio.client import Client

    listener = Listener()

    async def on_message(message: Any) -> None:
        listener.messages.put_nowait(message)

    async def quiet(error: Exception) -> None:
        del error

    async with asyncio.timeout(PATIENCE_S):
        while True:
            client = Client()
            try:
                await client.connect(
                    server.url, error_cb=quiet, allow_reconnect=False, max_reconnect_attempts=1, reconnect_time_wait=0, **login
                )
                break
            except Exception:  # it does not listen yet
                with contextlib.suppress(Exception):
                    await client.close()
                await asyncio.sleep(0.02)
    await client.subscribe(subject, cb=on_message)
    await client.flush()
    try:
        yield listener
    finally:
        with contextlib.suppress(Exception):
            await client.close()
