"""Which way text reads on a limb, as its wearer sees it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin.polygon import Point
from egotouch_sdk.skin.region import is_inner_side
from egotouch_sdk.surface import Surface


class Reading(StrEnum):
    """How the wearer holds the limb to read it."""

    ACROSS = "across"  # fingers up or away, text runs across the limb: a palm held up like a phone
    ALONG = "along"  # arm across the body, text runs along the limb: a forearm held like a watch


#: The way each surface is usually held (our choice).
USUAL_READING: dict[Surface, Reading] = {
    Surface.PALM: Reading.ACROSS,
    Surface.BACK_OF_HAND: Reading.ACROSS,
    Surface.INNER_FOREARM: Reading.ALONG,
    Surface.OUTER_FOREARM: Reading.ALONG,
}


@dataclass(frozen=True, slots=True)
class ReadingAxes:
    """The wearer's `right` and `up` as unit vectors of the host frame."""

    right: Point
    up: Point

    def to_view(self, x_mm: float, y_mm: float) -> Point:
        """Host frame to the wearer's view: (millimetres to the right, millimetres up) of the wrist."""
        return x_mm * self.right[0] + y_mm * self.right[1], x_mm * self.up[0] + y_mm * self.up[1]

    def to_host(self, right_mm: float, up_mm: float) -> Point:
        """The wearer's view to the host frame; undoes `to_view`."""
        return right_mm * self.right[0] + up_mm * self.up[0], right_mm * self.right[1] + up_mm * self.up[1]


def reading_axes(surface: Surface, host: Handedness, reading: Reading) -> ReadingAxes:
    """Where right and up are on a limb for its wearer.

    Fingers up, a wearer sees the thumb of the left palm and of the right back on the left, that of the other two on the right
    (`+x` is the thumb side). With the arm across the body the left hand's fingers point right and the right hand's left.
    """
    thumb_is_right = (host is Handedness.RIGHT) == is_inner_side(surface)
    thumb = 1.0 if thumb_is_right else -1.0
    if reading is Reading.ACROSS:
        return ReadingAxes((thumb, 0.0), (0.0, 1.0))
    if host is Handedness.LEFT:
        return ReadingAxes((0.0, 1.0), (-thumb, 0.0))
    return ReadingAxes((0.0, -1.0), (thumb, 0.0))
