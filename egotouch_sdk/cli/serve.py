"""`egotouch serve`: touch events over WebSocket."""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import os
import signal
import sys
from collections.abc import AsyncIterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import (
    Subparsers,
    add_command,
    add_named_source_options,
    add_pipeline_options,
    config_from,
    engine_from,
    open_from,
    port_number,
)
from egotouch_sdk.cli.views import open_browser
from egotouch_sdk.errors import ConfigError

if TYPE_CHECKING:
    from egotouch_sdk.server import EventServer, Settings
    from egotouch_sdk.server.debug_video import DebugVideo
    from egotouch_sdk.server.lan import Lan
    from egotouch_sdk.server.pushing import PushTarget
    from egotouch_sdk.sources import FrameSource, ObservationSource

EXAMPLES = """\
  egotouch serve 0                       the first camera, for programs and pages on this machine
  egotouch serve simulator               no camera: open the page /simulator.html and play the finger
  egotouch serve client --lan            a headset sends its own camera frames, with or without its hands
  egotouch serve taps.yaml               a script, over and over
  egotouch serve 0 --lan                 headsets on the same network: open the address or scan the code
  egotouch serve 0 --lan --keypad        the same with a phone's keys on the palm, to be dialled in a headset
  egotouch serve clip.mp4 --once         a video, once
  egotouch serve 0 --publish nats://hub:4222 --session booth-3
                                         to a NATS server too: egotouch.v1.booth-3.palm.down and so on
"""
NOTES = """
SOURCE may also be:
  simulator   fingers played on the page /simulator.html
  client      a headset or phone sends its own camera from the page /camera.html, or an app pushes ClientFrame messages
              (JPEG, up to 1 MiB and 3840x2160 px), with a ClientHands of the same
              timestamp_ns for each frame where the headset tracks hands itself; the newest frame counts, older ones are dropped

--publish sends each event as a TouchEvent to egotouch.v1.SESSION.SURFACE.TYPE, for example egotouch.v1.booth-3.palm.down; subscribe
to egotouch.v1.> for everything. Credentials: nats://user:password@host, nats://token@host, or "user:password" or a token in
EGOTOUCH_NATS_CREDENTIALS. While NATS is away nothing is kept beyond 250 ms; open touches are cancelled when it is back.
"""
SIMULATOR = "simulator"
CLIENT = "client"
KEYPAD_PAGE = "keypad/"
#: Sources that are played or sent by a page, and that page.
SOURCE_PAGES = {SIMULATOR: "simulator.html", CLIENT: "camera.html"}
DEFAULT_PORT = 8765
#: What asyncio calls every interface, IPv4 and IPv6.
ALL_INTERFACES = ""


def add_parser(subparsers: Subparsers) -> None:
    """Add `serve` to the command line."""
    parser = add_command(subparsers, "serve", "touch events over WebSocket, with a live page in the browser", EXAMPLES + NOTES)
    add_named_source_options(parser)
    add_pipeline_options(parser)
    parser.add_argument("--once", action="store_true", help="play a source that ends once, and stop then; else it begins again")
    add_server_options(parser)
    parser.set_defaults(handler=run, browser=False)


def add_server_options(parser: argparse._ActionsContainer) -> None:
    """How the server is reached and by whom."""
    parser.add_argument("--host", help="address to listen on (default 127.0.0.1; all interfaces with --lan)")
    parser.add_argument("--port", type=port_number, default=DEFAULT_PORT, help=f"port (default {DEFAULT_PORT}; 0 takes a free one)")
    parser.add_argument("--lan", action="store_true", help="serve the local network: TLS, and only clients with the token or pairing code")
    parser.add_argument("--token-file", type=Path, metavar="FILE", help="token that clients must send; made if missing")
    parser.add_argument("--allow-origin", action="append", default=[], metavar="URL", help="pages from there may connect too (repeatable)")
    parser.add_argument("--allow-host", action="append", default=[], metavar="NAME", help="another name of the server (repeatable)")
    parser.add_argument("--mdns", action="store_true", help="with --lan: announce the server to apps on the network")
    parser.add_argument("--publish", metavar="nats://HOST:4222", help="republish every event to this NATS server too (or tls://)")
    parser.add_argument("--publish-json", action="store_true", help="with --publish: events as JSON instead of protobuf")
    parser.add_argument("--session", metavar="NAME", help="with --publish: name in egotouch.v1.NAME.SURFACE.TYPE (default: this machine's)")
    parser.add_argument("--no-page", action="store_true", help="serve no page, only events")
    parser.add_argument("--keypad", action="store_true", help="show the skin keypad, /keypad/, in place of the page")
    parser.add_argument("--debug-view", action="store_true", help="show video on the page, and let clients ask for the landmarks of hands")


