"""A finger played by a test while the façade runs: what perception would see, handed over frame by frame."""

from __future__ import annotations

from collections.abc import Iterator
from queue import SimpleQueue

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, observe
from egotouch_sdk.sources import ObservationSource
from egotouch_sdk.state import Thresholds
from egotouch_sdk.surface import Surface

FRAME_NS = 33_333_333
OVER = SimulatedFinger(Surface.PALM, 0.0, 50.0, 8.0)
ON = SimulatedFinger(Surface.PALM, 0.0, 50.0, 0.0, 1.0)


class PlayedFinger(ObservationSource):
    """A source that gives what the test has played so far and waits for more; a right index finger over the left palm."""

    def __init__(self, *, is_live: bool = False) -> None:
        self._is_live = is_live
        self._queue: SimpleQueue[list[FrameObservation] | Exception | None] = SimpleQueue()
        self._played = 0
        self.closed = 0

    def hover(self) -> None:
        """Be seen over the skin."""
        self._see(OVER)

    def touch(self) -> None:
        """Come down onto the skin and stay."""
        self._see(OVER, ON)

    def tap(self) -> None:
        """Hover, touch, hover: one DOWN, one UP, one CLICK."""
        self._see(OVER, ON, OVER)

    def leave(self) -> None:
        """Show only the host hand."""
        self._see(None)

    def end(self) -> None:
        """No more frames."""
        self._queue.put(None)

    def fail(self, error: Exception) -> None:
        """Raise in the reader."""
        self._queue.put(error)

    def _see(self, *places: SimulatedFinger | None) -> None:
        """Three frames of each place, which get through the median filter, handed over together: a camera that does not stall."""
        frames = []
        for finger in (place for place in places for _ in range(3)):
            scene = SimulatedScene(() if finger is None else (finger,))
            frames.append(observe(scene, self._played, self._played * FRAME_NS))
            self._played += 1
        self._queue.put(frames)

    def __iter__(self) -> Iterator[FrameObservation]:
        while (item := self._queue.get()) is not None:
            if isinstance(item, Exception):
                raise item
            yield from item

    def close(self) -> None:
        self.closed += 1
        self._queue.put(None)

    @property
    def config(self) -> TouchConfig | None:
        return None

    @property
    def thresholds(self) -> Thresholds | None:
        return None

    @property
    def is_live(self) -> bool:
        return self._is_live

    @property
    def width_px(self) -> int | None:
        return 1280

    @property
    def height_px(self) -> int | None:
        return 720

    @property
    def fps(self) -> float | None:
        return 30.0

    @property
    def frame_count(self) -> int | None:
        return None
