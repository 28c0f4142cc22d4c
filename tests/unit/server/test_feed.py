"""What is served of a source, by a clock that the test turns."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from egotouch_sdk.frame import Frame
from egotouch_sdk.server.feed import PAUSE_NS, ServedSource
from egotouch_sdk.simulator import ScriptSource, shipped_script
from egotouch_sdk.sources import FrameSource

FRAME_NS = 100
START_NS = 10**12


class Clip(FrameSource):
    """Frames 100 ns apart, the first at 5000 ns."""

    width_px, height_px, fps = 4, 4, 1e7

    def __init__(self, frame_count: int, *, is_live: bool = False) -> None:
        self._frame_count = frame_count
        self._is_live = is_live

    @property
    def is_live(self) -> bool:
        return self._is_live

    @property
    def frame_count(self) -> int:
        return self._frame_count

    def __iter__(self) -> Iterator[Frame]:
        image = np.zeros((40, 40, 3), np.uint8)
        return (Frame(image, 5000 + index * FRAME_NS, index) for index in range(self._frame_count))

    def close(self) -> None:
        pass


class Viewer:
    """Takes frames, each of which keeps it busy for a while, and never before their time."""

    def __init__(self, busy_ns: int) -> None:
        self.now_ns = START_NS
        self.behind_ns: list[int] = []
        self._busy_ns = busy_ns

    def clock(self) -> int:
        return self.now_ns

    def take(self, source: ServedSource, count: int = 1000) -> list[int]:
        """The indexes of the first frames that it gets."""
        taken = []
        for frame, _ in zip(source, range(count), strict=False):
            self.now_ns = max(self.now_ns, frame.timestamp_ns)
            self.behind_ns.append(self.now_ns - frame.timestamp_ns)
            self.now_ns += self._busy_ns
            taken.append(frame.index)
        return taken


def test_a_machine_that_is_fast_enough_gets_every_frame_on_time() -> None:
    viewer = Viewer(busy_ns=90)
    assert viewer.take(ServedSource(Clip(20), clock=viewer.clock)) == list(range(20))
    assert set(viewer.behind_ns) == {0}


@pytest.mark.parametrize("busy_ns", [120, 250, 1000])
def test_a_machine_that_is_too_slow_leaves_frames_out_and_stays_one_behind(busy_ns: int) -> None:
    viewer = Viewer(busy_ns)
    taken = viewer.take(ServedSource(Clip(100), clock=viewer.clock))
    assert taken[0] == 0 and taken[-1] == 99 and len(taken) <= 100 * FRAME_NS // busy_ns + 2
    assert max(viewer.behind_ns[:-1]) < FRAME_NS


def test_a_hitch_costs_only_the_frames_that_it_lasted() -> None:
    viewer = Viewer(busy_ns=10)
    frames = iter(ServedSource(Clip(20), clock=viewer.clock))
    assert next(frames).index == 0
    viewer.now_ns += 5 * FRAME_NS + 1
    assert [frame.index for frame in frames][:3] == [5, 6, 7]


def test_observations_all_come_however_late() -> None:
    script = ScriptSource(shipped_script("taps"))
    viewer = Viewer(busy_ns=10**9)
    assert len(viewer.take(ServedSource(script, clock=viewer.clock))) == len(list(script))


def test_a_source_that_is_played_again_begins_a_pause_later_and_time_rises() -> None:
    viewer = Viewer(busy_ns=0)
    frames = iter(ServedSource(Clip(3), repeat=True, clock=viewer.clock))
    times_ns = [next(frames).timestamp_ns - START_NS for _ in range(6)]
    assert times_ns == [0, 100, 200, 200 + PAUSE_NS, 300 + PAUSE_NS, 400 + PAUSE_NS]


@pytest.mark.parametrize("repeat", [False, True])
def test_a_live_source_is_taken_as_it_is_and_once(repeat: bool) -> None:
    viewer = Viewer(busy_ns=1000)
    frames = list(ServedSource(Clip(3, is_live=True), repeat=repeat, clock=viewer.clock))
    assert [frame.timestamp_ns for frame in frames] == [5000, 5100, 5200]


@pytest.mark.parametrize("repeat", [False, True])
def test_nothing_of_an_empty_source_comes_and_nobody_waits(repeat: bool) -> None:
    assert list(ServedSource(Clip(0), repeat=repeat)) == []
