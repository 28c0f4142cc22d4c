"""The façade: a source in, listeners and asynchronous streams out."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from types import TracebackType
from typing import Self

from egotouch_sdk.capture import Capture, Engine
from egotouch_sdk.clock import now_ns
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import THRESHOLDS, EventEngine
from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.listeners import Delivery, Dispatcher, ErrorEvent, Listeners, TrackingState
from egotouch_sdk.listeners.stream import EventStream
from egotouch_sdk.listeners.stream_hub import StreamHub
from egotouch_sdk.sources import FrameSource, ObservationSource, open_source
from egotouch_sdk.touch import TouchModel
from egotouch_sdk.touch_event import TouchEvent

#: `run()` looks for Ctrl-C this often where a wait cannot be interrupted, as on Windows (our choice).
POLL_S = 0.5

_log = logging.getLogger("egotouch_sdk")


@dataclass(frozen=True, slots=True)
class Stats:
    """Counts since `start()`: frames worked through, events they gave, stream events merged for slow listeners, errors of listeners."""

    frames: int
    events: int
    merged: int
    listener_errors: int


class EgoTouch(Listeners):
    """Touch events from `source` for the listeners registered here.

    `source` is what `open_source` takes (a camera index, path or URL), a `FrameSource` or an `ObservationSource`; it is opened by
    `start()` and closed by `stop()`. `config` None takes a recording's own settings, else the defaults. `hands` and `touch` replace the
    built-in hand tracker and touch model. `realtime` is for sources that are not live: by default (None) and with True they play
    at the speed at which they were captured; with False as fast as the machine and the listeners allow. The events are the same.

        with EgoTouch(0) as et:
            @et.onClick(finger="index", surface="palm")
            def clicked(event): print(event.x_mm, event.y_mm)
            et.run()

    Leaving the `with` block stops; entering it does not start, so that listeners can be added before the first frame.
    One object plays one source once.
    """

    def __init__(
        self,
        source: int | str | Path | FrameSource | ObservationSource,
        config: TouchConfig | None = None,
        *,
        hands: HandSource | None = None,
        touch: TouchModel | None = None,
        realtime: bool | None = None,
    ) -> None:
        super().__init__()
        self._given_source = source
        self._given_config = config
        self._hands = hands
        self._touch = touch
        self._realtime = realtime
        self._delivery = Delivery(self._registry, now_ns)
        self._dispatcher = Dispatcher(self._delivery.deliver)
        self._life = Lock()
        self._capture: Capture | None = None
        self._config = config
        self._stopped = False
        self._failure: Exception | None = None
        self._streams = StreamHub()

    @property
    def config(self) -> TouchConfig:
        """The settings in use; before `start()` those that were given."""
        return self._config or TouchConfig()

    @property
    def stats(self) -> Stats:
        """Counts so far."""
        capture = self._capture
        frames, events = (capture.frames, capture.events) if capture else (0, 0)
        return Stats(frames, events, self._dispatcher.merged, self._delivery.errors)

    def start(self) -> None:
        """Open the source and begin; returns at once. Does nothing when it has begun already.

        Raises `SourceError` when the source cannot be opened or this object has been stopped, and what `TouchPipeline` raises.
        """
        with self._life:
            if self._stopped:
                raise SourceError("this EgoTouch has been stopped", hint="Make a new one for each run")
            if self._capture is not None:
                return
            source = _open(self._given_source)
            try:
                engine = self._engine(source)
            except BaseException:
                source.close()
                raise
            self._capture = Capture(
                source,
                engine,
                self._publish,
                self._on_end,
                stall_ms=self.config.state.stall_ms,
                paced=self._realtime is not False and not source.is_live,
                after_frame=self._dispatcher.flush if self._realtime is False and not source.is_live else lambda: None,
            )
            self._dispatcher.start()
            self._capture.start()

    def stop(self) -> None:
        """Cancel open touches (SOURCE_ENDED), call the listeners for all that is left, close the source. May be called twice.

        A listener may call it too; then the rest happens once that listener has returned. Raises the error that ended the source,
        once, unless a listener calls it.
        """
        self._shut_down()
        if not self._dispatcher.is_current_thread:
            self._raise_failure()

    def run(self) -> None:
        """Start, wait until the source ends or Ctrl-C is pressed, and stop. Ctrl-C ends it without an exception, as servers do.

        Raises what `start()` raises, and the error that ended the source; open touches have been cancelled with SOURCE_STALLED then.
        """
        try:
            self.start()
            while not self._has_ended(POLL_S):
                pass
        except KeyboardInterrupt:
            _log.info("interrupted")
        finally:
            self._shut_down()
        self._raise_failure()

    def events(self, *types: str | Iterable[str], queue: int = 256, overflow: str = "coalesce") -> EventStream:
        """Events for `async for`, of all types or of those named, one by one or as a collection; the first one asked for starts the
        source when nothing else has.

        Every stream sees all events from when it was made, whatever listeners consume. `queue` events may wait for it; beyond that
        `overflow` says what happens: "coalesce", "drop_oldest" or "raise" (see `Overflow`). Capture never waits for a stream.
        Raises `ConfigError` for an unknown type or overflow.
        """
        names = [name for given in types for name in ((given,) if isinstance(given, str) else given)]
        stream = EventStream(names if types else None, queue, overflow, self._start_for_stream)
        self._streams.add(stream)
        return stream

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._shut_down()
        if error is None:
            self._raise_failure()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        await asyncio.to_thread(self._shut_down)
        if error is None:
            self._raise_failure()

    def _engine(self, source: FrameSource | ObservationSource) -> Engine:
        if isinstance(source, ObservationSource):
            if self._hands is not None or self._touch is not None:
                raise ConfigError("hands= and touch= have no use for recorded or simulated observations", hint="Leave them out")
            self._config = self._given_config or source.config or TouchConfig()
            return EventEngine(self._config, source.thresholds or THRESHOLDS)
        from egotouch_sdk.pipeline import TouchPipeline

        self._config = self._given_config or TouchConfig()
        return TouchPipeline(self._config, self._hands, self._touch)

    async def _start_for_stream(self) -> None:
        await asyncio.sleep(0)  # consumers that were started together all ask for their streams first
        with self._life:
            started = self._capture is not None or self._stopped
        if not started:
            await asyncio.to_thread(self.start)

    def _publish(self, items: Sequence[TouchEvent | TrackingState]) -> None:
        self._dispatcher.post(items)
        self._streams.push([item for item in items if isinstance(item, TouchEvent)])

    def _on_end(self, failure: Exception | None) -> None:
        self._failure = failure
        if failure is not None:
            self._dispatcher.post([ErrorEvent(failure, "source")])
        self._streams.end(failure)

    def _has_ended(self, timeout_s: float) -> bool:
        return self._capture is None or self._capture.wait(timeout_s)

    def _shut_down(self) -> None:
        with self._life:
            self._stopped = True
            capture = self._capture
        if capture is None:
            if not isinstance(self._given_source, int | str | Path):
                self._given_source.close()
        else:
            capture.stop(wait=not self._dispatcher.is_current_thread)
        self._streams.end()
        self._dispatcher.stop()

    def _raise_failure(self) -> None:
        failure, self._failure = self._failure, None
        if failure is not None:
            raise failure


def _open(source: int | str | Path | FrameSource | ObservationSource) -> FrameSource | ObservationSource:
    return open_source(source) if isinstance(source, int | str | Path) else source
