"""How fingers move: smoothly, as people reach."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate, pairwise
from math import dist

Point = tuple[float, float]


def minimum_jerk(share: float) -> float:
    """How far a movement has come after this share of its time, both 0..1 (Flash & Hogan 1985); held at its ends outside."""
    share = min(max(share, 0.0), 1.0)
    return share**3 * (10.0 + share * (6.0 * share - 15.0))


def speeding_up(share: float) -> float:
    """The first half of a minimum-jerk movement, stretched to 0..1: it ends at its highest speed."""
    return 2.0 * minimum_jerk(min(max(share, 0.0), 1.0) / 2.0)


def along(path: tuple[Point, ...], share: float) -> Point:
    """The point after this share of the way along straight lines between the points of `path`; beyond 1 straight on."""
    ways = [0.0, *accumulate(dist(a, b) for a, b in pairwise(path))]
    if ways[-1] == 0.0:
        return path[0]
    way = max(share, 0.0) * ways[-1]
    leg = min(bisect_right(ways, way, 1, len(ways) - 1), len(path) - 1)
    while ways[leg] == ways[leg - 1]:
        leg -= 1
    part = (way - ways[leg - 1]) / (ways[leg] - ways[leg - 1])
    (x0, y0), (x1, y1) = path[leg - 1], path[leg]
    return x0 + part * (x1 - x0), y0 + part * (y1 - y0)
