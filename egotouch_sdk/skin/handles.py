"""Where an app registers what its views do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from egotouch_sdk.listeners.listeners import EventRegistrar, Registrar
from egotouch_sdk.listeners.registry import Registry
from egotouch_sdk.skin.calling import call_listeners
from egotouch_sdk.skin.keypad import SkinKeypad
from egotouch_sdk.skin.snapshot import SkinSnapshot, ViewSnapshot
from egotouch_sdk.skin.views import SkinSlider, SkinView
from egotouch_sdk.touch_event import TouchEvent

ReadSnapshot = Callable[[], SkinSnapshot]


@dataclass(frozen=True, slots=True)
class SliderChange:
    """A slider has a new `value`, 0..1, because of `event` (a DOWN or a MOVE)."""

    slider: SkinSlider
    value: float
    event: TouchEvent


@dataclass(frozen=True, slots=True)
class KeyPress:
    """A key of a keypad was pressed: `event` is the UP that ended it, or the LONG_CLICK."""

    keypad: SkinKeypad
    key: str
    event: TouchEvent


class ViewHandle:
    """A view in a group: its listeners and how it looks now.

    Listeners are added as `@handle.onClick`, `@handle.onClick(finger="index")` or `handle.onClick(function)`, and get a `TouchEvent`;
    what that gives has `remove()`. In order of calling:

    - `onHoverEnter`, `onHoverMove`, `onHoverExit`: a finger is above the view; it exits before it presses.
    - `onTouchDown`: the finger has captured the view, which gets all of its contact from now on, wherever the finger goes.
    - `onTouchMove`, `onDragStart`, `onDrag`, `onDragEnd`, `onForce`.
    - `onLongClick`: the finger rests inside; return True to keep this contact from clicking.
    - `onTouchUp`, then `onClick` with the same event when the finger was lifted inside the view or its slop; or `onTouchCancel`,
      which never clicks.
    """

    def __init__(self, view: SkinView, read: ReadSnapshot) -> None:
        self.view = view
        self._read = read
        self.registry = registry = Registry()
        self.onHoverEnter = EventRegistrar[object](registry, "onHoverEnter")
        self.onHoverMove = EventRegistrar[object](registry, "onHoverMove")
        self.onHoverExit = EventRegistrar[object](registry, "onHoverExit")
        self.onTouchDown = EventRegistrar[object](registry, "onTouchDown")
        self.onTouchMove = EventRegistrar[object](registry, "onTouchMove")
        self.onTouchUp = EventRegistrar[object](registry, "onTouchUp")
        self.onTouchCancel = EventRegistrar[object](registry, "onTouchCancel")
        self.onDragStart = EventRegistrar[object](registry, "onDragStart")
        self.onDrag = EventRegistrar[object](registry, "onDrag")
        self.onDragEnd = EventRegistrar[object](registry, "onDragEnd")
        self.onForce = EventRegistrar[object](registry, "onForce")
        self.onLongClick = EventRegistrar[bool | None](registry, "onLongClick")
        self.onClick = EventRegistrar[object](registry, "onClick")

    @property
    def look(self) -> ViewSnapshot:
        """All of the below at once, from one moment."""
        return self._read().view(self.view.name)

    @property
    def is_hovered(self) -> bool:
        """True while a finger is above the view."""
        return self.look.is_hovered

    @property
    def is_pressed(self) -> bool:
        """True while the finger that has captured the view is inside it or its slop."""
        return self.look.is_pressed

    @property
    def force_n(self) -> float:
        """Force of the pressing finger in newtons, 0 when the view is not pressed."""
        return self.look.force_n


class SliderHandle(ViewHandle):
    """A slider in a group; `@handle.onChange` gets a `SliderChange` after each event that changes the value."""

    def __init__(self, slider: SkinSlider, read: ReadSnapshot) -> None:
        super().__init__(slider, read)
        self.slider = slider
        self.onChange = Registrar[SliderChange](self.registry, "onChange")

    @property
    def value(self) -> float:
        """The slider's value, 0..1."""
        value = self.look.value
        assert value is not None, "a slider's snapshot has a value"
        return value


class KeypadHandle:
    """A keypad in a group; its listeners get a `KeyPress`.

    `@handle.onKey` is called for a click of any key, `@handle.onLongKey` for a long click; return True from that to keep the
    contact from becoming an `onKey`. The keys themselves are views of the group: `group.view("pad/5")`, or `handle.keys["5"]`.
    """

    def __init__(self, keypad: SkinKeypad, keys: Mapping[str, ViewHandle]) -> None:
        self.keypad = keypad
        self.keys = keys
        self._registry = Registry()
        self.onKey = Registrar[KeyPress](self._registry, "onKey")
        self.onLongKey = Registrar[KeyPress](self._registry, "onLongKey")
        for key, handle in keys.items():
            handle.onClick(self._relay("onKey", key))
            handle.onLongClick(self._relay("onLongKey", key))

    def _relay(self, name: str, key: str) -> Callable[[TouchEvent], bool]:
        def relay(event: TouchEvent) -> bool:
            return call_listeners(self._registry, name, KeyPress(self.keypad, key, event), event)

        return relay
