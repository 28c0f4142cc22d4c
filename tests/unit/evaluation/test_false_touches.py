from types import SimpleNamespace

import numpy as np
import pytest

from egotouch_sdk.evaluation.false_touches import FalseTouches, count_false_touches
from egotouch_sdk.frame import Frame
from egotouch_sdk.pipeline import TouchPipeline

SECOND_NS = 1_000_000_000


def frames(count: int) -> list[Frame]:
    return [Frame(np.full((64, 64, 3), 90, np.uint8), i * SECOND_NS // 30, i) for i in range(count)]


class NoHands:
    def track(self, frame: Frame) -> tuple[()]:
        return ()

    def reset(self) -> None:
        pass


def test_an_empty_scene_has_no_touch_and_its_full_duration() -> None:
    counted = count_false_touches(frames(30), TouchPipeline(hands=NoHands()))
    assert (counted.frames, counted.downs, counted.patches, counted.frames_with_hands) == (30, 0, 0, 0)
    assert counted.duration_s == pytest.approx(1.0)
    assert counted.downs_per_minute == 0.0


def test_downs_are_counted_per_minute_and_clips_add_up() -> None:
    one = FalseTouches(frames=300, duration_s=10.0, downs=1, patches=5, frames_with_hands=10, frames_with_open_gate=3)
    total = one + FalseTouches(900, 30.0, 1, 0, 0, 0)
    assert one.downs_per_minute == pytest.approx(6.0)
    assert (total.downs, total.downs_per_minute) == (2, pytest.approx(3.0))


def test_no_frames_is_no_rate() -> None:
    pipeline = SimpleNamespace(process=None, finish=None)
    assert count_false_touches([], pipeline).downs_per_minute == 0.0  # type: ignore[arg-type]
