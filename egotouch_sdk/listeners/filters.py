"""Which events a listener wants."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from difflib import get_close_matches
from enum import StrEnum
from typing import TypeVar

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import TouchEvent

EnumT = TypeVar("EnumT", bound=StrEnum)

#: One value or several, as enum members or their names.
FingerFilter = Finger | str | Collection[Finger | str] | None
HandFilter = Handedness | str | Collection[Handedness | str] | None
SurfaceFilter = Surface | str | Collection[Surface | str] | None


def members(kind: type[EnumT], given: str | Collection[str] | None, what: str) -> frozenset[EnumT] | None:
    """`given` as a set of enum members, None for all; raises `ConfigError` for an unknown name and for an empty collection."""
    if given is None:
        return None
    names = [given] if isinstance(given, str) else list(given)
    if not names:
        raise ConfigError(f"no {what} is wanted, so nothing would match", hint="Leave it out to get everything")
    return frozenset(member(kind, name, what) for name in names)


def member(kind: type[EnumT], name: str, what: str) -> EnumT:
    """The enum member that `name` is or names; raises `ConfigError` with the nearest one when there is none."""
    try:
        return kind(name)
    except ValueError:
        close = get_close_matches(str(name).lower(), [str(value) for value in kind], n=1)
        hint = f"Did you mean {close[0]}?" if close else f"There are: {', '.join(kind)}"
        raise ConfigError(f"there is no {what} {name!r}", hint=hint) from None


@dataclass(frozen=True, slots=True)
class EventFilter:
    """Lets an event through when its finger, touching hand and surface are each among those wanted; None wants all."""

    fingers: frozenset[Finger] | None = None
    hands: frozenset[Handedness] | None = None
    surfaces: frozenset[Surface] | None = None

    @classmethod
    def of(cls, finger: FingerFilter = None, hand: HandFilter = None, surface: SurfaceFilter = None) -> EventFilter:
        """The filter that keyword arguments describe; raises `ConfigError` for an unknown name."""
        return cls(members(Finger, finger, "finger"), members(Handedness, hand, "hand"), members(Surface, surface, "surface"))

    def accepts(self, event: TouchEvent) -> bool:
        """True when the event is wanted."""
        return (
            (self.fingers is None or event.finger in self.fingers)
            and (self.hands is None or event.hand in self.hands)
            and (self.surfaces is None or event.surface in self.surfaces)
        )
