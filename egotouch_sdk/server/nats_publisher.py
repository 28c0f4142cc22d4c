"""Republishing events to a NATS server that is already there."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import unquote, urlsplit

from egotouch_sdk.clock import now_ns
from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.publication import Publication

DEFAULT_PORT = 4222
#: Pauses between attempts to connect: they double from the first to the last (our choice).
FIRST_PAUSE_S = 0.1
LAST_PAUSE_S = 2.0
#: A server that does not confirm within this time is given up, and connected to anew.
CONFIRM_PATIENCE_S = 2
CONNECT_PATIENCE_S = 2
#: After this time with nothing to send the server is asked for a sign of life, so that a dead link is known before the next touch
#: (the idle heartbeat of the event server).
QUIET_S = 2
#: User and password (`user:password`), or a token, where the URL has none; unlike a URL it is in no list of processes.
CREDENTIALS_VARIABLE = "EGOTOUCH_NATS_CREDENTIALS"

_log = logging.getLogger("egotouch_sdk.server")


@dataclass(frozen=True, slots=True)
class NatsAddress:
    """Where a NATS server is and what proves who we are; `str()` gives nothing secret."""

    scheme: str
    host: str
    port: int
    credentials: str = ""

    @classmethod
    def parse(cls, url: str, credentials: str = "") -> NatsAddress:
        """From `nats://[user:password@ or token@]host[:port]` or `tls://...`; raises `ConfigError`, which never shows the URL."""
        try:
            parts = urlsplit(url)
            host, port = parts.hostname, parts.port or DEFAULT_PORT
        except ValueError:
            host = None
        if not host or parts.scheme not in {"nats", "tls"} or parts.path.strip("/") or parts.query or parts.fragment:
            raise ConfigError("the address of the NATS server is none", hint="Write nats://host:4222 or tls://host:4222")
        userinfo = parts.netloc.rpartition("@")[0]
        return cls(parts.scheme, host, port, userinfo or credentials)

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"

    __repr__ = __str__

    @property
    def url(self) -> str:
        """The address without credentials."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.scheme}://{host}:{self.port}"

    @property
    def login(self) -> dict[str, Any]:
        """Credentials as options of the NATS client."""
        user, separator, password = self.credentials.partition(":")
        if separator:
            return {"user": unquote(user), "password": unquote(password)}
        return {"token": unquote(user)} if user else {}


class NatsPublisher:
    """Sends a `Publication` to one NATS server and comes back to it whenever it is there; made and used on the event loop's thread.

    Each round of messages is confirmed by the server before the next is sent, so that what cannot be sent waits here, where it
    merges or gets too old, and nowhere else. A server that does not answer within `patience_s` is given up, also when there is nothing
    to send. Raises `MissingExtraError` without the extra `nats`.
    """

    def __init__(self, address: NatsAddress, publication: Publication, patience_s: int = CONFIRM_PATIENCE_S) -> None:
        try:
            import nats  # noqa: F401
        except ImportError as error:
            raise MissingExtraError("publishing to NATS", "nats") from error
        self._address = address
        self._publication = publication
        self._patience_s = patience_s
        self._wake = asyncio.Event()
        self._stopping = False
        self._problem = ""

    def offer(self, batch: Batch) -> None:
        """Take the newest batch; does not wait."""
        self._publication.offer(batch)
        self._wake.set()

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Publish while the block lasts; what waits at its end is still sent when the server is there."""
        task = asyncio.create_task(self._run())
        try:
            yield
        finally:
            if self._publication.connected:
                self._stopping = True
                self._wake.set()
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(asyncio.shield(task), self._patience_s)
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task

    async def _run(self) -> None:
        pause_s, warned = FIRST_PAUSE_S, ""
        while not self._stopping:
            client = await self._connect()
            if client is not None:
                if warned:
                    _log.warning("NATS at %s is there again", self._address)
                pause_s, warned = FIRST_PAUSE_S, ""
                await self._serve(client)
            if self._stopping:
                return
            if self._problem != warned:
                _log.warning("NATS at %s %s; serving goes on, publishing begins when that changes", self._address, self._problem)
                warned = self._problem
            await asyncio.sleep(pause_s)
            pause_s = min(2 * pause_s, LAST_PAUSE_S)

    async def _connect(self) -> Any:
        from nats.aio.client import Client
        from nats.errors import Error

        client = Client()
        try:
            async with asyncio.timeout(2 * CONNECT_PATIENCE_S):
                await client.connect(
                    self._address.url,
                    name="egotouch",
                    allow_reconnect=False,  # a reconnecting client would send late what it had kept
                    max_reconnect_attempts=1,
                    reconnect_time_wait=0,
                    connect_timeout=CONNECT_PATIENCE_S,
                    error_cb=_say_nothing,
                    closed_cb=self._on_closed,
                    **self._address.login,
                )
        except (OSError, Error, TimeoutError) as error:
            self._problem = "refuses the credentials" if "authorization" in str(error).lower() else "cannot be reached"
            await _close(client)
            return None
        except asyncio.CancelledError:
            await _close(client)
            raise
        return client

    async def _serve(self, client: Any) -> None:
        """Send until the link breaks or the end."""
        from nats.errors import Error

        self._problem = "is gone"
        self._publication.connect(now_ns())
        self._wake.set()
        try:
            while not client.is_closed:
                quiet = not await self._woken()
                messages = self._publication.take(now_ns())
                for subject, payload in messages:
                    await client.publish(subject, payload)
                if messages or quiet:
                    await client.flush(self._patience_s)  # a ping and its answer
                    self._publication.confirm()
                elif self._stopping:
                    break
                if self._stopping:
                    self._wake.set()
        except (OSError, Error, TimeoutError):
            pass
        finally:
            self._publication.disconnect()
            await _close(client)

    async def _woken(self) -> bool:
        """Wait for something to do; False after a quiet time."""
        try:
            async with asyncio.timeout(QUIET_S):
                await self._wake.wait()
        except TimeoutError:
            return False
        self._wake.clear()
        return True

    async def _on_closed(self) -> None:
        self._wake.set()


async def _close(client: Any) -> None:
    with contextlib.suppress(Exception):
        await asyncio.wait_for(client.close(), CONNECT_PATIENCE_S)


async def _say_nothing(error: Exception) -> None:
    """Errors end the connection; that is said once, without the library's traces."""
    del error
