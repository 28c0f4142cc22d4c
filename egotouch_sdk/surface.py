"""The parts of a host limb that can be touched."""

from __future__ import annotations

from enum import StrEnum


class Surface(StrEnum):
    """Which skin of the host limb lies under the finger; the forearm begins at the wrist's landmark."""

    PALM = "palm"
    BACK_OF_HAND = "back_of_hand"
    INNER_FOREARM = "inner_forearm"
    OUTER_FOREARM = "outer_forearm"