def run(options: argparse.Namespace) -> int:
    """Serve until Ctrl-C, or with --once until the source ends."""
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED

    if options.source is None:
        raise ConfigError("egotouch serve needs a SOURCE", hint="Give a camera (0), a file, simulator or client")
    if options.keypad and options.no_page:
        raise ConfigError("--keypad shows a page and --no-page serves none", hint="Give one of them")
    lan = _prepare_lan(options)
    source, push = _open(options)
    with source:
        engine = _engine(options, source)
        return EXIT_INTERRUPTED if asyncio.run(_serve(options, lan, source, engine, push)) else 0


async def _serve(
    options: argparse.Namespace, lan: Lan | None, source: FrameSource | ObservationSource, engine: Any, push: PushTarget | None
) -> bool:
    """Serve; True when Ctrl-C ended it."""
    from egotouch_sdk.server import EventServer
    from egotouch_sdk.server.debug_video import DebugVideo
    from egotouch_sdk.server.feed import Feed
    from egotouch_sdk.server.headset_target import HeadsetTarget
    from egotouch_sdk.sources import ObservationSource

    stop, interrupted = _stop_on_signals()
    video = DebugVideo() if options.debug_view and not isinstance(source, ObservationSource) else None
    server = EventServer(_settings(options, lan, engine.config, push, video))
    if isinstance(push, HeadsetTarget):
        server.metrics.more.append(push.lines)
    publishing = _publishing(options, server)
    await server.start()
    feed = Feed(server, source, engine, stall_ms=engine.config.state.stall_ms, repeat=not options.once)
    try:
        _introduce(options, lan, server)
        async with publishing, _announced(options, lan, server):
            feed.start()
            try:
                await asyncio.wait((stop, feed.ended), return_when=asyncio.FIRST_COMPLETED)
            finally:
                await feed.stop()
    finally:
        await server.stop()
    if interrupted.is_set():
        sys.stderr.write("egotouch: interrupted\n")
    elif feed.ended.done() and (failure := feed.ended.result()):
        raise failure
    return interrupted.is_set()


def _prepare_lan(options: argparse.Namespace) -> Lan | None:
    from egotouch_sdk.server.door import LOOPBACK_NAMES

    if not options.lan:
        if options.host and options.host not in LOOPBACK_NAMES:
            raise ConfigError(f"{options.host} can be reached by other machines", hint="Add --lan, which brings TLS and a token")
        if options.mdns:
            raise ConfigError("--mdns announces a server that only this machine can reach", hint="Add --lan")
        return None
    if options.port == 0:
        raise ConfigError("--lan and --port 0 do not go together", hint="Choose a port that can be opened in a firewall")
    from egotouch_sdk.server.lan import Lan
    from egotouch_sdk.server.secret_store import config_folder

    return Lan.prepare(config_folder(os.environ, Path.home()), options.token_file, options.allow_host)


def _open(options: argparse.Namespace) -> tuple[Any, PushTarget | None]:
    """The source, and what takes what clients push to it."""
    if options.source == CLIENT:
        from egotouch_sdk.server.headset_source import HeadsetSource
        from egotouch_sdk.server.headset_target import HeadsetTarget

        headset = HeadsetSource()
        return headset, HeadsetTarget(headset)
    if options.source != SIMULATOR:
        return open_from(options), None
    from egotouch_sdk.server.pushing import SimulatorTarget
    from egotouch_sdk.simulator.live_source import DEFAULT_FPS, LiveSource

    simulator = LiveSource(options.fps or DEFAULT_FPS)
    return simulator, SimulatorTarget(simulator)


def _engine(options: argparse.Namespace, source: Any) -> Any:
    if options.source != CLIENT:
        return engine_from(options, source)
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.server.headset_source import HeadsetPipeline

    return HeadsetPipeline(TouchPipeline(config_from(options)), source)


def _settings(options: argparse.Namespace, lan: Lan | None, config: Any, push: PushTarget | None, video: DebugVideo | None) -> Settings:
    from egotouch_sdk.server import Settings
    from egotouch_sdk.server.access import OpenAccess, TokenAccess
    from egotouch_sdk.server.door import Door
    from egotouch_sdk.server.pages import SHIPPED_PAGE, Pages
    from egotouch_sdk.server.secret_store import load_token
    from egotouch_sdk.server.welcome import ServerInfo

    offered = {
        SIMULATOR: options.source == SIMULATOR,
        "push_frames": options.source == CLIENT,
        "landmarks": options.debug_view,
        "debug_video": video is not None,
    }
    features = [name for name, on in offered.items() if on]
    token = lan.token if lan else load_token(options.token_file) if options.token_file else ""
    access = lan.access(lambda code: _show_code(lan, options, code)) if lan else TokenAccess(token) if token else OpenAccess()
    return Settings(
        host=options.host or (ALL_INTERFACES if lan else "127.0.0.1"),
        port=options.port,
        tls=lan.tls if lan else None,
        door=Door.of((*(lan.addresses + lan.names if lan else ()), *options.allow_host), options.allow_origin),
        access=access,
        token=token,
        info=ServerInfo.of(config, *features),
        pages=Pages(None if options.no_page else SHIPPED_PAGE),
        source=Path(options.source).name,
        landmarks=options.debug_view,
        video=video,
        push=push,
    )


