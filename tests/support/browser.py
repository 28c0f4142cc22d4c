"""A real browser on the simulator's page, the server as a process of its own, and a second client that listens."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any

from playwright.sync_api import Browser, Page, ViewportSize
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

#: Nothing here takes long; what takes longer has failed.
PATIENCE_S = 20.0
DESKTOP: ViewportSize = {"width": 1440, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 844}
CHROMIUM_ARGUMENTS = ("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
                      "--disable-component-update", "--disable-sync")  # fmt: skip
_NAMES = ("chromium", "chromium-browser", "google-chrome")
_TO_SCREEN = """([x, y]) => {
  const { view } = egotouch;
  const { left, top } = view.canvas.getBoundingClientRect();
  const [right, down] = view.toScreen(x, y);
  return [left + right, top + down];
}"""


def chromium() -> str | None:
    """The browser to test with: $EGOTOUCH_CHROMIUM, or the system's."""
    return os.environ.get("EGOTOUCH_CHROMIUM") or next((path for name in _NAMES if (path := shutil.which(name))), None)


class ServerProcess:
    """`egotouch simulate` as a user starts it, on a port that stays the same over restarts."""

    def __init__(self, *arguments: str) -> None:
        self._arguments = arguments
        self._port = "0"
        self._process: subprocess.Popen[str] | None = None
        self.url = ""

    def start(self) -> None:
        """Start and wait for the address that it prints."""
        command = [sys.executable, "-m", "egotouch_sdk.cli.main", "simulate", "--no-browser", "--port", self._port, *self._arguments]
        # A loaded machine may hold the server up for longer than a camera may stall.
        environment = os.environ | {"EGOTOUCH_STATE__STALL_MS": "5000"}
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if "http://" in line:
                self.url = "http://" + line.partition("http://")[2].split("/")[0] + "/"
                break
        assert self.url, "the server ended without saying where it listens"
        self._port = self.url.rstrip("/").rpartition(":")[2]

    def kill(self) -> None:
        """End it without a word, as a crash would."""
        self.send(signal.SIGKILL)
        if self._process:
            self._process.wait(PATIENCE_S)
            assert self._process.stdout is not None
            self._process.stdout.close()
        self._process = None

    def send(self, signal_number: signal.Signals) -> None:
        """Send a signal to the process, where there is one."""
        if self._process and self._process.poll() is None:
            self._process.send_signal(signal_number)


class Listener:
    """A client without a browser."""

    def __init__(self, connection: ClientConnection, *types: str) -> None:
        self._connection = connection
        self._heard: list[dict[str, Any]] = []
        # Late edges come too: on a loaded machine every edge may be late.
        subscribe = {"types": [f"EVENT_TYPE_{name}" for name in types], "late_edges": True}
        connection.send(json.dumps({"hello": {"client": "listener", "subscribe": subscribe}}))
        assert "welcome" in self._receive()

    def hear(self, *types: str) -> list[dict[str, Any]]:
        """Exactly these events come next."""
        heard = self.take(len(types))
        assert [_plain(event["type"]) for event in heard] == list(types), heard
        return heard

    def take(self, count: int) -> list[dict[str, Any]]:
        """The next events, whatever they are."""
        deadline_s = monotonic() + PATIENCE_S
        while len(self._heard) < count:
            assert monotonic() < deadline_s, f"waited for {count} events, heard {self._names()}"
            self._heard += self._receive().get("batch", {}).get("events", [])
        taken, self._heard = self._heard[:count], self._heard[count:]
        return taken

    def hear_nothing(self) -> None:
        """Nothing more has come, up to what the server sent before its answer to this question."""
        self._connection.send(json.dumps({"clock_request": {}}))
        while "clock_reply" not in (message := self._receive()):
            self._heard += message.get("batch", {}).get("events", [])
        assert self._names() == []

    def _names(self) -> list[str]:
        return [_plain(event["type"]) for event in self._heard]

    def _receive(self) -> dict[str, Any]:
        message: dict[str, Any] = json.loads(self._connection.recv(PATIENCE_S))
        return message


