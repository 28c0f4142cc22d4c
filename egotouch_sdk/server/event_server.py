"""The asyncio shell: one port for WebSocket clients, the client page and the server's own figures."""

from __future__ import annotations

import asyncio
import errno
import logging
import secrets
import ssl
from collections.abc import Sequence
from dataclasses import dataclass, field

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.typing import Subprotocol

from egotouch_sdk.clock import now_ns
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.server.access import Access, OpenAccess
from egotouch_sdk.server.client import WRITE_AHEAD_BYTES, Client, ended_with, hang_up
from egotouch_sdk.server.close_code import CloseCode
from egotouch_sdk.server.crowd import Crowd, counted_in
from egotouch_sdk.server.debug_video import DebugVideo
from egotouch_sdk.server.door import Door
from egotouch_sdk.server.http import HttpFront
from egotouch_sdk.server.hub import EventHub
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.limits import SECOND_NS, Limits
from egotouch_sdk.server.metrics import Metrics
from egotouch_sdk.server.pages import Pages
from egotouch_sdk.server.pushing import PushTarget
from egotouch_sdk.server.session import Session
from egotouch_sdk.server.status import StatusBoard, hands_view
from egotouch_sdk.server.subprotocol import SUBPROTOCOLS, choose
from egotouch_sdk.server.welcome import ServerInfo
from egotouch_sdk.touch_event import TouchEvent

#: Heartbeats and timeouts are looked after this often.
TICK_S = 0.02
#: Time for the TLS and WebSocket handshakes; a client that dawdles is cut.
OPEN_PATIENCE_S = 5.0
#: Connections, whatever they are up to, for each client that is allowed.
CONNECTIONS_PER_CLIENT = 4
#: Pings of the WebSocket layer; a client that is stopped or gone is closed within twice this (1011), whatever the kernels still buffer.
PING_S = 5.0

# Below this level the WebSocket layer would log whole messages, tokens among them, and a trace for everybody who sends it garbage.
_socket_log = logging.getLogger("egotouch_sdk.server.websocket")
_socket_log.setLevel(logging.CRITICAL)
_log = logging.getLogger("egotouch_sdk.server")


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """How a server is reached and by whom.

    `port` 0 takes a free one. `tls` is needed on anything but loopback. `token` protects /metrics where `access` asks for one.
    `source` is its name for people. `landmarks` lets clients ask for the hands in view, `video` shows
    what the camera sees on the page. `push` takes what clients push.
    """

    host: str = "127.0.0.1"
    port: int = 8765
    tls: ssl.SSLContext | None = None
    door: Door = field(default_factory=lambda: Door.of(()))
    access: Access = field(default_factory=OpenAccess)
    token: str = ""
    limits: Limits = field(default_factory=Limits)
    info: ServerInfo = field(default_factory=ServerInfo)
    pages: Pages = field(default_factory=Pages)
    source: str = ""
    landmarks: bool = False
    video: DebugVideo | None = None
    push: PushTarget | None = None


