"""The one thread that calls listeners."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from threading import Condition, Thread, current_thread

from egotouch_sdk.listeners.delivery import Item
from egotouch_sdk.listeners.error_event import ErrorEvent
from egotouch_sdk.listeners.queues import MergingQueue
from egotouch_sdk.listeners.tracking import TrackingState

#: More waiting items than this mean that a listener hangs: minutes of taps (our choice).
HANGING_ITEMS = 1000

_log = logging.getLogger("egotouch_sdk.listeners")


class Dispatcher:
    """Takes items from any thread and hands them to `deliver` on its own, in order, one at a time."""

    def __init__(self, deliver: Callable[[Item], None]) -> None:
        self._deliver = deliver
        self._queue: MergingQueue[TrackingState | ErrorEvent] = MergingQueue()
        self._changed = Condition()
        self._ending = False
        self._warned = False
        self._busy = False
        self._thread = Thread(target=self._run, name="egotouch-listeners", daemon=True)

    @property
    def merged(self) -> int:
        """Stream events that disappeared into newer ones so far, because listeners were slow."""
        return self._queue.merged

    @property
    def is_current_thread(self) -> bool:
        """True inside a listener."""
        return current_thread() is self._thread

    def start(self) -> None:
        """Start the thread; items posted before are delivered first."""
        self._thread.start()

    def post(self, items: Iterable[Item]) -> None:
        """Queue items; never waits for a listener. Does nothing after `stop()`."""
        with self._changed:
            if self._ending:
                return
            for item in items:
                self._queue.push(item)
            waiting, warned = len(self._queue), self._warned
            self._warned = warned or waiting > HANGING_ITEMS
            self._changed.notify_all()
        if waiting > HANGING_ITEMS and not warned:
            _log.error("%d events wait for a listener that does not return", waiting)

    def flush(self) -> None:
        """Wait until every item posted so far is delivered, or `stop()` is called."""
        with self._changed:
            self._changed.wait_for(lambda: not (self._queue or self._busy) or self._ending)

    def stop(self) -> None:
        """Deliver what is queued, then end the thread; returns when that is done, or at once when a listener itself calls it."""
        with self._changed:
            self._ending = True
            self._changed.notify_all()
        if self._thread.ident is not None and not self.is_current_thread:
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._queue or self._ending)
                batch = self._queue.take()
                self._busy = True
            if not batch:
                return
            for item in batch:
                self._deliver(item)