@contextmanager
def listening(url: str, *types: str) -> Iterator[Listener]:
    """A second client, which hears events of these types."""
    with connect(f"{url.replace('http', 'ws', 1)}ws", subprotocols=[Subprotocol("egotouch.v1.json")]) as connection:
        yield Listener(connection, *types)


def _plain(name: str) -> str:
    return name.removeprefix("EVENT_TYPE_")


class PlayedPage:
    """The simulator's page with hands on it: places are host-frame millimetres on the drawn limb."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self._devtools = page.context.new_cdp_session(page)

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Where a place of the limb is in the window."""
        x, y = self.page.evaluate(_TO_SCREEN, [x_mm, y_mm])
        return float(x), float(y)

    def hover(self, x_mm: float, y_mm: float, *, steps: int = 1) -> None:
        """Move the mouse to a place of the limb."""
        self.page.mouse.move(*self.place(x_mm, y_mm), steps=steps)

    def press(self) -> None:
        """Press the mouse."""
        self.page.mouse.down()

    def lift(self) -> None:
        """Release the mouse."""
        self.page.mouse.up()

    def leave(self) -> None:
        """Take the mouse off the limb."""
        self.page.mouse.move(2, 2)

    def touch(self, *places: tuple[float, float]) -> None:
        """Put a finger of a touch screen on each of these places, or lift all when there are none."""
        points = [dict(zip("xy", self.place(*place), strict=True), id=number) for number, place in enumerate(places)]
        self._devtools.send("Input.dispatchTouchEvent", {"type": "touchStart" if points else "touchEnd", "touchPoints": points})

    def use_pen(self, kind: str, x_mm: float, y_mm: float, **pen: float) -> None:
        """A pen's event at a place: "mousePressed", "mouseMoved" or "mouseReleased", as the DevTools protocol names them."""
        x, y = self.place(x_mm, y_mm)
        event = {"type": kind, "x": x, "y": y, "pointerType": "pen", "button": "left", "buttons": int(kind != "mouseReleased"), **pen}
        self._devtools.send("Input.dispatchMouseEvent", event)

    def set_slider(self, name: str, value: float) -> None:
        """Move a slider."""
        self.page.locator(f"#{name}").fill(str(value))

    def expect_state(self, state: str) -> None:
        """Wait for a connection state."""
        self.page.locator(f"#pill[data-state={state}]").wait_for(timeout=PATIENCE_S * 1000)

    def wait_until(self, condition: str) -> None:
        """Wait for a condition in JavaScript. (Playwright's own way needs `eval` in the page, which its security policy forbids.)"""
        deadline_s = monotonic() + PATIENCE_S
        while not self.page.evaluate(condition):
            assert monotonic() < deadline_s, condition
            self.page.wait_for_timeout(20)

    @property
    def contacts(self) -> int:
        """Contacts that are down on this page."""
        return int(self.page.evaluate("egotouch.client.contacts"))

    @property
    def log(self) -> list[str]:
        """The event log's types, oldest first."""
        return list(reversed(self.page.locator("#log li .what").all_inner_texts()))


@contextmanager
def open_page(browser: Browser, url: str, *, phone: bool = False) -> Iterator[PlayedPage]:
    """A page in a profile of its own that is live; any error in it fails the test."""
    with loaded_page(browser, url, phone=phone) as page:
        page.expect_state("live")
        yield page


@contextmanager
def loaded_page(browser: Browser, url: str, *, phone: bool = False) -> Iterator[PlayedPage]:
    """The same, whatever state it is in."""
    context = browser.new_context(
        viewport=PHONE if phone else DESKTOP, device_scale_factor=2 if phone else 1, has_touch=phone, is_mobile=phone
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(url)
    yield PlayedPage(page)
    context.close()
    assert errors == []
