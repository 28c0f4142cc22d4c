"""`egotouch serve` as users start it."""

from __future__ import annotations

import asyncio
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from egotouch_sdk.cli.main import build_parser, main
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.client_model import ClientModel


class Served:
    """The command in a process of its own, up to its address."""

    def __init__(self, *arguments: str, config: Path) -> None:
        environ = os.environ | {"EGOTOUCH_CONFIG": str(config), "PYTHONUNBUFFERED": "1"}
        command = [sys.executable, "-m", "egotouch_sdk", "serve", *arguments, "--port", "0"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environ)
        assert self.process.stdout is not None
        self.lines: list[str] = []
        while not (self.lines and "WebSocket" in self.lines[-1]):
            line = self.process.stdout.readline()
            assert line, self.process.communicate()[1]
            self.lines.append(line)
        found = re.search(r"(wss?://\S+)", self.lines[-1])
        assert found is not None
        self.url = found[1]

    def stop(self, number: int) -> tuple[int, str]:
        """Send a signal; exit code and what was said on stderr."""
        self.process.send_signal(number)
        _, said = self.process.communicate(timeout=60)
        return self.process.returncode, said


async def listen_until_closed(served: Served, model: ClientModel, stop_after: EventType) -> int:
    """Follow the server, send it Ctrl-C after an event of this type, and return the close code."""
    async with connect(served.url, subprotocols=[Subprotocol("egotouch.v1.pb")], compression=None, proxy=None) as connection:
        await connection.send(model.hello(subscribe=pb.Subscribe(late_edges=True)).SerializeToString())
        sent = False
        try:
            while True:
                async with asyncio.timeout(60):
                    model.take(pb.ServerMessage.FromString(await connection.recv()))
                if not sent and stop_after in {event.type for event in model.heard}:
                    served.process.send_signal(signal.SIGINT)
                    sent = True
        except ConnectionClosed:
            return connection.close_code or 0


def test_ctrl_c_in_a_touch_cancels_it_everywhere(tmp_path: Path) -> None:
    script = tmp_path / "press.yaml"
    script.write_text("acts:\n  - press: {at: [0, 50], duration_ms: 60_000}\n")
    served, model = Served(str(script), config=tmp_path / "config"), ClientModel()
    assert asyncio.run(listen_until_closed(served, model, EventType.DOWN)) == 4001
    _, said = served.process.communicate(timeout=60)
    assert served.process.returncode == 130 and said == "egotouch: interrupted\n"
    cancel, leave = model.heard[-2:]
    assert (cancel.type, cancel.reason, leave.type) == (EventType.CANCEL, CancelReason.SERVER_STOPPED, EventType.HOVER_EXIT)
    assert model.held == {}
    assert not (tmp_path / "config").exists()


def test_sigterm_is_an_ordinary_end(tmp_path: Path) -> None:
    assert Served("simulator", config=tmp_path).stop(signal.SIGTERM) == (0, "")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["0", "--host", "0.0.0.0"], "Add --lan"),
        (["0", "--mdns"], "Add --lan"),
        (["nothing.mp4"], "no such source"),
    ],
)
def test_mistakes_are_one_line_with_a_next_step(arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", *arguments]) == 1
    said = capsys.readouterr().err
    assert words in said and said.count("\n") == 1


@pytest.mark.parametrize("words", [["client"], ["--source", "client"], ["--port", "0", "client"]])
def test_the_source_may_be_named(words: list[str]) -> None:
    assert build_parser().parse_args(["serve", *words]).source == "client"


def test_a_missing_source_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", "--port", "0"]) == 1
    assert "needs a SOURCE" in capsys.readouterr().err
