"""How views call their listeners."""

from __future__ import annotations

from egotouch_sdk.listeners.registry import Registry
from egotouch_sdk.touch_event import TouchEvent


def call_listeners(registry: Registry, name: str, item: object, event: TouchEvent) -> bool:
    """Call all listeners of `name` that want `event` with `item`; True when one of them has returned True.

    One that throws does not keep the others from being called; what it threw is raised in the end, several in an `ExceptionGroup`.
    """
    results, errors = [], []
    for handler in registry.handlers(name):
        if not handler.wants.accepts(event):
            continue
        try:
            results.append(handler.call(item))
        except Exception as error:
            errors.append(error)
    raise_all(errors)
    return any(result is True for result in results)


def raise_all(errors: list[Exception]) -> None:
    """Raise nothing, the only error, or all of them as a group."""
    if len(errors) == 1:
        raise errors[0]
    if errors:
        raise ExceptionGroup("several listeners have thrown", errors)
