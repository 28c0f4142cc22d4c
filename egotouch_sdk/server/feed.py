"""From a source on its own thread to the server on the event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from egotouch_sdk.capture import Capture, Engine
from egotouch_sdk.clock import now_ns
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.server.event_server import EventServer
from egotouch_sdk.sources import FrameSource, ObservationSource
from egotouch_sdk.touch_event import CancelReason, TouchEvent

#: Pause between two rounds of a source that is played again; longer than a stall, so that no touch reaches from one into the next.
PAUSE_NS = 500_000_000


class ServedSource:
    """A source on the clock of the server: one that is not live begins now and, with `repeat`, again after its end.

    A video is served as a camera would see it: a frame whose successor is due already is left out, so that a machine that is too slow
    for all of them is never further behind than one. Observations cost nothing and all come.
    """

    def __init__(self, source: FrameSource | ObservationSource, *, repeat: bool = False, clock: Callable[[], int] = now_ns) -> None:
        self.is_live = source.is_live
        self._source = source
        self._leaves_out = not isinstance(source, ObservationSource)
        self._repeat = repeat and not source.is_live
        self._clock = clock
        self._closed = False

    def __iter__(self) -> Iterator[Any]:
        if self.is_live:
            yield from self._source
            return
        start_ns, last_ns = self._clock(), None
        while not self._closed:
            for item in self._due(self._dated(start_ns)):
                last_ns = item.timestamp_ns
                yield item
            if not self._repeat or last_ns is None:
                return
            start_ns = last_ns + PAUSE_NS

    def _dated(self, start_ns: int) -> Iterator[Any]:
        """The source's items, of which the first has this time."""
        offset_ns: int | None = None
        for item in self._source:
            if offset_ns is None:
                offset_ns = start_ns - item.timestamp_ns
            yield replace(item, timestamp_ns=item.timestamp_ns + offset_ns)

    def _due(self, items: Iterator[Any]) -> Iterator[Any]:
        """Those that are worth taking when they are asked for."""
        newest = next(items, None)
        for item in items:
            if not self._leaves_out or item.timestamp_ns > self._clock():
                yield newest
            newest = item
        if newest is not None:
            yield newest

    def close(self) -> None:
        """Close the source itself."""
        self._closed = True
        self._source.close()


class Tap:
    """An engine that hands on what it makes; once `stopping`, open touches are cancelled with SERVER_STOPPED.

    `show` gets every item after its events went out.
    """

    def __init__(
        self,
        engine: Engine,
        hand_on: Callable[[int, FrameResult | None, tuple[TouchEvent, ...]], None],
        show: Callable[[Any], None] | None = None,
    ) -> None:
        self.stopping = False
        self._show = show
        self._engine = engine
        self._hand_on = hand_on

    def process(self, item: Any, /) -> FrameResult:
        """Take one frame or observation."""
        result = self._engine.process(item)
        self._hand_on(result.timestamp_ns, result, result.events)
        if self._show is not None:
            self._show(item)
        return result

    def finish(self, timestamp_ns: int, reason: CancelReason, /) -> tuple[TouchEvent, ...]:
        """Cancel what is open."""
        events = self._engine.finish(timestamp_ns, CancelReason.SERVER_STOPPED if self.stopping else reason)
        self._hand_on(timestamp_ns, None, events)
        return events


class Feed:
    """Runs a source through its engine on a thread and publishes what comes of it; made and used on the event loop's thread.

    `ended` is done when the source has ended, with the error that ended it or None.
    """

    def __init__(
        self, server: EventServer, source: FrameSource | ObservationSource, engine: Engine, *, stall_ms: float, repeat: bool = False
    ) -> None:
        self._loop = asyncio.get_running_loop()
        self.ended: asyncio.Future[Exception | None] = self._loop.create_future()
        self._server = server
        video = server.settings.video
        self._tap = Tap(engine, self._hand_on, video.show if video else None)
        self._capture = Capture(
            ServedSource(source, repeat=repeat),  # type: ignore[arg-type]
            self._tap,
            lambda _: None,
            lambda failure: self._call(self._end, failure),
            stall_ms=stall_ms,
            paced=not source.is_live,
        )

    def start(self) -> None:
        """Begin to capture."""
        self._capture.start()

    async def stop(self) -> None:
        """Cancel open touches with SERVER_STOPPED and let the source go."""
        self._tap.stopping = True
        await asyncio.to_thread(self._capture.stop)
        await asyncio.sleep(0)  # what the thread handed over last is published first

    def _hand_on(self, timestamp_ns: int, result: FrameResult | None, events: tuple[TouchEvent, ...]) -> None:
        self._call(self._server.take_frame, timestamp_ns, result, events, now_ns())

    def _call(self, function: Callable[..., None], *arguments: object) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(function, *arguments)

    def _end(self, failure: Exception | None) -> None:
        if not self.ended.done():
            self.ended.set_result(failure)
