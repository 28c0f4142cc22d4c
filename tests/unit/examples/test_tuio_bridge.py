"""What a TUIO receiver sees, decoded by python-osc's own parser from real datagrams."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

from egotouch_sdk.joints import Handedness
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.events import make_event

osc_bundle = pytest.importorskip("pythonosc.osc_bundle")

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "tuio_bridge"


class Receiver:
    """A UDP socket and the rules of a TUIO 1.1 receiver."""

    def __init__(self) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.alive: tuple[int, ...] = ()
        self.sets: dict[int, tuple[float, ...]] = {}
        self.frames: list[int] = []
        self.ended: list[int] = []

    @property
    def port(self) -> int:
        return int(self.socket.getsockname()[1])

    def receive(self, timeout_s: float = 30.0) -> list[list[object]]:
        """The messages of the next bundle, taken in as a receiver does."""
        self.socket.settimeout(timeout_s)
        datagram = self.socket.recv(65536)
        assert osc_bundle.OscBundle.dgram_is_bundle(datagram)
        messages = list(osc_bundle.OscBundle(datagram))
        assert {message.address for message in messages} == {"/tuio/2Dcur"}
        arguments = [list(message.params) for message in messages]
        assert [args[0] for args in arguments if args[0] != "set"] == ["source", "alive", "fseq"]
        assert arguments[1][0] == "alive" and arguments[-1][0] == "fseq"
        alive = tuple(arguments[1][1:])
        for _, session, *values in arguments[2:-1]:
            assert session in alive, "set of a cursor that is not alive"
            assert session not in self.ended, "a session id came back"
            assert len(values) == 5 and 0 <= values[0] <= 1 and 0 <= values[1] <= 1
            self.sets[session] = tuple(values)
        assert all(session in self.sets for session in alive)
        self.ended += [session for session in self.alive if session not in alive]
        self.alive = alive
        frame = arguments[-1][1]
        if frame != -1:
            assert frame == (self.frames[-1] if self.frames else 0) + 1
            self.frames.append(frame)
        return arguments


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    receiver = Receiver()
    yield receiver
    receiver.socket.close()


@pytest.fixture
def tuio(monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    monkeypatch.syspath_prepend(str(EXAMPLE))
    yield import_module("tuio")
    for name in ("tuio", "app"):
        sys.modules.pop(name, None)


class Bridge:
    """Fingers over the palm screen, connected to a receiver by the example's own sender."""

    def __init__(self, tuio: ModuleType, receiver: Receiver, refresh_s: float = 3600.0) -> None:
        app = import_module("app")
        app.REFRESH_S = refresh_s
        self.receiver = receiver
        self.sender = app.TuioSender(tuio.TuioCursors(tuio.SCREENS[Surface.PALM]), ("127.0.0.1", receiver.port))
        self.time_ns = 0

    def send(self, event_type: EventType, x_mm: float, y_mm: float, **fields: object) -> TouchEvent:
        self.time_ns += 100_000_000
        event = make_event(event_type, self.time_ns, x_mm=x_mm, y_mm=y_mm, **fields)
        self.sender.onTouchDown(event)
        return event

    def expect_nothing_else(self) -> None:
        """Closing repeats what is left, and nothing came before that."""
        self.sender.close()
        assert self.receiver.receive()[-1] == ["fseq", -1]


@pytest.fixture
def bridge(tuio: ModuleType, receiver: Receiver) -> Bridge:
    return Bridge(tuio, receiver)


def test_a_touch_is_one_cursor_from_down_to_up(bridge: Bridge, receiver: Receiver) -> None:
    bridge.send(EventType.DOWN, -4, 46)
    assert receiver.receive() == [["source", "egotouch"], ["alive", 1], ["set", 1, 0.5, 0.5, 0, 0, 0], ["fseq", 1]]
    bridge.send(EventType.MOVE, -19, 63.5, velocity_x_mm_s=-30, velocity_y_mm_s=35)
    assert receiver.receive()[2] == ["set", 1, 0.75, 0.25, 0.5, -0.5, pytest.approx(0.5**0.5 / 0.1, rel=1e-6)]
    bridge.send(EventType.UP, -19, 63.5)
    assert receiver.receive() == [["source", "egotouch"], ["alive"], ["fseq", 3]]
    bridge.send(EventType.DOWN, -4, 46, contact_id=2)
    assert receiver.receive()[1] == ["alive", 2]
    bridge.send(EventType.UP, -4, 46, contact_id=2)
    receiver.receive()
    bridge.expect_nothing_else()


def test_a_lost_touch_leaves_nothing_alive(bridge: Bridge, receiver: Receiver) -> None:
    bridge.send(EventType.DOWN, -4, 46)
    bridge.send(EventType.CANCEL, -4, 46, reason=CancelReason.TRACKING_LOST)
    receiver.receive()
    receiver.receive()
    assert receiver.alive == () and receiver.ended == [1]
    bridge.expect_nothing_else()


