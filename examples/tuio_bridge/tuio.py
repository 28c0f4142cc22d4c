"""TUIO 1.1 cursors from touch events: pure logic, no sockets (https://www.tuio.org/?specification, profile 2Dcur)."""

from dataclasses import dataclass
from math import hypot

from egotouch_sdk import EventType, Handedness, Surface, TouchEvent
from egotouch_sdk.skin import ReadingAxes, Region, reading_axes
from egotouch_sdk.skin.reading import USUAL_READING

#: One OSC message: its arguments after the address, which is always this one.
ADDRESS = "/tuio/2Dcur"
Message = tuple[str | int | float, ...]
#: Frame number of bundles that repeat what was sent before, for receivers that have missed it.
REDUNDANT = -1


@dataclass(frozen=True)
class SkinScreen:
    """A rectangle of skin that stands for the receiver's screen, upright as the wearer sees it, on either hand.

    `width_mm` runs to the wearer's right and `height_mm` up around (`x_mm`, `y_mm`) of the host frame: with the fingers up on palm and
    back, and with the arm across the body on the forearm.
    """

    surface: Surface
    x_mm: float
    y_mm: float
    width_mm: float
    height_mm: float

    def place(self, event: TouchEvent) -> tuple[float, float]:
        """Where a touch is: (x, y), 0..1 from the top left; a touch beside the screen is at its edge."""
        right_mm, up_mm = self.axes(event.host_hand).to_view(event.x_mm - self.x_mm, event.y_mm - self.y_mm)
        return _clip(0.5 + right_mm / self.width_mm), _clip(0.5 - up_mm / self.height_mm)

    def velocity(self, event: TouchEvent) -> tuple[float, float]:
        """How fast it is, in screens per second to the right and down."""
        right_mm_s, up_mm_s = self.axes(event.host_hand).to_view(event.velocity_x_mm_s, event.velocity_y_mm_s)
        return right_mm_s / self.width_mm, -up_mm_s / self.height_mm

    def region(self, host: Handedness) -> Region:
        """The skin that it covers on one hand."""
        corners = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
        ways = (self.axes(host).to_host(right * self.width_mm, up * self.height_mm) for right, up in corners)
        return Region(self.surface, tuple((self.x_mm + dx, self.y_mm + dy) for dx, dy in ways), host)

    def axes(self, host: Handedness) -> ReadingAxes:
        """The wearer's right and up."""
        return reading_axes(self.surface, host, USUAL_READING[self.surface])


#: A screen for each surface, about as large as the skin that can be seen at once (our choice).
SCREENS = {
    Surface.PALM: SkinScreen(Surface.PALM, -4, 46, 60, 70),
    Surface.BACK_OF_HAND: SkinScreen(Surface.BACK_OF_HAND, -4, 46, 60, 70),
    Surface.INNER_FOREARM: SkinScreen(Surface.INNER_FOREARM, 0, -100, 150, 45),
    Surface.OUTER_FOREARM: SkinScreen(Surface.OUTER_FOREARM, 0, -100, 150, 45),
}


@dataclass(frozen=True)
class Cursor:
    """One touch as the receiver knows it: place 0..1, velocity in screens per second, acceleration in screens per second²."""

    session_id: int
    x: float
    y: float
    velocity_x: float
    velocity_y: float
    acceleration: float
    timestamp_ns: int


class TuioCursors:
    """Keeps the cursors of touches that began on the screen; hovering fingers and touches beside it are none.

    A touch keeps its cursor until UP or CANCEL, wherever it slides. Session ids count touches and are never used again.
    """

    def __init__(self, screen: SkinScreen) -> None:
        self._screen = screen
        self._regions = {host: screen.region(host) for host in Handedness}
        self._cursors: dict[int, Cursor] = {}
        self._sessions = 0
        self._frame = 0

    def feed(self, event: TouchEvent) -> list[Message]:
        """The messages of one bundle, or none when the event changes no cursor."""
        if event.type is EventType.DOWN and self._regions[event.host_hand].is_hit(event):
            self._sessions += 1
            cursor = Cursor(self._sessions, *self._screen.place(event), 0.0, 0.0, 0.0, event.timestamp_ns)
            self._cursors[event.pointer_id] = cursor
            return self._bundle([cursor])
        if event.pointer_id not in self._cursors:
            return []
        if event.type is EventType.MOVE:
            if not self._regions[event.host_hand].is_beside(event):
                return []  # it has slid to the other side of the limb, where there is no screen
            cursor = self._cursors[event.pointer_id] = self._moved(self._cursors[event.pointer_id], event)
            return self._bundle([cursor])
        if event.type in (EventType.UP, EventType.CANCEL):
            del self._cursors[event.pointer_id]
            return self._bundle([])
        return []

    def refresh(self) -> list[Message]:
        """Everything once more: UDP loses packets, and whoever has missed the last one must not hold a touch for ever."""
        return self._messages(list(self._cursors.values()), REDUNDANT)

    def _moved(self, before: Cursor, event: TouchEvent) -> Cursor:
        velocity_x, velocity_y = self._screen.velocity(event)
        seconds = (event.timestamp_ns - before.timestamp_ns) / 1e9
        faster = hypot(velocity_x, velocity_y) - hypot(before.velocity_x, before.velocity_y)
        acceleration = faster / seconds if seconds > 0 else 0.0
        return Cursor(before.session_id, *self._screen.place(event), velocity_x, velocity_y, acceleration, event.timestamp_ns)

    def _bundle(self, changed: list[Cursor]) -> list[Message]:
        self._frame += 1
        return self._messages(changed, self._frame)

    def _messages(self, changed: list[Cursor], frame: int) -> list[Message]:
        return [
            ("source", "egotouch"),
            ("alive", *(cursor.session_id for cursor in self._cursors.values())),
            *(("set", c.session_id, c.x, c.y, c.velocity_x, c.velocity_y, c.acceleration) for c in changed),
            ("fseq", frame),
        ]


def _clip(value: float) -> float:
    return min(max(value, 0.0), 1.0)
