"""All asynchronous consumers of one source."""

from __future__ import annotations

from collections.abc import Sequence
from threading import Lock
from weakref import ReferenceType, ref

from egotouch_sdk.listeners.stream import EventStream
from egotouch_sdk.touch_event import TouchEvent


class StreamHub:
    """Hands events to every stream that somebody still holds; may be used from any thread."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._streams: list[ReferenceType[EventStream]] = []
        self._has_ended = False

    def add(self, stream: EventStream) -> None:
        """Let a stream take part, as long as something else refers to it; after the end it gets nothing any more."""
        with self._lock:
            self._streams = [known for known in self._streams if known() is not None]
            self._streams.append(ref(stream))
            if self._has_ended:
                stream.end()

    def push(self, events: Sequence[TouchEvent]) -> None:
        """Give events to all streams; never waits for one."""
        for stream in self._alive():
            stream.push(events)

    def end(self, error: BaseException | None = None) -> None:
        """Say that nothing more comes, and why; only the first time counts."""
        with self._lock:
            self._has_ended = True
        for stream in self._alive():
            stream.end(error)

    def _alive(self) -> list[EventStream]:
        with self._lock:
            return [stream for known in self._streams if (stream := known()) is not None]
