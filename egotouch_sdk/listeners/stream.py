"""Events for asyncio: one buffer between the capture thread and one consumer's event loop."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Iterable
from contextlib import suppress
from enum import StrEnum
from threading import Lock
from types import TracebackType
from typing import Self

from egotouch_sdk.errors import ConfigError, QueueFullError
from egotouch_sdk.listeners.filters import member, members
from egotouch_sdk.listeners.queues import CoalescingBuffer
from egotouch_sdk.touch_event import EventType, TouchEvent


class Overflow(StrEnum):
    """What happens when a consumer has `queue` events waiting and another one comes.

    COALESCE merges stream events and keeps every edge. DROP_OLDEST forgets the oldest event, be it an edge: for displays that only show
    the present. RAISE ends the iteration with `QueueFullError`, once what waited has been taken.
    """

    COALESCE = "coalesce"
    DROP_OLDEST = "drop_oldest"
    RAISE = "raise"


class EventStream:
    """An asynchronous iterator over events; several may run at once, each sees everything since it was made.

    It ends when the source has ended, and raises the source's error when that failed. A consumer that stops early frees its queue as
    soon as nothing refers to the stream any more; `async with` and `aclose()` do so at once.
    """

    def __init__(
        self, types: str | Iterable[str] | None, capacity: int, overflow: str, before_first: Callable[[], Awaitable[None]]
    ) -> None:
        if capacity < 1:
            raise ConfigError(f"queue={capacity}, need at least 1")
        self._types = members(EventType, types if types is None or isinstance(types, str) else list(types), "event type")
        self._overflow = member(Overflow, overflow, "overflow")
        self._capacity = capacity
        self._buffer: CoalescingBuffer | deque[TouchEvent]
        self._buffer = CoalescingBuffer(capacity) if self._overflow is Overflow.COALESCE else deque(maxlen=capacity)
        self._before_first: Callable[[], Awaitable[None]] | None = before_first
        self._lock = Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._waiter: asyncio.Event | None = None
        self._ended = False
        self._error: BaseException | None = None

    def __len__(self) -> int:
        """Events that wait to be taken."""
        return len(self._buffer)

    def push(self, events: Iterable[TouchEvent]) -> None:
        """Add events, from any thread; never waits."""
        with self._lock:
            if self._ended:
                return
            for event in events:
                if self._types is None or event.type in self._types:
                    self._add(event)
            if self._buffer or self._ended:
                self._wake()

    def end(self, error: BaseException | None = None) -> None:
        """Say that nothing more comes, from any thread; `error` is raised to the consumer once it has taken everything."""
        with self._lock:
            if not self._ended:
                self._ended, self._error = True, error
                self._wake()

    async def aclose(self) -> None:
        """Stop listening and forget what was queued."""
        self.end()
        with self._lock:
            self._buffer = deque()

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> TouchEvent:
        if self._before_first:
            before_first, self._before_first = self._before_first, None
            await before_first()
        self._loop = asyncio.get_running_loop()
        while True:
            with self._lock:
                if self._buffer:
                    return self._pop()
                if self._ended:
                    error, self._error = self._error, None
                    raise error if error is not None else StopAsyncIteration
                waiter = self._waiter = self._waiter or asyncio.Event()
            await waiter.wait()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        await self.aclose()

    def _add(self, event: TouchEvent) -> None:
        if isinstance(self._buffer, CoalescingBuffer):
            self._buffer.push(event)
        elif self._overflow is Overflow.RAISE and len(self._buffer) == self._capacity:
            self._ended = True
            hint = "Take events faster, ask for fewer types, or use overflow='coalesce'"
            self._error = QueueFullError(f"{self._capacity} events wait for an asynchronous consumer", hint=hint)
        elif not self._ended:
            self._buffer.append(event)

    def _pop(self) -> TouchEvent:
        return self._buffer.pop() if isinstance(self._buffer, CoalescingBuffer) else self._buffer.popleft()

    def _wake(self) -> None:
        waiter, self._waiter = self._waiter, None
        if waiter is not None and self._loop is not None:
            with suppress(RuntimeError):  # the loop has been closed, and its consumer with it
                self._loop.call_soon_threadsafe(waiter.set)
