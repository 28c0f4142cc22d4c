"""The registration half of the façade: decorators, calls and listener objects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Protocol, TypeVar, overload, runtime_checkable

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.listeners.error_event import ErrorEvent
from egotouch_sdk.listeners.filters import EventFilter, FingerFilter, HandFilter, SurfaceFilter
from egotouch_sdk.listeners.registry import FunctionSubscription, Registry, Subscription
from egotouch_sdk.listeners.touch_listener import ERROR_METHOD, LISTENER_NAMES, TRACKING_METHOD, TouchListener
from egotouch_sdk.listeners.tracking import TrackingState
from egotouch_sdk.touch_event import TouchEvent

EventT = TypeVar("EventT")
ResultT = TypeVar("ResultT")
Decorator = Callable[[Callable[[TouchEvent], ResultT]], FunctionSubscription[TouchEvent, ResultT]]

#: Name under which the single raw listener is kept.
RAW_METHOD = "onTouch"


@runtime_checkable
class OnTouchListener(Protocol):
    """An object that gets every DOWN, MOVE, UP and CANCEL."""

    def onTouch(self, event: TouchEvent, /) -> object:
        """Take one raw touch event; the result does not matter."""


class Registrar(Generic[EventT]):
    """Registers listeners of one name, as `@et.onError` or `et.onError(function)`."""

    def __init__(self, registry: Registry, name: str) -> None:
        self._registry = registry
        self._name = name

    def __call__(self, listener: Callable[[EventT], object], /) -> FunctionSubscription[EventT, object]:
        """Add a function that takes one argument."""
        return self._registry.add_function(self._name, listener)


class EventRegistrar(Generic[ResultT]):
    """Registers listeners of one name, as `@et.onClick`, `@et.onClick(finger="index")` or `et.onClick(function, surface="palm")`.

    `finger`, `hand` (the touching one) and `surface` each take one value or a collection, as enum members or their names.
    Gives a `FunctionSubscription`. Raises `ConfigError` for an unknown name, an empty collection, and what is no plain function.
    """

    def __init__(self, registry: Registry, name: str) -> None:
        self._registry = registry
        self._name = name

    @overload
    def __call__(
        self,
        listener: Callable[[TouchEvent], ResultT],
        /,
        *,
        finger: FingerFilter = None,
        hand: HandFilter = None,
        surface: SurfaceFilter = None,
    ) -> FunctionSubscription[TouchEvent, ResultT]: ...

    @overload
    def __call__(self, /, *, finger: FingerFilter = None, hand: HandFilter = None, surface: SurfaceFilter = None) -> Decorator[ResultT]: ...

    def __call__(
        self,
        listener: Callable[[TouchEvent], ResultT] | None = None,
        /,
        *,
        finger: FingerFilter = None,
        hand: HandFilter = None,
        surface: SurfaceFilter = None,
    ) -> FunctionSubscription[TouchEvent, ResultT] | Decorator[ResultT]:
        """Add a function that takes a `TouchEvent`, or give a decorator that does."""
        wants = EventFilter.of(finger, hand, surface)

        def register(function: Callable[[TouchEvent], ResultT]) -> FunctionSubscription[TouchEvent, ResultT]:
            return self._registry.add_function(self._name, function, wants)

        return register if listener is None else register(listener)


class Listeners:
    """Listener registration by name; `TouchListener` says when each is called."""

    def __init__(self) -> None:
        self._registry = registry = Registry()
        self._raw: Subscription | None = None
        self.onTouchDown = EventRegistrar[object](registry, "onTouchDown")
        self.onTouchUp = EventRegistrar[object](registry, "onTouchUp")
        self.onTouchMove = EventRegistrar[object](registry, "onTouchMove")
        self.onTouchCancel = EventRegistrar[object](registry, "onTouchCancel")
        self.onDragStart = EventRegistrar[object](registry, "onDragStart")
        self.onDrag = EventRegistrar[object](registry, "onDrag")
        self.onDragEnd = EventRegistrar[object](registry, "onDragEnd")
        self.onClick = EventRegistrar[object](registry, "onClick")
        self.onDoubleClick = EventRegistrar[object](registry, "onDoubleClick")
        self.onLongClick = EventRegistrar[bool | None](registry, "onLongClick")
        self.onForce = EventRegistrar[object](registry, "onForce")
        self.onFling = EventRegistrar[object](registry, "onFling")
        self.onHoverEnter = EventRegistrar[object](registry, "onHoverEnter")
        self.onHoverMove = EventRegistrar[object](registry, "onHoverMove")
        self.onHoverExit = EventRegistrar[object](registry, "onHoverExit")
        self.onTrackingChanged = Registrar[TrackingState](registry, TRACKING_METHOD)
        self.onError = Registrar[ErrorEvent](registry, ERROR_METHOD)

    def addListener(
        self, listener: TouchListener, *, finger: FingerFilter = None, hand: HandFilter = None, surface: SurfaceFilter = None
    ) -> Subscription:
        """Add every method that `listener` overrides; the filters do not concern `onTrackingChanged` and `onError`.

        Raises `ConfigError` when `listener` is no `TouchListener` object.
        """
        if not isinstance(listener, TouchListener):
            hint = f"Make an object of it: {listener.__name__}()" if isinstance(listener, type) else "Derive its class from TouchListener"
            raise ConfigError(f"addListener got {listener!r}, which is no TouchListener object", hint=hint)
        methods: dict[str, Callable[[Any], object]] = {
            name: getattr(listener, name) for name in LISTENER_NAMES if getattr(type(listener), name) is not getattr(TouchListener, name)
        }
        subscription = Subscription(self._registry)
        self._registry.add(methods, EventFilter.of(finger, hand, surface), subscription)
        return subscription

    def setOnTouchListener(self, listener: OnTouchListener | Callable[[TouchEvent], object] | None) -> None:
        """Let one function, or one object with `onTouch(event)`, get every DOWN, MOVE, UP and CANCEL before all other listeners.

        Replaces the one set before; None removes it.
        """
        call = listener.onTouch if isinstance(listener, OnTouchListener) else listener
        new = None if call is None else self._registry.add_function(RAW_METHOD, call)
        if self._raw is not None:
            self._raw.remove()
        self._raw = new
