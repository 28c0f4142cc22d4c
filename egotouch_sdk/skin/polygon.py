"""Plane geometry of polygons: pure functions of points in millimetres."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import cos, hypot, pi, sin

Point = tuple[float, float]
Segment = tuple[Point, Point]

#: A polygon of less skin than this is taken for a mistake (our choice: 1 mm x 1 mm).
MIN_AREA_MM2 = 1.0
#: More corners than any shape on skin needs; it bounds the work of a hit test (our choice).
MAX_CORNERS = 256
#: No limb reaches farther from its wrist (our choice).
MAX_MM = 1000.0
#: Corners of a circle: its edges lie at most 0.5 % of the radius inside (1 - cos(pi / 32)).
CIRCLE_CORNERS = 32


def edges(points: Sequence[Point]) -> Iterator[Segment]:
    """The closed outline, one segment after the other."""
    yield from pairwise([*points, points[0]])


def signed_area(points: Sequence[Point]) -> float:
    """Area in mm², positive when the corners run from +x to +y."""
    return sum(ax * by - bx * ay for (ax, ay), (bx, by) in edges(points)) / 2


def contains(points: Sequence[Point], x_mm: float, y_mm: float) -> bool:
    """True inside the polygon, by the even-odd rule; points exactly on the outline may fall on either side."""
    inside = False
    for (ax, ay), (bx, by) in edges(points):
        if (ay > y_mm) != (by > y_mm) and x_mm < ax + (y_mm - ay) * (bx - ax) / (by - ay):
            inside = not inside
    return inside


def outline_distance_mm(points: Sequence[Point], x_mm: float, y_mm: float) -> float:
    """Distance to the nearest point of the outline, whichever side the point is on."""
    return min(_segment_distance(edge, x_mm, y_mm) for edge in edges(points))


def crosses_itself(points: Sequence[Point]) -> bool:
    """True when two edges meet anywhere but in the corner that neighbours share."""
    segments = list(edges(points))
    last = len(segments) - 1
    for i, first in enumerate(segments):
        for k in range(i + 1, len(segments)):
            if k - i == 1 or (i, k) == (0, last):
                if _folds_back(first, segments[k]):
                    return True
            elif _meet(first, segments[k]):
                return True
    return False


def rectangle(x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> tuple[Point, ...]:
    """Four corners around a centre; the width runs along x, the height along y."""
    w, h = width_mm / 2, height_mm / 2
    return ((x_mm - w, y_mm - h), (x_mm + w, y_mm - h), (x_mm + w, y_mm + h), (x_mm - w, y_mm + h))


def circle(x_mm: float, y_mm: float, radius_mm: float) -> tuple[Point, ...]:
    """A regular polygon whose corners lie on the circle."""
    return tuple(_on_circle(x_mm, y_mm, radius_mm, 2 * pi * k / CIRCLE_CORNERS) for k in range(CIRCLE_CORNERS))


def rounded(x_mm: float, y_mm: float, width_mm: float, height_mm: float, corner_mm: float) -> tuple[Point, ...]:
    """A rectangle whose corners are quarter circles of `corner_mm`, each drawn with as many edges as a quarter of a circle."""
    centres = rectangle(x_mm, y_mm, width_mm - 2 * corner_mm, height_mm - 2 * corner_mm)
    steps = CIRCLE_CORNERS // 4
    points = [
        _on_circle(cx, cy, corner_mm, pi + quarter * pi / 2 + step * pi / (2 * steps))
        for quarter, (cx, cy) in enumerate(centres)
        for step in range(steps + 1)
    ]
    return tuple(a for a, b in edges(points) if a != b)


def _on_circle(x_mm: float, y_mm: float, radius_mm: float, angle_rad: float) -> Point:
    return (x_mm + radius_mm * cos(angle_rad), y_mm + radius_mm * sin(angle_rad))


def _segment_distance(edge: Segment, x_mm: float, y_mm: float) -> float:
    (ax, ay), (bx, by) = edge
    dx, dy = bx - ax, by - ay
    squared = dx * dx + dy * dy
    share = 0.0 if squared == 0 else min(max(((x_mm - ax) * dx + (y_mm - ay) * dy) / squared, 0.0), 1.0)
    return hypot(x_mm - ax - share * dx, y_mm - ay - share * dy)


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _within_box(a: Point, b: Point, c: Point) -> bool:
    return min(a[0], b[0]) <= c[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])


def _meet(first: Segment, second: Segment) -> bool:
    (a, b), (c, d) = first, second
    c_side, d_side, a_side, b_side = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if c_side * d_side < 0 and a_side * b_side < 0:
        return True
    touching = ((c_side, a, b, c), (d_side, a, b, d), (a_side, c, d, a), (b_side, c, d, b))
    return any(side == 0 and _within_box(start, end, point) for side, start, end, point in touching)


def _folds_back(first: Segment, second: Segment) -> bool:
    """Neighbouring edges lie on top of each other, or one of them has no length."""
    shared = first[1] if first[1] == second[0] else first[0]
    a = first[0] if shared == first[1] else first[1]
    b = second[1] if shared == second[0] else second[0]
    if shared in (a, b):
        return True
    ahead = (a[0] - shared[0]) * (b[0] - shared[0]) + (a[1] - shared[1]) * (b[1] - shared[1])
    return _turn(shared, a, b) == 0 and ahead > 0