def test_two_fingers_are_two_cursors(bridge: Bridge, receiver: Receiver) -> None:
    bridge.send(EventType.DOWN, -4, 46)
    bridge.send(EventType.DOWN, 6, 46, pointer_id=2)
    bridge.send(EventType.UP, -4, 46)
    assert [receiver.receive()[1] for _ in range(3)] == [["alive", 1], ["alive", 1, 2], ["alive", 2]]
    bridge.send(EventType.UP, 6, 46, pointer_id=2)
    receiver.receive()
    bridge.expect_nothing_else()


def test_hovers_gestures_and_touches_beside_the_screen_are_not_sent(bridge: Bridge) -> None:
    bridge.send(EventType.HOVER_ENTER, -4, 46)
    bridge.send(EventType.HOVER_MOVE, -4, 46)
    bridge.send(EventType.DOWN, 80, 46)
    bridge.send(EventType.MOVE, -4, 46)
    bridge.send(EventType.CLICK, -4, 46)
    bridge.send(EventType.UP, -4, 46)
    bridge.send(EventType.DOWN, -4, 46, surface=Surface.BACK_OF_HAND)
    bridge.expect_nothing_else()


def test_beyond_the_edge_a_cursor_stays_at_the_edge_and_on_the_other_side_it_waits(bridge: Bridge, receiver: Receiver) -> None:
    bridge.send(EventType.DOWN, -4, 46)
    bridge.send(EventType.MOVE, -200, 0)
    bridge.send(EventType.MOVE, -4, 46, surface=Surface.BACK_OF_HAND)
    bridge.send(EventType.UP, -4, 46)
    receiver.receive()
    receiver.receive()
    assert receiver.sets[1][:2] == (1.0, 1.0)
    assert receiver.receive()[1] == ["alive"]
    bridge.expect_nothing_else()


def test_what_is_held_is_sent_again(tuio: ModuleType, receiver: Receiver) -> None:
    bridge = Bridge(tuio, receiver, refresh_s=1.0)
    bridge.send(EventType.DOWN, -4, 46)
    while not receiver.alive:
        receiver.receive()
    assert receiver.receive() == [["source", "egotouch"], ["alive", 1], ["set", 1, 0.5, 0.5, 0, 0, 0], ["fseq", -1]]
    bridge.sender.close()


@pytest.mark.parametrize("host", Handedness)
@pytest.mark.parametrize("surface", Surface)
def test_the_screen_is_upright_for_the_wearer_on_every_limb(tuio: ModuleType, surface: Surface, host: Handedness) -> None:
    screen = tuio.SCREENS[surface]
    right_mm, up_mm = screen.width_mm / 2, screen.height_mm / 2
    axes = screen.axes(host)
    for right, up, place in ((-1, 1, (0, 0)), (1, 1, (1, 0)), (1, -1, (1, 1)), (-1, -1, (0, 1))):
        dx, dy = axes.to_host(right * right_mm, up * up_mm)
        event = make_event(EventType.DOWN, hand=host.other, surface=surface, x_mm=screen.x_mm + dx, y_mm=screen.y_mm + dy)
        assert screen.place(event) == pytest.approx(place)
        assert screen.region(host).contains(event.x_mm, event.y_mm, slop_mm=1e-9)


@pytest.mark.parametrize("receiver", ["127.0.0.1:x", "127.0.0.1:99999", "no such host:3333"])
def test_a_wrong_receiver_is_named(receiver: str) -> None:
    command = [sys.executable, str(EXAMPLE / "app.py"), str(EXAMPLE / "touches.yaml"), "--to", receiver]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.returncode == 2
    assert f"{receiver} is no receiver" in done.stderr and "Traceback" not in done.stderr


def test_the_app_sends_what_simulated_fingers_do(receiver: Receiver) -> None:
    pytest.importorskip("yaml")
    command = [sys.executable, str(EXAMPLE / "app.py"), str(EXAMPLE / "touches.yaml"), "--fast", "--to", f"127.0.0.1:{receiver.port}"]
    app = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": str(ROOT)})
    first_x: list[float] = []
    most_alive = 0
    while True:
        try:
            receiver.receive(timeout_s=0.5)
        except TimeoutError:
            if app.poll() is not None:
                break
            continue
        most_alive = max(most_alive, len(receiver.alive))
        if receiver.alive == (1,):
            first_x.append(receiver.sets[1][0])
    assert app.stderr is not None
    with app.stderr:
        said = app.stderr.read()
    assert app.returncode == 0
    assert "has thrown" not in said and "Traceback" not in said  # on a busy machine it may say that a listener was slow
    assert first_x[0] < 0.25 and first_x[-1] > 0.75 and max(first_x) == pytest.approx(first_x[-1], abs=0.02)
    assert receiver.ended == [1, 3, 2, 4] and receiver.alive == ()
    assert most_alive == 2
