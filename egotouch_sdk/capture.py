"""The thread that turns a source into events, and the one that notices when a camera falls silent."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Sequence
from threading import Event, Lock, Thread, current_thread
from typing import Any, Protocol

from egotouch_sdk.clock import Pacer, now_ns
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.listeners import TrackingState
from egotouch_sdk.observation import GateReason
from egotouch_sdk.sources import FrameSource, ObservationSource
from egotouch_sdk.touch_event import CancelReason, TouchEvent

#: How long `stop()` waits for a source that is not live to give its next frame before it closes it under its reader (our choice).
GRACE_S = 1.0
#: How long `stop()` waits for a driver that does not let go (our choice).
PATIENCE_S = 5.0

_log = logging.getLogger("egotouch_sdk.capture")


class Engine(Protocol):
    """A `TouchPipeline` for frames or an `EventEngine` for observations."""

    def process(self, item: Any, /) -> FrameResult:
        """Take one frame or observation."""

    def finish(self, timestamp_ns: int, reason: CancelReason, /) -> tuple[TouchEvent, ...]:
        """Cancel what is open."""


class Capture:
    """Runs `source` through `engine` on a thread until the source ends or `stop()` is called.

    `publish` gets what happened, in order, never from two threads at once; it must not wait. `on_end` is called once, with the error
    that ended the source or None. `paced` holds each frame back until its time; `after_frame` may hold the next one back.
    When a live source gives nothing for `stall_ms` of wall time every touch is cancelled; those events have the last frame's time,
    so that a frame which arrives late never goes back in time.
    """

    def __init__(
        self,
        source: FrameSource | ObservationSource,
        engine: Engine,
        publish: Callable[[Sequence[TouchEvent | TrackingState]], None],
        on_end: Callable[[Exception | None], None],
        *,
        stall_ms: float,
        paced: bool = False,
        after_frame: Callable[[], None] = lambda: None,
    ) -> None:
        self.frames = 0
        self.events = 0
        self._source = source
        self._engine = engine
        self._publish = publish
        self._on_end = on_end
        self._after_frame = after_frame
        self._stall_ns = round(stall_ms * 1e6)
        self._pacer = Pacer() if paced else None
        self._engine_lock = Lock()
        self._stopping = Event()
        self._ended = Event()
        self._waiting_since_ns: int | None = None
        self._last_ns = 0
        self._is_open = False
        self._finished = False
        self._tracking: TrackingState | None = None
        self._thread = Thread(target=self._run, name="egotouch-capture", daemon=True)

    def start(self) -> None:
        """Start capturing."""
        self._thread.start()
        if self._source.is_live:
            Thread(target=self._watch, name="egotouch-watchdog", daemon=True).start()

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait for the end of the source; True when it has come."""
        return self._ended.wait(timeout_s)

    def stop(self, *, wait: bool = True) -> None:
        """Cancel open touches with SOURCE_ENDED, end the thread and close the source; may be called twice and from any thread.

        Without `wait` the thread ends, and closes the source, a little later.
        """
        self._stopping.set()
        if current_thread() is self._thread:
            return
        self._finish(CancelReason.SOURCE_ENDED)
        if self._source.is_live:
            self._source.close()
        if wait:
            self._wait_for_reader()

    def _wait_for_reader(self) -> None:
        while not self._ended.wait(GRACE_S):
            since_ns = self._waiting_since_ns
            silent_s = 0.0 if since_ns is None else (now_ns() - since_ns) / 1e9
            if silent_s > PATIENCE_S:
                _log.warning("the source does not end; its thread is left behind")
                return
            if silent_s > GRACE_S:
                self._source.close()

    def _run(self) -> None:
        failure = _error_of(self._play)
        reason = CancelReason.SOURCE_STALLED if failure else CancelReason.SOURCE_ENDED
        finish_error = _error_of(lambda: self._finish(reason))
        close_error = _error_of(self._source.close)
        failure = failure or finish_error or close_error
        self._on_end(failure)
        self._ended.set()

    def _play(self) -> None:
        for item in self._items():
            if self._pacer:
                self._stopping.wait(self._pacer.delay_s(item.timestamp_ns))
            if not self._process(item):
                return
            self._after_frame()

    def _items(self) -> Iterator[Any]:
        items = iter(self._source)
        while not self._stopping.is_set():
            self._waiting_since_ns = now_ns()
            item = next(items, None)
            self._waiting_since_ns = None
            if item is None:
                return
            yield item

    def _process(self, item: Any) -> bool:
        with self._engine_lock:
            if self._finished:
                return False
            self._last_ns, self._is_open = item.timestamp_ns, True
            result = self._engine.process(item)
            self.frames += 1
            self._emit(TrackingState.of(result.observation), result.events)
            return True

    def _finish(self, reason: CancelReason) -> None:
        with self._engine_lock:
            if not self._finished:
                self._finished = True
                self._cancel(reason)

    def _watch(self) -> None:
        pause_ns = self._stall_ns
        while not (self._stopping.wait(pause_ns / 1e9) or self._ended.is_set()):
            pause_ns = self._stall_ns
            since_ns = self._waiting_since_ns
            if since_ns is not None and not self._cancel_when_stalled(since_ns):
                pause_ns = max(since_ns + self._stall_ns - now_ns(), 0)

    def _cancel_when_stalled(self, since_ns: int) -> bool:
        if now_ns() - since_ns < self._stall_ns:
            return False
        with self._engine_lock:
            if self._is_open and self._waiting_since_ns == since_ns and not self._finished:
                self._cancel(CancelReason.SOURCE_STALLED)
        return True

    def _cancel(self, reason: CancelReason) -> None:
        self._is_open = False
        events = self._engine.finish(self._last_ns, reason)
        self._emit(TrackingState(self._last_ns, (), GateReason.NO_HANDS), events)

    def _emit(self, tracking: TrackingState, events: Sequence[TouchEvent]) -> None:
        items: list[TouchEvent | TrackingState] = [*events]
        if tracking.differs_from(self._tracking):
            self._tracking = tracking
            items.insert(0, tracking)
        self.events += len(events)
        if items:
            self._publish(items)


def _error_of(step: Callable[[], None]) -> Exception | None:
    try:
        step()
    except Exception as error:
        return error
    return None
