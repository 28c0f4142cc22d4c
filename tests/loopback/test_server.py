"""The whole server over real sockets on this machine's loopback address."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from collections.abc import Coroutine
from dataclasses import replace
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.server import CloseCode, EventServer, Settings
from egotouch_sdk.server.access import TokenAccess
from egotouch_sdk.server.limits import SECOND_NS
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.socket_client import PATIENCE_S, PATIENT, SocketClient, SocketFinger, running_server

E = EventType
TOKEN = "fedcba9876543210" * 2


def run(test: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(test, 120))


async def get(server: EventServer, path: str, host: str | None = None, *headers: str) -> tuple[int, str, bytes]:
    """Status, head and body of a plain HTTP request."""
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
    lines = [f"GET {path} HTTP/1.1", f"Host: {host or f'127.0.0.1:{server.port}'}", *headers]
    writer.write("\r\n".join((*lines, "", "")).encode())
    async with asyncio.timeout(PATIENCE_S):
        answer = await reader.read()
    writer.close()
    await writer.wait_closed()
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]), head.decode(), body


@pytest.mark.parametrize("subprotocol", ["egotouch.v1.pb", "egotouch.v1.json"])
def test_a_tap_reaches_every_client(subprotocol: str) -> None:
    async def test() -> None:
        async with running_server() as server:
            clients = [SocketClient(server, subprotocol) for _ in range(3)]
            for client in clients:
                await client.join()
            finger = SocketFinger(server)
            for types in ((E.HOVER_ENTER,), (E.DOWN,), (E.MOVE,), (E.UP, E.CLICK), (E.HOVER_EXIT,)):
                finger.publish(*types)
            for client in clients:
                await client.hear(E.HOVER_ENTER, E.DOWN, E.MOVE, E.UP, E.CLICK, E.HOVER_EXIT)
                await client.catch_up()
                assert client.model.acted == [] and client.model.contacts == set()

    run(test())


def test_five_network_cuts_in_a_row_lose_and_double_nothing() -> None:
    async def test() -> None:
        async with running_server() as server:
            client, finger = SocketClient(server), SocketFinger(server)
            await client.join(subscribe=pb.Subscribe(late_edges=True))
            finger.publish(E.HOVER_ENTER)
            await client.hear(E.HOVER_ENTER)
            for _ in range(5):
                finger.publish(E.DOWN)
                await client.catch_up()
                await client.cut()
                finger.publish(E.MOVE)
                finger.publish(E.UP, E.CLICK)
                assert (await client.join(subscribe=pb.Subscribe(late_edges=True))).recovered
                await client.catch_up()
            heard = [event.type for event in client.model.heard if event.type.is_edge]
            assert heard == [E.HOVER_ENTER, *[E.DOWN, E.UP, E.CLICK] * 5]
            assert client.model.contacts == set() and client.model.local_cancels == 0

    run(test())


def test_resume_with_no_event_ever_and_on_a_quiet_link() -> None:
    async def test() -> None:
        async with running_server() as server:
            client = SocketClient(server)
            await client.join()
            for _ in range(5):
                await client.cut()
                assert (await client.join()).recovered
            await client.catch_up()
            assert client.model.heard == []

    run(test())


def test_a_server_that_dies_in_a_touch_leaves_no_contact_behind() -> None:
    async def test() -> None:
        async with running_server() as first:
            client, finger = SocketClient(first), SocketFinger(first)
            await client.join()
            finger.publish(E.HOVER_ENTER)
            finger.publish(E.DOWN)
            await client.hear(E.HOVER_ENTER, E.DOWN)
            await client.cut()
        async with running_server() as second:
            client.server = second
            welcome = await client.join()
            assert not welcome.recovered and welcome.resume_requested
            await client.catch_up()
            assert client.model.local_cancels == 1 and client.model.contacts == set() and client.model.acted == []

    run(test())


def test_stopping_says_so_and_lets_clients_come_back() -> None:
    async def test() -> None:
        async with running_server() as server:
            client = SocketClient(server)
            await client.join()
            await asyncio.gather(server.stop(), client.expect_closed())
            assert client.connection is not None and client.connection.close_code == CloseCode.SERVER_STOPPING

    run(test())


def test_a_silent_server_beats_its_heart_while_touching() -> None:
    async def test() -> None:
        async with running_server(limits=replace(PATIENT, heartbeat_ns=3600 * SECOND_NS)) as server:
            client, finger = SocketClient(server), SocketFinger(server)
            await client.join()
            finger.publish(E.HOVER_ENTER)
            finger.publish(E.DOWN)
            await client.hear(E.HOVER_ENTER, E.DOWN)
            message = await client.receive()
            assert message.heartbeat.active_contacts == 1 and message.offset == 2

    run(test())


# ------------------------------------------------------------------------------------------------------------ refusals


async def refused(server: EventServer, hello: pb.ClientMessage | bytes | str | None = None, **options: Any) -> tuple[int, str]:
    """Code and reason with which a connection ends that sends `hello`."""
    client = SocketClient(server)
    await client.open(**options)
    if hello is not None:
        data = hello.SerializeToString() if isinstance(hello, pb.ClientMessage) else hello
        with contextlib.suppress(ConnectionClosed):
            await client.connection.send(data)
    return await client.expect_closed()


HELLO = pb.ClientMessage(hello=pb.Hello())


@pytest.mark.parametrize(
    ("hello", "options", "code"),
    [
        (HELLO, {"origin": "https://evil.example"}, CloseCode.WRONG_ORIGIN),
        (HELLO, {"origin": "null"}, CloseCode.WRONG_ORIGIN),
        (HELLO, {"additional_headers": {"Host": "evil.example"}}, CloseCode.WRONG_HOST),
        (HELLO, {"subprotocols": [Subprotocol("egotouch.v2.pb")]}, CloseCode.WRONG_VERSION),
        (HELLO, {"subprotocols": None}, CloseCode.WRONG_VERSION),
        (pb.ClientMessage(hello=pb.Hello(token="no")), {}, CloseCode.WRONG_TOKEN),
        (pb.ClientMessage(subscribe=pb.Subscribe()), {}, CloseCode.WRONG_ORDER),
        (b"\xff", {}, CloseCode.MALFORMED),
        ("text", {}, CloseCode.MALFORMED),
        (b"\x00" * ((1 << 20) + 1), {}, CloseCode.TOO_LARGE),
    ],
)
def test_each_refusal_has_its_code_and_others_go_on(
    hello: pb.ClientMessage | bytes | str, options: dict[str, Any], code: CloseCode
) -> None:
    async def test() -> None:
        async with running_server(access=TokenAccess(TOKEN)) as server:
            other, finger = SocketClient(server), SocketFinger(server)
            await other.join(token=TOKEN)
            if "additional_headers" in options:
                assert (await raw_close_code(server, options["additional_headers"]["Host"])) == code
            else:
                assert (await refused(server, hello, **options))[0] == code
            assert not code.reconnect
            finger.publish(E.HOVER_ENTER)
            await other.hear(E.HOVER_ENTER)

    run(test())


async def raw_close_code(server: EventServer, host: str) -> int:
    """The close code for a handshake under another Host, which client libraries do not let one choose."""
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
    writer.write(
        f"GET / HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: egotouch.v1.pb\r\n\r\n".encode()
    )
    async with asyncio.timeout(PATIENCE_S):
        assert b"101" in await reader.readuntil(b"\r\n\r\n")
        opcode, length = await reader.readexactly(2)
        payload = await reader.readexactly(length)
    writer.close()
    assert opcode == 0x88
    return int.from_bytes(payload[:2], "big")


def test_own_pages_and_programs_may_connect() -> None:
    async def test() -> None:
        async with running_server() as server:
            for origin in (f"http://127.0.0.1:{server.port}", "http://localhost:3000", None):
                client = SocketClient(server)
                await client.open(origin=origin)
                await client.send(HELLO)
                await client.receive()
                assert client.model.welcomes

    run(test())


def test_a_client_without_a_hello_is_closed() -> None:
    async def test() -> None:
        async with running_server(limits=replace(PATIENT, hello_timeout_ns=200_000_000)) as server:
            assert (await refused(server))[0] == CloseCode.HELLO_TIMEOUT

    run(test())


def test_one_client_too_many_is_told_so() -> None:
    async def test() -> None:
        async with running_server(limits=replace(PATIENT, max_clients=2)) as server:
            for _ in range(2):
                await SocketClient(server).join()
            assert (await refused(server))[0] == CloseCode.TOO_MANY_CLIENTS

    run(test())


def test_silent_connections_are_bounded() -> None:
    async def test() -> None:
        async with running_server(limits=replace(PATIENT, max_clients=1)) as server:
            streams = [await asyncio.open_connection("127.0.0.1", server.port) for _ in range(4)]
            reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
            async with asyncio.timeout(PATIENCE_S):
                assert await reader.read() == b""
            for _, open_writer in (*streams, (reader, writer)):
                open_writer.transport.abort()

    run(test())


def test_too_many_commands_close() -> None:
    async def test() -> None:
        async with running_server() as server:
            client = SocketClient(server)
            await client.join()
            with contextlib.suppress(ConnectionClosed):
                for _ in range(1000):
                    await client.send(pb.ClientMessage(heartbeat=pb.Heartbeat()))
            assert (await client.expect_closed())[0] == CloseCode.TOO_MANY_COMMANDS

    run(test())


def test_a_taken_port_is_an_error_with_a_next_step() -> None:
    async def test() -> None:
        async with running_server() as server:
            with pytest.raises(ConfigError, match=f"port {server.port} is in use.*--port"):
                await EventServer(Settings(port=server.port)).start()

    run(test())


def test_no_secret_reaches_a_log(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)

    async def test() -> None:
        async with running_server(access=TokenAccess(TOKEN, new_code=lambda: "271828")) as server:
            await SocketClient(server).join(token=TOKEN)
            await SocketClient(server).join(pairing_code="271828")
            _, reason = await refused(server, pb.ClientMessage(hello=pb.Hello(token=f"{TOKEN}x")))
            assert TOKEN not in reason
            await get(server, f"/?token={TOKEN}")

    logging.getLogger("egotouch_sdk.server").setLevel(logging.DEBUG)
    run(test())
    own = [record.getMessage() for record in caplog.records if not record.name.startswith("websockets.client")]
    assert not [line for line in own if TOKEN in line or "271828" in line]


# ------------------------------------------------------------------------------------------------------------ plain HTTP


def test_the_page_comes_with_its_headers() -> None:
    async def test() -> None:
        async with running_server() as server:
            status, head, body = await get(server, "/")
            assert status == 200 and b"<!doctype html>" in body
            assert "text/html" in head and "Content-Security-Policy: default-src 'self'" in head and "nosniff" in head
            assert "text/javascript" in (await get(server, "/live_view.js?v=1"))[1]
            assert "text/css" in (await get(server, "/style.css"))[1]

    run(test())


def test_the_keypad_is_a_folder_of_its_own() -> None:
    async def test() -> None:
        async with running_server() as server:
            status, head, _ = await get(server, "/keypad")
            assert status == 308 and head.endswith("Location: /keypad/")
            assert (await get(server, "/keypad/"))[0] == 200
            assert "text/javascript" in (await get(server, "/keypad/keypad.js"))[1]

    run(test())


@pytest.mark.parametrize(
    "path", ["/nothing", "/keypad/nothing", "//keypad", "/../client.py", "/%2e%2e/client.py", "//etc/passwd", "/__init__.py"]
)
def test_only_the_page_is_served(path: str) -> None:
    async def test() -> None:
        async with running_server() as server:
            assert (await get(server, path))[0] == 404

    run(test())


def test_the_page_is_not_served_under_another_name() -> None:
    async def test() -> None:
        async with running_server() as server:
            for path in ("/", "/healthz", "/metrics"):
                assert (await get(server, path, "evil.example"))[0] == 421

    run(test())


def test_health_and_metrics() -> None:
    async def test() -> None:
        async with running_server() as server:
            client, finger = SocketClient(server), SocketFinger(server)
            await client.join()
            finger.publish(E.HOVER_ENTER)
            await client.hear(E.HOVER_ENTER)
            await refused(server, b"\xff")
            async with asyncio.timeout(PATIENCE_S):
                while server.metrics.clients > 1:
                    await asyncio.sleep(0.005)
            assert json.loads((await get(server, "/healthz"))[2]) | {"version": ""} == {
                "status": "ok", "frames": 0, "clients": 1, "version": ""
            }  # fmt: skip
            lines = (await get(server, "/metrics"))[2].decode().splitlines()
            for line in (
                'egotouch_events_total{type="hover_enter"} 1',
                "egotouch_clients 1",
                'egotouch_connections_closed_total{code="4422"} 1',
                'egotouch_dropped_total{class="frame"} 0',
                'egotouch_dropped_total{class="late_edge"} 0',
                "egotouch_added_latency_seconds_count 1",
            ):
                assert line in lines

    run(test())


def test_frames_that_nobody_had_time_for_are_counted() -> None:
    async def test() -> None:
        async with running_server() as server:
            for index in (0, 1, 4, 5, 0, 2):  # a clip that begins anew after its sixth frame
                server.take_frame(index, FrameResult(FrameObservation(index, index, 640, 480)), (), index)
            assert {"egotouch_frames_total 6", 'egotouch_dropped_total{class="frame"} 3'} <= set(server.metrics.text().splitlines())

    run(test())


def test_metrics_need_the_token_where_clients_do() -> None:
    async def test() -> None:
        async with running_server(access=TokenAccess(TOKEN), token=TOKEN) as server:
            assert (await get(server, "/metrics"))[0] == 401
            assert (await get(server, "/metrics", None, f"Authorization: Bearer {TOKEN}"))[0] == 200

    run(test())


def test_a_web_socket_elsewhere_is_not_found() -> None:
    async def test() -> None:
        async with running_server() as server:
            with pytest.raises(InvalidStatus, match="404"):
                await connect(f"ws://127.0.0.1:{server.port}/elsewhere", subprotocols=[Subprotocol("egotouch.v1.pb")])

    run(test())