def _introduce(options: argparse.Namespace, lan: Lan | None, server: EventServer) -> None:
    """What to open, one address per line."""
    from egotouch_sdk.clock import now_ns
    from egotouch_sdk.server.access import TokenAccess
    from egotouch_sdk.server.lan import page_url
    from egotouch_sdk.server.nats_publisher import NatsAddress

    scheme = "https" if lan else "http"
    hosts = (*lan.addresses, *lan.names[1:]) if lan else (server.settings.host,)
    page = KEYPAD_PAGE if options.keypad else SOURCE_PAGES.get(options.source, "")
    print(f"Touch events of {options.source}; Ctrl-C stops.")
    for host in hosts:
        url = page_url(scheme, host, server.port)
        if not options.no_page:
            print(f"  page       {url}{page}")
        print(f"  WebSocket  {url.replace('http', 'ws', 1)}  (egotouch.v1.pb, egotouch.v1.json)")
    if lan:
        print(f"  SHA-256    {lan.fingerprint}  (of the certificate, which browsers do not know: accept it once)")
    if isinstance(server.settings.access, TokenAccess):
        server.settings.access.offer_code(now_ns())
    if options.publish:
        print(f"  NATS       {NatsAddress.parse(options.publish)}")
    if options.debug_view:
        print("  Video and landmarks of the hands in view leave this program for clients that ask: --debug-view is on.")
    sys.stdout.flush()
    if options.browser and not options.no_page:
        open_browser(page_url(scheme, hosts[0], server.port) + page)


def _show_code(lan: Lan, options: argparse.Namespace, code: str) -> None:
    from egotouch_sdk.server.lan import qr_code

    url = lan.pairing_url(options.port, code, KEYPAD_PAGE if options.keypad else "")
    print(f"  pairing    {code}  (two minutes, one headset)\n  or open    {url}\n{qr_code(url)}", flush=True)


def _announced(options: argparse.Namespace, lan: Lan | None, server: EventServer) -> contextlib.AbstractAsyncContextManager[None]:
    if lan is None or not options.mdns:
        return _nothing()
    from egotouch_sdk.server.announce import announced

    return announced(lan.names[0] if lan.names else "egotouch", lan.addresses, server.port, lan.fingerprint)


def _publishing(options: argparse.Namespace, server: EventServer) -> contextlib.AbstractAsyncContextManager[None]:
    if not options.publish:
        if options.session or options.publish_json:
            raise ConfigError("--session and --publish-json are about publishing", hint="Add --publish nats://host:4222")
        return _nothing()
    from egotouch_sdk.server.nats_publisher import CREDENTIALS_VARIABLE, NatsAddress, NatsPublisher
    from egotouch_sdk.server.network import host_names
    from egotouch_sdk.server.publication import Publication

    address = NatsAddress.parse(options.publish, os.environ.get(CREDENTIALS_VARIABLE, ""))
    session = options.session or next(iter(host_names()), "egotouch")
    publication = Publication(session, server.settings.limits, as_json=options.publish_json)
    publisher = NatsPublisher(address, publication)
    server.hub.sinks.append(publisher.offer)
    server.metrics.more.append(publication.lines)
    return publisher.running()


@contextlib.asynccontextmanager
async def _nothing() -> AsyncIterator[None]:
    yield


def _stop_on_signals() -> tuple[asyncio.Future[None], asyncio.Event]:
    """A future that SIGINT and SIGTERM complete, and whether it was SIGINT."""
    loop = asyncio.get_running_loop()
    stop: asyncio.Future[None] = loop.create_future()
    interrupted = asyncio.Event()

    def on_signal(number: int) -> None:
        if number == signal.SIGINT:
            interrupted.set()
        if not stop.done():
            stop.set_result(None)

    for number in (signal.SIGINT, signal.SIGTERM):
        try:
            loop.add_signal_handler(number, on_signal, number)
        except NotImplementedError:  # Windows' event loop has none
            signal.signal(number, lambda received, _: loop.call_soon_threadsafe(on_signal, received))
    return stop, interrupted
