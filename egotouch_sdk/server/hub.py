"""Where events come in and go out to everybody who listens."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.session import Session
from egotouch_sdk.touch_event import TouchEvent

#: Gets every batch as it is published, for example to republish it elsewhere.
BatchSink = Callable[[Batch], None]


class EventHub:
    """Hands each frame's events to the journal, to every session and to every sink. No sockets, no clock."""

    def __init__(self, journal: Journal) -> None:
        self.journal = journal
        self.sessions: set[Session] = set()
        self.sinks: list[BatchSink] = []

    def publish(self, frame_index: int, timestamp_ns: int, events: Iterable[TouchEvent], now_ns: int) -> Batch:
        """Publish the events of one frame; they come in the order of their frames. A frame without events reaches nobody."""
        batch = self.journal.append(frame_index, timestamp_ns, events, now_ns)
        if batch.events:
            for session in self.sessions:
                session.offer(batch, now_ns)
            for sink in self.sinks:
                sink(batch)
        return batch
