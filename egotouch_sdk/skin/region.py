"""A patch of skin: a polygon in millimetres on one surface of a host limb."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import polygon
from egotouch_sdk.skin.polygon import Point
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import TouchEvent


def is_inner_side(surface: Surface) -> bool:
    """True for the palm and the inner forearm, which continue one another beyond the wrist; False for the other two."""
    return surface in (Surface.PALM, Surface.INNER_FOREARM)


@dataclass(frozen=True, slots=True)
class Region:
    """Skin inside a polygon of the host frame: origin wrist, +y to the middle MCP, +x to the thumb side.

    `points_mm` are its corners (x_mm, y_mm) in order, 3 to 256 of them, either way round; the outline must not cross or touch
    itself. Because +x is the thumb side, one region lies on mirrored skin of the left and of the right hand; `host` keeps it to
    one hand, None to both. Millimetres are those of the usual hand (83 mm from wrist to middle MCP) unless
    `TouchConfig.host.palm_mm` gives the wearer's own, so that a layout grows with the hand.
    Raises `LayoutError` for an outline that is empty, crosses itself, or is not made of finite numbers.
    """

    surface: Surface
    points_mm: tuple[Point, ...]
    host: Handedness | None = None

    def __post_init__(self) -> None:
        points = tuple((float(x), float(y)) for x, y in self.points_mm)
        object.__setattr__(self, "points_mm", points)
        if not 3 <= len(points) <= polygon.MAX_CORNERS:
            raise LayoutError(f"a region has {len(points)} corners", hint=f"Give 3 to {polygon.MAX_CORNERS} points (x_mm, y_mm)")
        if not all(abs(value) <= polygon.MAX_MM for point in points for value in point):
            raise LayoutError(f"a region has a corner on no limb: {points}", hint="Give millimetres in the host frame")
        if abs(polygon.signed_area(points)) < polygon.MIN_AREA_MM2:
            raise LayoutError(f"a region is empty: {points}", hint="Its corners must enclose at least 1 mm² of skin, in order")
        if polygon.crosses_itself(points):
            raise LayoutError(f"the outline of a region crosses or touches itself: {points}", hint="Give the corners in order around it")

    @classmethod
    def rectangle(
        cls, surface: Surface, x_mm: float, y_mm: float, width_mm: float, height_mm: float, *, host: Handedness | None = None
    ) -> Region:
        """A rectangle around the centre (x_mm, y_mm); the width runs across the limb, the height along it."""
        _require_positive(width_mm=width_mm, height_mm=height_mm)
        return cls(surface, polygon.rectangle(x_mm, y_mm, width_mm, height_mm), host)

    @classmethod
    def circle(cls, surface: Surface, x_mm: float, y_mm: float, radius_mm: float, *, host: Handedness | None = None) -> Region:
        """A circle, as a polygon of 32 corners on it; at most 0.5 % of the radius is cut off."""
        _require_positive(radius_mm=radius_mm)
        return cls(surface, polygon.circle(x_mm, y_mm, radius_mm), host)

    @classmethod
    def rounded(
        cls,
        surface: Surface,
        x_mm: float,
        y_mm: float,
        width_mm: float,
        height_mm: float,
        corner_mm: float,
        *,
        host: Handedness | None = None,
    ) -> Region:
        """A rectangle with round corners; `corner_mm` is at most half of the shorter side."""
        _require_positive(width_mm=width_mm, height_mm=height_mm, corner_mm=corner_mm)
        if corner_mm > min(width_mm, height_mm) / 2:
            raise LayoutError(
                f"corner_mm={corner_mm} does not fit a region of {width_mm} x {height_mm} mm", hint="Take at most half of the shorter side"
            )
        return cls(surface, polygon.rounded(x_mm, y_mm, width_mm, height_mm, corner_mm), host)

    def contains(self, x_mm: float, y_mm: float, slop_mm: float = 0.0) -> bool:
        """True inside the region grown by `slop_mm` on all sides; its outline belongs to it."""
        return polygon.contains(self.points_mm, x_mm, y_mm) or polygon.outline_distance_mm(self.points_mm, x_mm, y_mm) <= slop_mm

    def is_hit(self, event: TouchEvent) -> bool:
        """True when a touch lies inside: right limb, right surface, right place."""
        return event.surface is self.surface and self._is_on_limb(event) and self.contains(event.x_mm, event.y_mm)

    def is_kept(self, event: TouchEvent, slop_mm: float) -> bool:
        """True when a finger that was inside still counts as inside: within `slop_mm`, and on this side of the limb.

        The wrist is no border then: the palm continues in the inner forearm, the back of the hand in the outer one.
        """
        return self.is_beside(event) and self.contains(event.x_mm, event.y_mm, slop_mm)

    def is_beside(self, event: TouchEvent) -> bool:
        """True when a touch lies on this side of this limb, so that its place can be compared with the region."""
        return is_inner_side(event.surface) == is_inner_side(self.surface) and self._is_on_limb(event)

    @property
    def bounds_mm(self) -> tuple[float, float, float, float]:
        """(min x, min y, max x, max y)."""
        xs, ys = zip(*self.points_mm, strict=True)
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def centre_mm(self) -> Point:
        """The middle of `bounds_mm`."""
        x0, y0, x1, y1 = self.bounds_mm
        return (x0 + x1) / 2, (y0 + y1) / 2

    def _is_on_limb(self, event: TouchEvent) -> bool:
        return self.host is None or event.host_hand is self.host


def _require_positive(**lengths_mm: float) -> None:
    for name, value in lengths_mm.items():
        if not (isfinite(value) and value > 0):
            raise LayoutError(f"{name}={value} is no length", hint="Give millimetres above 0")
