from __future__ import annotations

from pathlib import Path

import pytest

from egotouch_sdk.errors import ModelError
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import FingertipPatch
from egotouch_sdk.touch import TouchModel, TouchStream
from tests.support.study import memory_model, signal_model, told_patch

FRAME_NS = 33_333_333
NAN = float("nan")


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(memory_model(tmp_path_factory.mktemp("model")))


class Film:
    """Frames of 1/30 s, of which `memory_model` tells by the force how many it remembers of a finger."""

    def __init__(self, model: TouchModel, memory_ms: float = 150.0) -> None:
        self.stream = TouchStream(model, memory_ms)
        self.frame = 0

    def show(self, *patches: FingertipPatch) -> list[int]:
        """One frame; gives for each finger how many frames of it are remembered, this one included."""
        estimates = self.stream.estimate(patches, self.frame * FRAME_NS)
        self.frame += 1
        assert [(each.hand_id, each.finger) for each in estimates] == [(each.hand_id, each.finger) for each in patches]
        return [round(each.force_n / 0.1) for each in estimates]

    def wait(self, frames: int) -> None:
        """Frames that show no finger."""
        for _ in range(frames):
            assert self.show() == []


def test_a_finger_is_judged_by_all_its_frames(model: TouchModel) -> None:
    stream = TouchStream(model, 150.0)
    looks = (3.0, 3.0, 3.0, -1.0)
    told = [stream.estimate([told_patch(look)], frame * FRAME_NS)[0].touch_probability for frame, look in enumerate(looks)]
    alone = model.estimate([told_patch(-1.0)])[0].touch_probability
    assert alone < 0.3 and told[:3] == pytest.approx([0.953] * 3, abs=1e-3) and told[3] == pytest.approx(0.881, abs=1e-3)


def test_fingers_and_hands_do_not_share_their_memories(model: TouchModel) -> None:
    film = Film(model)
    index, ring, other = told_patch(4.0), told_patch(-4.0, finger=Finger.RING), told_patch(-4.0, hand_id=2)
    assert film.show(index) == [1]
    assert film.show(ring, index) == [1, 2]
    assert film.show(index, other, ring) == [3, 1, 2]
    probabilities = [each.touch_probability for each in film.stream.estimate([other, index, ring], film.frame * FRAME_NS)]
    assert [round(each) for each in probabilities] == [0, 1, 0]


def test_a_finger_that_leaves_and_returns_in_time_is_remembered(model: TouchModel) -> None:
    film = Film(model)
    film.show(told_patch(1.0))
    film.wait(3)
    assert film.show(told_patch(1.0)) == [2]


def test_a_finger_that_returns_too_late_starts_anew(model: TouchModel) -> None:
    film = Film(model)
    film.show(told_patch(1.0))
    film.wait(4)
    assert film.show(told_patch(1.0)) == [1]


def test_the_time_away_counts_for_each_finger_and_not_its_number_of_frames(model: TouchModel) -> None:
    film = Film(model)
    index, ring = told_patch(1.0), told_patch(1.0, finger=Finger.RING)
    film.show(index, ring)
    for _ in range(4):
        film.show(ring)
    assert film.show(index, ring) == [1, 6]
    film.frame += 4
    assert film.show(index, ring) == [1, 1]


@pytest.mark.parametrize(("away_ns", "remembered"), [(150_000_000, 2), (150_000_001, 1)])
def test_a_memory_lasts_exactly_as_long_as_is_set(model: TouchModel, away_ns: int, remembered: int) -> None:
    stream = TouchStream(model, 150.0)
    stream.estimate([told_patch(1.0)], 7)
    assert stream.estimate([told_patch(1.0)], 7 + away_ns)[0].force_n == pytest.approx(0.1 * remembered)


def test_no_time_to_remember_is_no_memory(model: TouchModel) -> None:
    film = Film(model, memory_ms=0.0)
    assert [film.show(told_patch(1.0)) for _ in range(3)] == [[1], [1], [1]]


def test_after_a_reset_every_finger_starts_anew_at_any_time(model: TouchModel) -> None:
    film = Film(model)
    index, other = told_patch(1.0), told_patch(1.0, hand_id=2)
    film.show(index, other)
    film.stream.reset()
    film.frame = 0
    assert film.show(index, other) == [1, 1]
    assert film.show(index, other) == [2, 2]


def test_a_frame_that_gives_no_number_is_refused_and_not_remembered(model: TouchModel) -> None:
    film = Film(model)
    film.show(told_patch(1.0))
    with pytest.raises(ModelError, match="memory 1 gave a value that is not finite"):
        film.show(told_patch(NAN))
    assert film.show(told_patch(1.0)) == [2]


def test_without_memory_every_frame_is_judged_alone(tmp_path: Path) -> None:
    plain = TouchModel(signal_model(tmp_path))
    stream, frames = TouchStream(plain, 150.0), [[told_patch(3.0)], [], [told_patch(-1.0), told_patch(2.0, hand_id=2)]]
    for frame, patches in enumerate(frames):
        assert stream.estimate(patches, frame * FRAME_NS) == plain.estimate(patches)
