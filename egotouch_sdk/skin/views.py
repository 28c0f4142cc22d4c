"""What can be put on skin: plain descriptions without behaviour or state."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, isfinite

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.skin.polygon import Point
from egotouch_sdk.skin.region import Region
from egotouch_sdk.touch_event import TouchEvent

#: A pressing finger may leave a view this far before it counts as outside: the SDK's own touch slop, since fingers that press in
#: place seem to move by up to 4.8 mm (our measurement). Android grows a pressed view by its touch slop, too (View.pointInView).
SLOP_MM = 5.0
#: Share of the slop by which a hovering finger may leave (Android: hover slop is half of the touch slop, ViewConfiguration).
HOVER_SHARE = 0.5
#: An axis shorter than this cannot be set with a fingertip (our choice).
MIN_AXIS_MM = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinView:
    """A region that can be touched.

    `name` is unique within a layout; `label` is what a renderer writes on it, the name when it is empty.
    `slop_mm` grows the region for a finger that was inside before, so that noise at the edge does not release it; half of it grows it
    for a hovering finger, so that the highlight does not flicker.
    Raises `LayoutError` for an empty name and a negative slop.
    """

    name: str
    region: Region
    label: str = ""
    slop_mm: float = SLOP_MM

    def __post_init__(self) -> None:
        if not self.name:
            raise LayoutError("a skin view has no name", hint="Give each view a name of its own")
        if not (isfinite(self.slop_mm) and self.slop_mm >= 0):
            raise LayoutError(f"slop_mm={self.slop_mm} of {self.name}", hint="Give 0 or more millimetres")

    @property
    def hover_slop_mm(self) -> float:
        """How far a hovering finger may leave before the highlight goes."""
        return self.slop_mm * HOVER_SHARE

    @property
    def text(self) -> str:
        """What to write on it."""
        return self.label or self.name


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinButton(SkinView):
    """A view to be pressed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinSlider(SkinView):
    """A view with a value from 0 at `start_mm` to 1 at `end_mm`, both (x_mm, y_mm) in the host frame.

    The value follows the finger's place along the straight line from start to end, from DOWN on, and stays at 0 or 1 beyond it.
    `step` is the distance of the values it can take, 1 over a whole number; 0 lets it take all. `value` is what it starts with.
    Raises `LayoutError` for an axis shorter than 10 mm and for a step or value out of range.
    """

    start_mm: Point
    end_mm: Point
    step: float = 0.0
    value: float = 0.0

    def __post_init__(self) -> None:
        super(SkinSlider, self).__post_init__()  # zero-argument super() loses its class in a dataclass with slots
        points = (*self.start_mm, *self.end_mm)
        if not all(map(isfinite, points)) or hypot(points[2] - points[0], points[3] - points[1]) < MIN_AXIS_MM:
            raise LayoutError(
                f"the axis of {self.name} runs from {self.start_mm} to {self.end_mm}", hint=f"Make it at least {MIN_AXIS_MM:g} mm long"
            )
        if not 0 <= self.step <= 1 or (self.step > 0 and abs(1 / self.step - round(1 / self.step)) > 1e-6):
            raise LayoutError(f"step={self.step} of {self.name}", hint="Give 0, or 1 over a whole number such as 0.1")
        if not 0 <= self.value <= 1:
            raise LayoutError(f"value={self.value} of {self.name}", hint="Give 0 to 1")

    def value_at(self, x_mm: float, y_mm: float) -> float:
        """The value 0..1 of a place in the host frame."""
        (x0, y0), (x1, y1) = self.start_mm, self.end_mm
        dx, dy = x1 - x0, y1 - y0
        return self.stepped(((x_mm - x0) * dx + (y_mm - y0) * dy) / (dx * dx + dy * dy))

    def stepped(self, value: float) -> float:
        """The nearest value that the slider can take."""
        value = min(max(value, 0.0), 1.0)
        if self.step == 0:
            return value
        steps = round(1 / self.step)
        return round(value * steps) / steps

    def value_for(self, event: TouchEvent) -> float | None:
        """The value that a finger sets; None when it has slid to another side of the limb."""
        return self.value_at(event.x_mm, event.y_mm) if self.region.is_beside(event) else None