class EventServer:
    """Serves the events of one source to any number of clients.

    All methods belong to the event loop's thread; other threads use `loop.call_soon_threadsafe(server.publish, ...)`.
    """

    def __init__(self, settings: Settings | None = None) -> None:
        self.settings = settings or Settings()
        self.metrics = Metrics()
        self.hub = EventHub(Journal(secrets.randbits(64), self.settings.limits))
        self.port = self.settings.port
        self._clients: set[Client] = set()
        self._server: Server | None = None
        self._ticker: asyncio.Task[None] | None = None
        self._closing = False
        self._board = StatusBoard(self.settings.source)
        self._frame_index = 0
        self._source_index = -1
        self._crowd = Crowd(CONNECTIONS_PER_CLIENT * self.settings.limits.max_clients)
        self._front = HttpFront(
            self.settings.pages, self.settings.door, self.metrics, self._health, self.settings.token, self.settings.video
        )

    async def start(self) -> None:
        """Begin to listen; raises `ConfigError` when the address cannot be had."""
        settings = self.settings
        try:
            self._server = await serve(
                self._handle,
                settings.host,
                settings.port,
                ssl=settings.tls,
                subprotocols=[Subprotocol(name) for name in SUBPROTOCOLS],
                select_subprotocol=_select,
                process_request=lambda _, request: self._front.answer(request),
                compression=None,
                open_timeout=OPEN_PATIENCE_S,
                ping_interval=PING_S,
                ping_timeout=PING_S,
                close_timeout=1.0,
                max_size=settings.limits.max_message_bytes,
                write_limit=WRITE_AHEAD_BYTES,
                server_header=None,
                create_connection=counted_in(self._crowd),
                logger=_socket_log,
            )
        except OSError as error:
            raise _cannot_listen(settings, error) from error
        self.port = self._server.sockets[0].getsockname()[1]
        self._ticker = asyncio.create_task(self._tick())

    async def stop(self) -> None:
        """Close every connection with SERVER_STOPPING and stop listening; may be called twice."""
        self._closing = True
        if self._ticker:
            self._ticker.cancel()
        for client in self._clients:
            client.flush()
            client.session.end(CloseCode.SERVER_STOPPING, "the server stops")
            client.flush()
        if self._server:
            self._server.close(close_connections=False)
            await self._let_clients_go()
            self._server.close()
            await self._server.wait_closed()

    def take_frame(self, timestamp_ns: int, result: FrameResult | None, events: Sequence[TouchEvent], handed_ns: int) -> None:
        """Publish one frame's events and note what was seen in it; `result` is None for events that no frame brought about."""
        if result is not None:
            self._frame_index += 1
            self.metrics.frames += 1
            self.metrics.dropped["frame"] += max(result.index - self._source_index - 1, 0)
            self._source_index = result.index
            self._board.note(result, handed_ns)
            if self.settings.landmarks and any(client.session.subscription.landmarks for client in self._clients):
                view = hands_view(result)
                for client in self._clients:
                    client.session.offer_hands(view)
        self.publish(self._frame_index, timestamp_ns, events, handed_ns)
        if self.settings.landmarks and not events:
            self._flush()

    def publish(self, frame_index: int, timestamp_ns: int, events: Sequence[TouchEvent], handed_ns: int | None = None) -> None:
        """Publish the events of one frame, captured at `timestamp_ns` and known since `handed_ns`, both on this machine's clock."""
        handed_ns = now_ns() if handed_ns is None else handed_ns
        if not events:
            return
        self.metrics.events.update(event.type.value for event in events)
        self.metrics.capture_latency.add((handed_ns - timestamp_ns) / SECOND_NS)
        self.hub.publish(frame_index, timestamp_ns, events, handed_ns)
        sent_before = self.metrics.messages
        self._flush()
        self.metrics.added_latency.add((now_ns() - handed_ns) / SECOND_NS, self.metrics.messages - sent_before)

    async def _handle(self, connection: ServerConnection) -> None:
        refusal = self.settings.door.refusal(connection.request.headers if connection.request else {})
        name = connection.subprotocol or ""
        if refusal is not None:
            await hang_up(connection, refusal.code, refusal.reason)
        elif name not in SUBPROTOCOLS:
            await hang_up(connection, CloseCode.WRONG_VERSION, f"offer one of the subprotocols {', '.join(SUBPROTOCOLS)}")
        elif self._closing:
            await hang_up(connection, CloseCode.SERVER_STOPPING, "the server stops")
        elif len(self._clients) >= self.settings.limits.max_clients:
            await hang_up(connection, CloseCode.TOO_MANY_CLIENTS, f"this server takes {self.settings.limits.max_clients} clients")
        else:
            await self._serve_client(connection, name)
            return
        self.metrics.closed[ended_with(connection)] += 1

    async def _serve_client(self, connection: ServerConnection, subprotocol: str) -> None:
        settings = self.settings
        session = Session(
            self.hub.journal,
            SUBPROTOCOLS[subprotocol],
            now_ns(),
            access=settings.access,
            limits=settings.limits,
            info=settings.info,
            push=settings.push,
            drops=self.metrics.dropped,
        )
        client = Client(connection, session, self.metrics)
        self._clients.add(client)
        self.hub.sessions.add(session)
        self.metrics.clients = len(self._clients)
        try:
            await client.run()
        except Exception:
            _log.exception("a connection ended by a defect of the server")
            await hang_up(connection, CloseCode.SERVER_ERROR, "a defect of the server")
        finally:
            if settings.push is not None:
                settings.push.leave(session)
            self.hub.sessions.discard(session)
            self._clients.discard(client)
            self.metrics.clients = len(self._clients)

    def _health(self) -> dict[str, object]:
        return {"status": "ok", "frames": self.metrics.frames, "clients": len(self._clients), "version": self.settings.info.version}

    def _flush(self) -> None:
        for client in self._clients:
            client.flush()

    async def _tick(self) -> None:
        report_ns = now_ns()
        while True:
            await asyncio.sleep(TICK_S)
            time_ns = now_ns()
            if time_ns >= report_ns:
                report_ns = time_ns + SECOND_NS
                status = self._board.report(time_ns)
                for client in self._clients:
                    client.session.offer_status(status)
            for client in self._clients:
                client.session.tick(time_ns)
            self._flush()

    async def _let_clients_go(self) -> None:
        while self._clients:
            await asyncio.sleep(TICK_S)


def _select(protocol: object, offered: Sequence[Subprotocol]) -> Subprotocol | None:
    """One of ours; else the client's own first, so that a browser lets the close code through that explains it."""
    del protocol
    chosen = choose(offered)
    return Subprotocol(chosen) if chosen else (offered[0] if offered else None)


def _cannot_listen(settings: Settings, error: OSError) -> ConfigError:
    if error.errno == errno.EADDRINUSE:
        return ConfigError(f"port {settings.port} is in use", hint="Stop the other program or choose a port with --port")
    return ConfigError(f"cannot listen on {settings.host}:{settings.port} ({error.strerror or error})", hint="Check --host and --port")
