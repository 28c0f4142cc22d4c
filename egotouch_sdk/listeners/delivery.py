"""How one event reaches its listeners, and what happens when one of them throws, is slow or consumes; no threads."""

from __future__ import annotations

import logging
from collections.abc import Callable

from egotouch_sdk.listeners.error_event import ErrorEvent
from egotouch_sdk.listeners.listeners import RAW_METHOD
from egotouch_sdk.listeners.registry import Handler, Registry
from egotouch_sdk.listeners.touch_listener import ERROR_METHOD, METHODS, TRACKING_METHOD
from egotouch_sdk.listeners.tracking import TrackingState
from egotouch_sdk.touch_event import EventType, TouchEvent

#: A listener that takes longer is named in the log: half a frame at 60 fps (our choice).
SLOW_MS = 8.0

Item = TouchEvent | TrackingState | ErrorEvent

_RAW = frozenset({EventType.DOWN, EventType.MOVE, EventType.UP, EventType.CANCEL})
_CLICKS = frozenset({EventType.CLICK, EventType.DOUBLE_CLICK})
_log = logging.getLogger("egotouch_sdk.listeners")


class Delivery:
    """Calls the listeners of one item after another; call it from one thread at a time.

    What a listener throws is counted in `errors`, logged once for each listener and handed to `onError`; what `onError` throws is only
    counted and logged. A contact whose `onLongClick` returned True reaches no listener as CLICK or DOUBLE_CLICK any more.
    """

    def __init__(self, registry: Registry, now_ns: Callable[[], int]) -> None:
        self.errors = 0
        self._registry = registry
        self._now_ns = now_ns
        self._consumed: dict[int, int] = {}
        self._logged: set[tuple[str, str]] = set()

    def deliver(self, item: Item) -> None:
        """Hand one item to everyone who listens; never raises."""
        if isinstance(item, TouchEvent):
            self._deliver_event(item)
        elif isinstance(item, TrackingState):
            self._call_all(TRACKING_METHOD, item)
        else:
            self._call_all(ERROR_METHOD, item)

    def _deliver_event(self, event: TouchEvent) -> None:
        if event.type in _RAW:
            self._call_all(RAW_METHOD, event)
        if event.type in _CLICKS and self._consumed.get(event.pointer_id) == event.contact_id:
            return
        results = self._call_all(METHODS[event.type], event)
        if event.type is EventType.LONG_CLICK and any(result is True for result in results):
            self._consumed[event.pointer_id] = event.contact_id
        elif event.type is EventType.HOVER_EXIT:
            self._consumed.pop(event.pointer_id, None)

    def _call_all(self, name: str, item: Item) -> list[object]:
        return [self._call(handler, item) for handler in self._registry.handlers(name) if _is_wanted(handler, item)]

    def _call(self, handler: Handler, item: Item) -> object:
        start_ns = self._now_ns()
        try:
            return handler.call(item)
        except BaseException as error:  # this thread must outlive whatever a listener does, sys.exit() included
            self._report(handler, item, error)
            return None
        finally:
            elapsed_ms = (self._now_ns() - start_ns) / 1e6
            if elapsed_ms > SLOW_MS and self._is_first("slow", handler):
                _log.warning("%s took %.1f ms; while it runs, moves are merged. Hand long work to a thread", handler.site, elapsed_ms)

    def _report(self, handler: Handler, item: Item, error: BaseException) -> None:
        self.errors += 1
        if self._is_first("error", handler):
            _log.error("%s has thrown; further errors of it are only counted", handler.site, exc_info=error)
        if not isinstance(item, ErrorEvent):
            self._call_all(ERROR_METHOD, ErrorEvent(error, handler.site, item))

    def _is_first(self, what: str, handler: Handler) -> bool:
        key = what, handler.site
        first = key not in self._logged
        self._logged.add(key)
        return first


def _is_wanted(handler: Handler, item: Item) -> bool:
    return handler.subscription.is_active and (not isinstance(item, TouchEvent) or handler.wants.accepts(item))
