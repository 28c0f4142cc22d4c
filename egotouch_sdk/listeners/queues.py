"""Queues for consumers that are slower than the camera: no threads, no clock.

Both keep the law of slow consumers: an edge is never lost, nothing overtakes an edge, and of the stream events that wait between two
edges each pointer has at most one of a type, the newest, with the older ones in its `coalesced`.
"""

from __future__ import annotations

from collections import deque
from typing import Generic, TypeVar

from egotouch_sdk.listeners.merging import merge
from egotouch_sdk.touch_event import EventType, TouchEvent

ItemT = TypeVar("ItemT")


class MergingQueue(Generic[ItemT]):
    """Merges whatever waits; anything that is not a `TouchEvent` counts as an edge.

    Taking everything at once is what keeps the order and starves nobody: a merged event waits at the place of its newest part.
    """

    def __init__(self) -> None:
        self.merged = 0
        self._settled: list[ItemT | TouchEvent] = []
        self._since_edge: dict[tuple[int, int, EventType], TouchEvent] = {}

    def __len__(self) -> int:
        return len(self._settled) + len(self._since_edge)

    def push(self, item: ItemT | TouchEvent) -> None:
        """Add the newest item; `merged` counts the events that this made disappear into others."""
        if not isinstance(item, TouchEvent) or item.type.is_edge:
            self._settle()
            self._settled.append(item)
            return
        key = item.pointer_id, item.contact_id, item.type
        waiting = self._since_edge.pop(key, None)
        if waiting is not None:
            item = merge(waiting, item)
            self.merged += 1
        self._since_edge[key] = item

    def take(self) -> list[ItemT | TouchEvent]:
        """Empty the queue and return what it held, oldest first."""
        self._settle()
        taken, self._settled = self._settled, []
        return taken

    def _settle(self) -> None:
        self._settled += self._since_edge.values()
        self._since_edge.clear()


class CoalescingBuffer:
    """Keeps `capacity` events as they are and merges only what comes on top of them.

    It holds more than `capacity` events and a few for each pointer only when edges alone are that many.
    """

    def __init__(self, capacity: int) -> None:
        self._capacity = capacity
        self._plain: deque[TouchEvent] = deque()
        self._overflow: MergingQueue[TouchEvent] = MergingQueue()

    def __len__(self) -> int:
        return len(self._plain) + len(self._overflow)

    @property
    def merged(self) -> int:
        """Events that disappeared into others so far."""
        return self._overflow.merged

    def push(self, event: TouchEvent) -> None:
        """Add the newest event."""
        if self._overflow or len(self._plain) >= self._capacity:
            self._overflow.push(event)
        else:
            self._plain.append(event)

    def pop(self) -> TouchEvent:
        """Take the oldest event; raises `IndexError` when there is none."""
        if not self._plain and self._overflow:
            self._plain.extend(self._overflow.take())
        return self._plain.popleft()
