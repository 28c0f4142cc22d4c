"""A grid of keys whose labels read the right way for the wearer."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin.polygon import Point
from egotouch_sdk.skin.reading import USUAL_READING, Reading, ReadingAxes, reading_axes
from egotouch_sdk.skin.region import Region
from egotouch_sdk.skin.views import SLOP_MM, SkinButton
from egotouch_sdk.surface import Surface

#: Keys closer than this are refused: targets of 9.2 mm are the smallest that fingers hit reliably on glass (Parhi, Karlson and
#: Bederson, MobileHCI'06), plus the 3 mm that the host frame aims at (our choice). Bigger is better: OmniTouch (UIST'11) needed
#: 23 mm on hands, with a depth camera.
MIN_PITCH_MM = 12.0
#: Skin that a grid of keys may take: (across the limb, along it) in mm. Across the palm and the back 70 mm, the hand breadth of the
#: 5th percentile of British women (men's median 85 mm; anthropometric table of City University of Hong Kong); along them 83 mm, the
#: usual hand's wrist to middle MCP. Across the forearm 50 mm, what can be seen of it at once near the wrist, and along it 200 mm
#: (both our choice).
ROOM_MM: dict[Surface, tuple[float, float]] = {
    Surface.PALM: (70.0, 83.0),
    Surface.BACK_OF_HAND: (70.0, 83.0),
    Surface.INNER_FOREARM: (50.0, 200.0),
    Surface.OUTER_FOREARM: (50.0, 200.0),
}
#: A phone's keys on a hand: 3 x 4 keys of 15 mm, 45 x 60 mm of skin around the middle of the palm (our choice).
_HAND_KEYS = (("1", "2", "3"), ("4", "5", "6"), ("7", "8", "9"), ("*", "0", "#"))
#: The same keys on a forearm, which is long and narrow: 6 x 2 keys of 18 mm, 108 mm along the arm and 36 mm across (our choice).
_FOREARM_KEYS = (("1", "2", "3", "4", "5", "*"), ("6", "7", "8", "9", "0", "#"))


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinKeypad:
    """Keys in rows, the first row on top and each row from left to right as the wearer sees them.

    The host frame's +x is the thumb side, which the wearer sees on the left or on the right depending on hand and side; so a keypad
    belongs to one `host` hand and turns its rows by `reading` (None takes the usual one of the surface: fingers up for the hand,
    arm across the body for the forearm). `x_mm`, `y_mm` is its centre in the host frame. `pitch_mm` is the distance of the centres of
    neighbouring keys, at least 12 mm; `gap_mm` the skin between them. Each key is a `SkinButton` named `<keypad>/<key>`.
    Raises `LayoutError` when keys repeat, are too small, or do not fit the limb.
    """

    name: str
    surface: Surface
    host: Handedness
    rows: tuple[tuple[str, ...], ...]
    x_mm: float
    y_mm: float
    pitch_mm: float
    gap_mm: float = 2.0
    reading: Reading | None = None
    slop_mm: float = SLOP_MM

    def __post_init__(self) -> None:
        keys = [key for row in self.rows for key in row]
        if not self.name or not keys or not all(keys) or len(set(keys)) != len(keys):
            raise LayoutError(f"keypad {self.name!r} has the keys {self.rows}", hint="Give a name and rows of keys, each key once")
        if not all(map(isfinite, (self.x_mm, self.y_mm, self.pitch_mm, self.gap_mm))):
            raise LayoutError(f"keypad {self.name} has a measure that is no number", hint="Give millimetres")
        if self.pitch_mm < MIN_PITCH_MM or not 0 <= self.gap_mm <= self.pitch_mm / 2:
            raise LayoutError(
                f"keypad {self.name} has pitch_mm={self.pitch_mm}, gap_mm={self.gap_mm}",
                hint=f"Take a pitch of at least {MIN_PITCH_MM:g} mm and a gap of at most half of it",
            )
        self._check_room()

    @classmethod
    def phone(cls, name: str, surface: Surface, host: Handedness) -> SkinKeypad:
        """A phone's twelve keys: four rows of three on palm or back, two rows of six along the forearm."""
        if surface in (Surface.PALM, Surface.BACK_OF_HAND):
            return cls(name=name, surface=surface, host=host, rows=_HAND_KEYS, x_mm=-4.0, y_mm=46.0, pitch_mm=15.0)
        return cls(name=name, surface=surface, host=host, rows=_FOREARM_KEYS, x_mm=0.0, y_mm=-85.0, pitch_mm=18.0)

    @property
    def axes(self) -> ReadingAxes:
        """The wearer's right and up in the host frame."""
        return reading_axes(self.surface, self.host, self.reading or USUAL_READING[self.surface])

    @property
    def buttons(self) -> tuple[SkinButton, ...]:
        """One button for each key, in reading order."""
        return tuple(
            SkinButton(name=self.button_name(key), label=key, region=self._region(*place), slop_mm=self.slop_mm)
            for key, place in self._places().items()
        )

    def button_name(self, key: str) -> str:
        """The name of a key's button."""
        return f"{self.name}/{key}"

    def _places(self) -> dict[str, Point]:
        """Centre of each key in the host frame."""
        axes, places = self.axes, {}
        for r, row in enumerate(self.rows):
            for c, key in enumerate(row):
                dx, dy = axes.to_host((c - (len(row) - 1) / 2) * self.pitch_mm, ((len(self.rows) - 1) / 2 - r) * self.pitch_mm)
                places[key] = (self.x_mm + dx, self.y_mm + dy)
        return places

    def _region(self, x_mm: float, y_mm: float) -> Region:
        size_mm = self.pitch_mm - self.gap_mm
        return Region.rectangle(self.surface, x_mm, y_mm, size_mm, size_mm, host=self.host)

    def _check_room(self) -> None:
        xs, ys = zip(*self._places().values(), strict=True)
        across_mm, along_mm = max(xs) - min(xs) + self.pitch_mm, max(ys) - min(ys) + self.pitch_mm
        room_across_mm, room_along_mm = ROOM_MM[self.surface]
        if across_mm > room_across_mm or along_mm > room_along_mm:
            raise LayoutError(
                f"keypad {self.name} takes {across_mm:g} mm across and {along_mm:g} mm along the limb",
                hint=f"The {self.surface} has room for {room_across_mm:g} x {room_along_mm:g} mm: take fewer or smaller keys",
            )
        key_mm = (self.pitch_mm - self.gap_mm) / 2
        is_hand = self.surface in (Surface.PALM, Surface.BACK_OF_HAND)
        if (is_hand and min(ys) < key_mm) or (not is_hand and max(ys) > -key_mm):
            raise LayoutError(f"keypad {self.name} lies across the wrist", hint="y_mm is above 0 on the hand and below 0 on the forearm")
