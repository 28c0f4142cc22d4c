"""What waits for one client."""

from __future__ import annotations

from collections import deque

from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.limits import Limits


class Outbox:
    """Batches in their order; neighbours without edges become one, so that only edges make it grow.

    `merged` counts the batches that became part of another.
    """

    def __init__(self, limits: Limits) -> None:
        self.merged = 0
        self._limits = limits
        self._batches: deque[Batch] = deque()
        self._bytes = 0

    def __len__(self) -> int:
        return len(self._batches)

    @property
    def head(self) -> Batch | None:
        """The oldest batch."""
        return self._batches[0] if self._batches else None

    def push(self, batch: Batch) -> bool:
        """Add the newest batch; True when it took in the one before it."""
        last = self._batches[-1] if self._batches else None
        merges = last is not None and not (last.has_edges or batch.has_edges)
        if last is not None and merges:
            self._batches.pop()
            self._bytes -= last.size_bytes
            batch = last.merged_with(batch)
            self.merged += 1
        self._batches.append(batch)
        self._bytes += batch.size_bytes
        return merges

    def pop(self) -> Batch:
        """Take the oldest batch."""
        batch = self._batches.popleft()
        self._bytes -= batch.size_bytes
        return batch

    @property
    def is_overfull(self) -> bool:
        """True when more waits than a client may let wait."""
        return len(self._batches) > self._limits.outbox_messages or self._bytes > self._limits.outbox_bytes
