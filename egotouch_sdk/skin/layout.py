"""A whole layout of skin views."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.skin.keypad import SkinKeypad
from egotouch_sdk.skin.views import SkinView

SkinItem = SkinView | SkinKeypad


@dataclass(frozen=True, slots=True)
class SkinLayout:
    """Views and keypads, the later ones on top of the earlier ones.

    Raises `LayoutError` when two of them have the same name.
    """

    items: tuple[SkinItem, ...]

    def __post_init__(self) -> None:
        names = [item.name for item in self.items] + [b.name for item in self.items if isinstance(item, SkinKeypad) for b in item.buttons]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise LayoutError(f"the name {twice[0]} is used twice in a layout", hint="Give each view a name of its own")

    @property
    def views(self) -> tuple[SkinView, ...]:
        """Every view from bottom to top; keypads give their buttons."""
        return tuple(view for item in self.items for view in (item.buttons if isinstance(item, SkinKeypad) else (item,)))
