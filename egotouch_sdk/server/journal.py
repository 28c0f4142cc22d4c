"""What happened in one run of the server: offsets, the edges of the last seconds, and the pointers that are open."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.limits import Limits
from egotouch_sdk.touch_event import EventType, TouchEvent

_ENDS_CONTACT = frozenset({EventType.UP, EventType.CANCEL})
#: Events that may still follow the end of their contact.
_AFTERWARDS = frozenset({EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING})


class Journal:
    """Counts edges and remembers the last ones, for clients that come back.

    `epoch` is a random number, one for each run of the server. `offset` counts the edges published in it; all other events share the
    offset of the edge before them, so that a gap in offsets is always a loss.
    """

    def __init__(self, epoch: int, limits: Limits | None = None) -> None:
        self.epoch = epoch
        self.offset = 0
        self._limits = limits or Limits()
        self._ring: deque[Batch] = deque()
        self._ring_edges = 0
        self._ring_starts_after = 0
        self._open: dict[int, TouchEvent] = {}
        self._down: dict[int, TouchEvent] = {}

    @property
    def pointers(self) -> tuple[TouchEvent, ...]:
        """The last event of every open pointer."""
        return tuple(self._open.values())

    @property
    def contacts(self) -> dict[int, TouchEvent]:
        """The last event of every pointer that is down, by `pointer_id`."""
        return self._down

    def append(self, frame_index: int, timestamp_ns: int, events: Iterable[TouchEvent], now_ns: int) -> Batch:
        """Take the events of one frame and return them with their offset; the journal forgets what is too old."""
        events = tuple(events)
        edges = tuple(event for event in events if event.type.is_edge)
        self.offset += len(edges)
        for event in events:
            self._note(event)
        batch = Batch(frame_index, timestamp_ns, now_ns, self.offset, events)
        if edges:
            self._ring.append(Batch(frame_index, timestamp_ns, now_ns, self.offset, edges, replay=True))
            self._ring_edges += len(edges)
        self._forget(now_ns)
        return batch

    def since(self, epoch: int, offset: int, now_ns: int) -> tuple[Batch, ...] | None:
        """The edges after `offset`, all of them or None: when they are of another run, forgotten, or not yet counted."""
        self._forget(now_ns)
        if epoch != self.epoch or not self._ring_starts_after <= offset <= self.offset:
            return None
        return tuple(_after(batch, offset) for batch in self._ring if batch.offset > offset)

    def _forget(self, now_ns: int) -> None:
        while self._ring and (
            self._ring_edges > self._limits.journal_edges or now_ns - self._ring[0].published_ns > self._limits.journal_ns
        ):
            oldest = self._ring.popleft()
            self._ring_edges -= len(oldest.events)
            self._ring_starts_after = oldest.offset

    def _note(self, event: TouchEvent) -> None:
        if event.type is EventType.HOVER_EXIT:
            self._open.pop(event.pointer_id, None)
            self._down.pop(event.pointer_id, None)
            return
        self._open[event.pointer_id] = event
        if event.type in _ENDS_CONTACT:
            self._down.pop(event.pointer_id, None)
        elif not event.type.is_hover and event.type not in _AFTERWARDS:
            self._down[event.pointer_id] = event


def _after(batch: Batch, offset: int) -> Batch:
    """The part of a replayed batch whose edges come after `offset`; a frame's edges have consecutive offsets."""
    seen = len(batch.events) - (batch.offset - offset)
    if seen <= 0:
        return batch
    return Batch(batch.frame_index, batch.timestamp_ns, batch.published_ns, batch.offset, batch.events[seen:], replay=True)
