"""Frames that the app itself hands over, for example from a headset's camera API."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from enum import StrEnum
from threading import Condition
from typing import Any

from egotouch_sdk.clock import now_ns
from egotouch_sdk.errors import ConfigError, FrameError, SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.sources.base import FrameSource


class WhenFull(StrEnum):
    """What `PushSource.push` does when no frame has been taken yet and the queue is full."""

    DROP_OLDEST = "drop_oldest"
    BLOCK = "block"


class PushSource(FrameSource):
    """A bounded queue between the app's camera thread and the pipeline's thread.

    `capacity` frames are kept; by default one, and the newest wins, so the pipeline never works on an old image.
    `Frame.index` counts what was pushed, so a gap shows frames that were dropped.
    """

    def __init__(self, *, capacity: int = 1, when_full: WhenFull = WhenFull.DROP_OLDEST) -> None:
        if capacity < 1:
            raise ConfigError(f"capacity is {capacity}, need at least 1")
        self._capacity = capacity
        self._when_full = WhenFull(when_full)
        self._queue: deque[Frame] = deque()
        self._changed = Condition()
        self._ended = False
        self._pushed = 0
        self._last_ns = -1

    @property
    def is_live(self) -> bool:
        """True when old frames give way to new ones."""
        return self._when_full is WhenFull.DROP_OLDEST

    @property
    def width_px(self) -> int | None:
        """Unknown before the app pushes."""
        return None

    @property
    def height_px(self) -> int | None:
        """Unknown before the app pushes."""
        return None

    @property
    def fps(self) -> float | None:
        """Unknown: the app decides."""
        return None

    @property
    def frame_count(self) -> int | None:
        """Unknown: the app decides."""
        return None

    def push(self, image: Any, timestamp_ns: int | None = None, *, timeout_s: float | None = None) -> Frame:
        """Hand over one image (H, W, 3) uint8 BGR; the array must not be changed afterwards.

        `timestamp_ns` is the capture time on any monotonic clock and has to rise; None stamps the frame now.
        With `WhenFull.BLOCK` waits until there is room, at most `timeout_s` seconds (None: for ever).
        Raises `FrameError` for a bad image or time, `SourceError` after `close()` and when the wait is over.
        """
        with self._changed:
            self._refuse_when_ended()
            stamp_ns = now_ns() if timestamp_ns is None else timestamp_ns
            if stamp_ns <= self._last_ns:
                raise FrameError(f"timestamp_ns {stamp_ns} does not rise (last was {self._last_ns})", hint="Push frames in capture order")
            frame = Frame(image, stamp_ns, self._pushed)
            if self._when_full is WhenFull.BLOCK:
                if not self._changed.wait_for(lambda: len(self._queue) < self._capacity or self._ended, timeout_s):
                    raise SourceError(f"no frame was taken within {timeout_s} s", hint="Iterate over the source in another thread")
                self._refuse_when_ended()
            elif len(self._queue) == self._capacity:
                self._queue.popleft()
            self._queue.append(frame)
            self._pushed += 1
            self._last_ns = stamp_ns
            self._changed.notify_all()
            return frame

    def __iter__(self) -> Iterator[Frame]:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._queue or self._ended)
                if not self._queue:
                    return
                frame = self._queue.popleft()
                self._changed.notify_all()
            yield frame

    def close(self) -> None:
        """End the stream: frames already pushed are still delivered, then iteration stops."""
        with self._changed:
            self._ended = True
            self._changed.notify_all()

    def _refuse_when_ended(self) -> None:
        if self._ended:
            raise SourceError("the push source is closed", hint="Make a new PushSource")
