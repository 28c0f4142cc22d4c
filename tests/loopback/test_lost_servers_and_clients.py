"""Programs that are stopped or killed: `egotouch serve` in the middle of a touch, and a client that no longer reads."""

from __future__ import annotations

import asyncio
import gc
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from egotouch_sdk.clock import now_ns
from egotouch_sdk.server import Limits
from egotouch_sdk.touch_event import EventType as E
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.client_model import ClientModel
from tests.support.ports import free_port
from tests.support.socket_client import PATIENT, SocketClient, SocketFinger, running_server

TAPS = "egotouch_sdk/assets/scripts/taps.yaml"
PATIENCE_S = 60.0
#: A client that neither reads nor answers is closed after two ping intervals and the time a close may take, 13 s; a kernel alone
#: would hold on to it for a quarter of an hour.
CLOSED_WITHIN_S = 60.0
READER = """
import sys
from websockets.sync.client import connect
with connect(sys.argv[1], subprotocols=["egotouch.v1.pb"], compression=None, proxy=None) as connection:
    connection.send(bytes.fromhex(sys.argv[2]))
    connection.recv()
    print("in", flush=True)
    for _ in connection:
        pass
"""


@contextmanager
def serve(port: int, config: Path) -> Iterator[subprocess.Popen[str]]:
    """`egotouch serve` that plays taps over and over."""
    command = [sys.executable, "-m", "egotouch_sdk", "serve", TAPS, "--no-page", "--port", str(port)]
    environ = os.environ | {"EGOTOUCH_CONFIG": str(config), "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environ)
    try:
        assert process.stdout is not None
        assert any("WebSocket" in line for line in process.stdout), process.communicate()[1]
        yield process
    finally:
        process.kill()
        process.communicate()


async def follow(port: int, model: ClientModel, until: E) -> bool:
    """Follow a server until this type of event comes or the link breaks; True when it came."""
    seen = len(model.heard)
    try:
        async with (
            asyncio.timeout(PATIENCE_S),
            connect(f"ws://127.0.0.1:{port}/", subprotocols=[Subprotocol("egotouch.v1.pb")], compression=None, proxy=None) as connection,
        ):
            await connection.send(model.hello().SerializeToString())
            while until not in {event.type for event in model.heard[seen:]}:
                model.take(pb.ServerMessage.FromString(await connection.recv()))
            connection.transport.abort()
            return True
    except ConnectionClosed:
        return False


@pytest.mark.slow
def test_a_server_killed_in_a_touch_and_started_again(tmp_path: Path) -> None:
    port, model = free_port(), ClientModel()
    epochs = []
    for round_index in range(3):
        with serve(port, tmp_path) as process:
            assert asyncio.run(follow(port, model, E.DOWN))
            assert len(model.contacts) == 1
            process.kill()
        epochs.append(model.epoch)
        before = [event.type for event in model.heard]
        assert before.count(E.DOWN) == round_index + 1 and before.count(E.CLICK) == before.count(E.UP)
    with serve(port, tmp_path):
        downs = sum(event.type is E.DOWN for event in model.heard)
        assert asyncio.run(follow(port, model, E.CLICK))
    assert len({*epochs, model.epoch}) == 4 and not model.welcomes[-1].recovered
    assert model.local_cancels == 3 and model.contacts == set()
    assert sum(event.type is E.DOWN for event in model.heard) == downs + 1
    assert [event.type for event in model.heard].count(E.CLICK) == 1


@pytest.mark.slow
def test_a_network_cut_again_and_again_under_a_real_server(tmp_path: Path) -> None:
    port, model = free_port(), ClientModel()
    with serve(port, tmp_path):
        for until in (E.DOWN, E.UP, E.DOWN, E.DOWN, E.CLICK, E.DOWN):
            assert asyncio.run(follow(port, model, until))
    assert [welcome.recovered for welcome in model.welcomes] == [False] + [True] * 5
    assert model.local_cancels == 0
    edges = [event for event in model.heard if event.type.is_edge]
    assert len({(event.type, event.pointer_id, event.contact_id) for event in edges}) == len(edges), "an edge came twice"
    assert len(model.contacts) == 1


@pytest.mark.slow
def test_a_stopped_client_is_closed_and_others_do_not_notice() -> None:
    async def test() -> None:
        async with running_server(limits=replace(PATIENT, patience_ns=Limits().patience_ns)) as server:
            other, finger = SocketClient(server), SocketFinger(server)
            await other.join()
            finger.publish(E.HOVER_ENTER)
            finger.publish(E.DOWN)
            hello = pb.ClientMessage(hello=pb.Hello()).SerializeToString().hex()
            command = [sys.executable, "-c", READER, f"ws://127.0.0.1:{server.port}/", hello]
            victim = await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE)
            assert victim.stdout is not None and await victim.stdout.readline() == b"in\n"
            assert server.metrics.clients == 2
            victim.send_signal(signal.SIGSTOP)
            gc.collect()
            stopped_ns, before_kib = now_ns(), resident_kib()
            while server.metrics.clients == 2:
                published_ns = finger.publish(E.MOVE)
                while not other.model.acted or other.model.acted[-1].timestamp_ns != published_ns:
                    await other.receive()
                assert now_ns() - stopped_ns < CLOSED_WITHIN_S * 1e9
                other.model.acted.clear()
                other.model.heard.clear()
                await asyncio.sleep(0.005)
            assert set(server.metrics.closed) <= {1011, 4008} and server.metrics.closed.total() == 1
            gc.collect()
            assert resident_kib() - before_kib < 2048
            assert other.model.contacts == {(1, 1)}
            victim.kill()
            await victim.communicate()

    asyncio.run(asyncio.wait_for(test(), 120))


def resident_kib() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024
