"""The live simulator as a source: observations at a steady rate of whatever is played."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from threading import Event, Lock
from types import TracebackType
from typing import Final, Self

from egotouch_sdk.clock import now_ns
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import FrameError, ProtocolError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.simulator.live import LiveSimulation
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedView
from egotouch_sdk.state import Thresholds
from egotouch_sdk.wire import enums
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: As fast as pages play (they send up to 75 times a second).
DEFAULT_FPS: Final = 60.0
#: pi and pi/2 grow by this much at most when they are rounded to float32.
_SLACK_RAD = 1e-6
#: Farther than any skin is from the wrist.
_FARTHEST_MM = 1000.0


class LiveSource:
    """Observes a `LiveSimulation` at `fps` by the clock, until it is closed.

    `play` and `leave` may be called from any thread. Ticks that come too late are left out, never made up for.
    """

    config: TouchConfig | None = None
    thresholds: Thresholds | None = None
    is_live = True
    frame_count: int | None = None

    def __init__(self, fps: float = DEFAULT_FPS, view: SimulatedView | None = None) -> None:
        view = view or SimulatedView()
        self.width_px: int = view.width_px
        self.height_px: int = view.height_px
        self.fps: float = fps
        self._simulation = LiveSimulation(view)
        self._lock = Lock()
        self._closed = Event()

    def play(self, player: object, message: pb.SimulatedPointers) -> None:
        """Take all fingers that one client plays now; raises `ProtocolError` for values that make no sense."""
        fingers = fingers_from_proto(message)
        with self._lock:
            self._simulation.play(player, fingers)

    def leave(self, player: object) -> None:
        """A client has gone; what it touched is cancelled."""
        with self._lock:
            self._simulation.leave(player)

    def __iter__(self) -> Iterator[FrameObservation]:
        """Yield an observation at every tick of the clock."""
        period_ns = round(1e9 / self.fps)
        due_ns = now_ns()
        while not self._closed.wait(max(due_ns - now_ns(), 0) / 1e9):
            with self._lock:
                observation = self._simulation.observe(now_ns())
            yield observation
            due_ns = max(due_ns + period_ns, now_ns())

    def close(self) -> None:
        """End the iteration; may be called twice, from any thread."""
        self._closed.set()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()


def fingers_from_proto(message: pb.SimulatedPointers) -> tuple[SimulatedFinger, ...]:
    """The fingers in a message; raises `ProtocolError` for values that are missing, unknown, out of range or contradict each other."""
    if any(max(abs(pointer.x_mm), abs(pointer.y_mm), abs(pointer.hover_mm)) > _FARTHEST_MM for pointer in message.pointers):
        raise ProtocolError(f"a simulated finger is over {_FARTHEST_MM:.0f} mm away")
    try:
        fingers = tuple(
            SimulatedFinger(
                surface=enums.SURFACES.member(pointer.surface),
                x_mm=pointer.x_mm,
                y_mm=pointer.y_mm,
                hover_mm=pointer.hover_mm,
                force_n=pointer.force_n,
                pitch_rad=_rounded_into(pointer.pitch_rad, 0.0, pi / 2),
                yaw_rad=_rounded_into(pointer.yaw_rad, -pi, pi),
                finger=enums.FINGERS.member(pointer.finger),
                hand=enums.HANDEDNESS.member(pointer.hand),
            )
            for pointer in message.pointers
        )
    except FrameError as error:
        raise ProtocolError(str(error)) from error
    if len({(finger.hand, finger.finger) for finger in fingers}) < len(fingers):
        raise ProtocolError("a simulated finger is given twice", hint="Give every finger of a hand once")
    return fingers


def _rounded_into(value_rad: float, low_rad: float, high_rad: float) -> float:
    """`value_rad` without the rounding of float32 beyond a bound; farther beyond it is left as it is."""
    nearest = min(max(value_rad, low_rad), high_rad)
    return nearest if abs(value_rad - nearest) <= _SLACK_RAD else value_rad
