"""Sources whose observations come when the test says so."""

from __future__ import annotations

from collections.abc import Iterator
from queue import SimpleQueue

import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, observe
from egotouch_sdk.surface import Surface


class HandFedSource:
    """An observation source that gives what it is handed."""

    config = None
    thresholds = None
    width_px, height_px, fps, frame_count = 1280, 720, 30.0, None

    def __init__(self, *, is_live: bool = False) -> None:
        self.is_live = is_live
        self._queue: SimpleQueue[FrameObservation | SourceError | None] = SimpleQueue()
        self._index = 0

    def hover(self, frames: int = 5) -> None:
        """Be seen over the palm."""
        self._put(frames, SimulatedFinger(Surface.PALM, 0.0, 40.0, 10.0))

    def touch(self, frames: int = 5) -> None:
        """Be seen pressing the palm with 2 N."""
        self._put(frames, SimulatedFinger(Surface.PALM, 0.0, 40.0, 0.0, 2.0))

    def end(self, error: SourceError | None = None) -> None:
        """Have no more observations, or fail."""
        self._queue.put(error)

    def _put(self, frames: int, finger: SimulatedFinger) -> None:
        for _ in range(frames):
            self._queue.put(observe(SimulatedScene((finger,)), self._index, 1_000_000_000 + self._index * 33_333_333))
            self._index += 1

    def __iter__(self) -> Iterator[FrameObservation]:
        while (item := self._queue.get()) is not None:
            if isinstance(item, SourceError):
                raise item
            yield item

    def close(self) -> None:
        """Let the reader go."""
        self._queue.put(None)


@pytest.fixture
def source() -> Iterator[HandFedSource]:
    fed = HandFedSource()
    yield fed
    fed.close()


@pytest.fixture
def live_source() -> Iterator[HandFedSource]:
    fed = HandFedSource(is_live=True)
    yield fed
    fed.close()
