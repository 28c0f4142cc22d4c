"""Who listens to what."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from threading import Lock
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.listeners.filters import EventFilter

EventT = TypeVar("EventT")
ResultT = TypeVar("ResultT")
CallableT = TypeVar("CallableT", bound=Callable[[Any], object])

EVERYTHING = EventFilter()

#: `inspect.CO_COROUTINE`, without the cost of importing inspect.
_COROUTINE_FLAG = 0x80


@dataclass(frozen=True, slots=True, eq=False)
class Handler:
    """One function that gets the events of one listener name; `site` names it in logs and errors."""

    call: Callable[[Any], object]
    wants: EventFilter
    site: str
    subscription: Subscription


class Subscription:
    """A registered listener; in a `with` block it ends with the block.

    `remove()` may be called from any thread, also by the listener itself, and more than once; no new call begins after it has returned.
    """

    def __init__(self, registry: Registry) -> None:
        self._registry = registry
        self._is_active = True

    @property
    def is_active(self) -> bool:
        """True until it is removed."""
        return self._is_active

    def remove(self) -> None:
        """Stop listening."""
        self._is_active = False
        self._registry.remove(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.remove()


class FunctionSubscription(Subscription, Generic[EventT, ResultT]):
    """What a decorated function becomes: its subscription, which is called like the function itself."""

    def __init__(self, registry: Registry, function: Callable[[EventT], ResultT]) -> None:
        super().__init__(registry)
        self.__wrapped__ = function
        self.__doc__ = function.__doc__

    def __call__(self, event: EventT, /) -> ResultT:
        """Call the function."""
        return self.__wrapped__(event)


class Registry:
    """The handlers of each listener name, in the order in which they were added; safe to change while events are delivered."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._handlers: Mapping[str, tuple[Handler, ...]] = {}

    def handlers(self, name: str) -> tuple[Handler, ...]:
        """Those that listen to `name` now."""
        return self._handlers.get(name, ())

    def add(self, methods: Mapping[str, Callable[[Any], object]], wants: EventFilter, subscription: Subscription) -> None:
        """Add one function for each listener name of `methods`, all under one subscription.

        Raises `ConfigError` for something that cannot be called, and for a coroutine function.
        """
        added = {name: Handler(_checked(name, call), wants, _site(name, call), subscription) for name, call in methods.items()}
        with self._lock:
            self._handlers = {
                **self._handlers,
                **{name: (*self._handlers.get(name, ()), handler) for name, handler in added.items()},
            }

    def add_function(
        self, name: str, function: Callable[[EventT], ResultT], wants: EventFilter = EVERYTHING
    ) -> FunctionSubscription[EventT, ResultT]:
        """Add one function for one listener name; raises as `add`."""
        subscription = FunctionSubscription(self, _checked(name, function))
        self.add({name: function}, wants, subscription)
        return subscription

    def remove(self, subscription: Subscription) -> None:
        """Forget a subscription; does nothing when it is gone already."""
        with self._lock:
            self._handlers = {
                name: tuple(handler for handler in handlers if handler.subscription is not subscription)
                for name, handlers in self._handlers.items()
            }


def _checked(name: str, call: CallableT) -> CallableT:
    if not callable(call):
        raise ConfigError(f"{name} got {call!r}, which cannot be called", hint="Give a function that takes one event")
    code = getattr(_plain(call), "__code__", None)
    if code is not None and code.co_flags & _COROUTINE_FLAG:
        raise ConfigError(f"{name} got the coroutine function {_name(call)}", hint="In asyncio use: async for event in et.events()")
    return call


def _site(name: str, call: Callable[[Any], object]) -> str:
    call = _plain(call)
    code = getattr(call, "__code__", None)
    where = f" ({code.co_filename}:{code.co_firstlineno})" if code is not None else ""
    return f"{name} of {_name(call)}{where}"


def _plain(call: Callable[[Any], object]) -> Callable[[Any], object]:
    """The function itself, where decorators are stacked on it."""
    while isinstance(call, FunctionSubscription):
        call = call.__wrapped__
    return call


def _name(call: Callable[[Any], object]) -> str:
    return getattr(call, "__qualname__", None) or type(call).__qualname__
