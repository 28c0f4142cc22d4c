from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.evaluation.datasets.recording import GivenHands
from egotouch_sdk.evaluation.false_touches import FalseTouches, count_false_touches, count_without_gate, poisson_interval
from egotouch_sdk.frame import Frame
from egotouch_sdk.observation import HandObservation
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.touch import TouchModel
from tests.support.datasets import picture, touching_pair
from tests.support.study import colour_model, memory_model

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


@pytest.mark.parametrize("count", [0, 1, 2, 7, 40, 300])
def test_the_interval_of_a_rate_is_the_chi_square_one(count: int) -> None:
    stats = pytest.importorskip("scipy.stats")
    low, high = poisson_interval(count)
    assert low == pytest.approx(stats.chi2.ppf(0.025, 2 * count) / 2 if count else 0.0, abs=1e-6)
    assert high == pytest.approx(stats.chi2.ppf(0.975, 2 * count + 2) / 2, abs=1e-6)


def test_no_false_touch_in_a_minute_still_allows_for_some() -> None:
    counted = FalseTouches(1800, 60.0, 0, 0, 0, 450)
    assert counted.interval_per_minute == pytest.approx((0.0, 3.689), abs=1e-3) and counted.open_gate_s == 15.0
    assert FalseTouches(0, 0.0, 0, 0, 0, 0).interval_per_minute == (0.0, float("inf"))


def coloured(text: str, hands: tuple[HandObservation, ...], folder: Path) -> tuple[FalseTouches, FalseTouches]:
    """What is counted with and without a gate where `hands` are seen all the time and `#` looks like a touch."""
    pictures = [Frame(picture(letter), i * SECOND_NS // 30, i) for i, letter in enumerate(text)]
    model, given = TouchModel(colour_model(folder)), GivenHands(dict.fromkeys(range(len(text)), hands))
    gated = count_false_touches(pictures, TouchPipeline(hands=given, touch=model))
    return gated, count_without_gate(pictures, given, model, TouchConfig())


def test_a_lone_finger_that_looks_like_a_touch_counts_only_without_the_gate(tmp_path: Path) -> None:
    finger, _ = touching_pair()
    gated, ungated = coloured("....####....####....", (finger,), tmp_path)
    assert (gated.downs, gated.patches, gated.frames_with_open_gate) == (0, 0, 0)
    assert (ungated.downs, ungated.patches, ungated.frames_with_open_gate) == (2, 20, 20)
    assert ungated.duration_s == gated.duration_s == pytest.approx(20 / 30)


def test_without_the_gate_every_outstretched_finger_of_both_hands_is_shown(tmp_path: Path) -> None:
    gated, ungated = coloured("....####....", touching_pair(), tmp_path)
    assert (gated.downs, gated.patches) == (1, 12) and (ungated.downs, ungated.patches) == (6, 72)


def test_an_empty_scene_has_nothing_to_show_without_the_gate_either(tmp_path: Path) -> None:
    _, ungated = coloured("..##..", (), tmp_path)
    assert (ungated.downs, ungated.patches, ungated.frames_with_hands, ungated.frames) == (0, 0, 0, 6)


def test_without_the_gate_a_model_with_memory_remembers_each_finger_until_a_stall(tmp_path: Path) -> None:
    finger, _ = touching_pair()
    text = "........####"
    hands = GivenHands(dict.fromkeys(range(len(text)), (finger,)))
    flowing, stalled = (
        [Frame(picture(letter), (i + away * (i > 7)) * SECOND_NS // 30, i) for i, letter in enumerate(text)] for away in (0, 8)
    )
    model, config = TouchModel(memory_model(tmp_path)), TouchConfig(touch={"memory_ms": 10_000.0})
    assert count_without_gate(flowing, hands, TouchModel(colour_model(tmp_path)), config).downs == 1
    assert count_without_gate(flowing, hands, model, config).downs == 0
    assert count_without_gate(stalled, hands, model, config).downs == 1
