"""What to draw: the views and fingers of one moment as plain data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.skin.region import Region
from egotouch_sdk.surface import Surface


@dataclass(frozen=True, slots=True)
class ViewSnapshot:
    """How one view looks: `force_n` is that of the finger pressing it, 0 otherwise; `value` is None for all but sliders."""

    name: str
    text: str
    region: Region
    is_hovered: bool = False
    is_pressed: bool = False
    force_n: float = 0.0
    value: float | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields."""
        region = {"surface": self.region.surface, "host": self.region.host, "points_mm": [list(p) for p in self.region.points_mm]}
        return {
            "name": self.name,
            "text": self.text,
            "region": region,
            "is_hovered": self.is_hovered,
            "is_pressed": self.is_pressed,
            "force_n": self.force_n,
            "value": self.value,
        }


@dataclass(frozen=True, slots=True)
class FingerSnapshot:
    """Where a finger is in the host frame of the limb it hovers over or touches."""

    pointer_id: int
    finger: Finger
    host: Handedness
    surface: Surface
    x_mm: float
    y_mm: float
    force_n: float
    is_touching: bool

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields."""
        return {name: getattr(self, name) for name in self.__slots__}


@dataclass(frozen=True, slots=True)
class SkinSnapshot:
    """All views from bottom to top and all fingers, as of the capture time `timestamp_ns` (0 before the first event)."""

    timestamp_ns: int
    views: tuple[ViewSnapshot, ...]
    fingers: tuple[FingerSnapshot, ...] = ()

    def view(self, name: str) -> ViewSnapshot:
        """The view of that name; `KeyError` when there is none."""
        try:
            return next(view for view in self.views if view.name == name)
        except StopIteration:
            raise KeyError(name) from None

    def to_dict(self) -> dict[str, Any]:
        """Plain JSON-ready fields."""
        return {
            "timestamp_ns": self.timestamp_ns,
            "views": [view.to_dict() for view in self.views],
            "fingers": [finger.to_dict() for finger in self.fingers],
        }
