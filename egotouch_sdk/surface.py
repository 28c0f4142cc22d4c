"""The parts of a host limb that can be touched."""

from __future__ import annotations

from enum import StrEnum


class Surface(StrEnum):
    """Which skin of the host limb lies under the finger; the forearm begins at the wrist's landmark."""

    PALM = "palm"
    BACK_OF_HAND = "back_of_hand"
    INNER_FOREARM = "inner_forearm"
    OUTER_FOREARM = "outer_forearm"


def surface_at(y_mm: float, *, palm_side: bool) -> Surface:
    """The surface at a place of a limb that shows its palm's side or its back; the forearm has `y_mm` below 0."""
    if y_mm < 0:
        return Surface.INNER_FOREARM if palm_side else Surface.OUTER_FOREARM
    return Surface.PALM if palm_side else Surface.BACK_OF_HAND
