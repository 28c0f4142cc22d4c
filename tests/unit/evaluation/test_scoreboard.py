from dataclasses import replace
from typing import Any

import pytest

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.scoreboard import Count, Scoreboard, score
from egotouch_sdk.evaluation.truth import ClipTruth
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

FPS = 30.0


def at_ns(frame: int) -> int:
    return round(frame * 1e9 / FPS)


def truth_of(*spans: tuple[int, int], frames: int = 120, force_n: float = 1.0, finger: str = "index") -> ClipTruth:
    def touching(frame: int) -> bool:
        return any(start <= frame <= end for start, end in spans)

    data = {
        "fps": FPS,
        "frames": [
            {"frame": frame, "touching": touching(frame), "force_n": force_n * touching(frame), "finger": finger, "hand": "right"}
            for frame in range(frames)
        ],
        "touches": [{"start_frame": start, "end_frame": end, "force_peak_n": force_n} for start, end in spans],
    }
    return ClipTruth.from_dict(data)


def event(kind: EventType, frame: int, force_n: float = 0.0, finger: Finger = Finger.INDEX) -> TouchEvent:
    return make_event(kind, at_ns(frame), finger=finger, force_n=force_n)


def touch(start: int, end: int, force_n: float = 1.0, finger: Finger = Finger.INDEX, last: EventType = EventType.UP) -> list[TouchEvent]:
    moves = [event(EventType.MOVE, frame, force_n, finger) for frame in range(start + 1, end)]
    contact = [event(EventType.DOWN, start, force_n, finger), *moves, event(last, end, 0.0, finger)]
    return [replace(each, contact_id=start) for each in contact]


def test_a_touch_is_found_late_with_a_known_force_error() -> None:
    board = score(truth_of((10, 20)), touch(12, 21, force_n=1.5))
    assert board.touches == Count(1, 1, 0, 0)
    assert board.onset_error_ms_median == board.onset_error_ms_p95 == pytest.approx(66.667, abs=0.001)
    assert board.force_mae_n == pytest.approx(0.5)


def test_the_onset_error_is_the_median_of_absolute_errors() -> None:
    events = [*touch(9, 20), *touch(44, 55), *touch(81, 95)]
    board = score(truth_of((10, 20), (40, 55), (80, 95)), events)
    assert board.onset_error_ms_median == pytest.approx(1000 / 30)
    assert board.onset_error_ms_p95 == pytest.approx(4000 / 30)


def test_nothing_predicted_is_all_missed() -> None:
    none = Count(0, 0, 0, 0)
    gestures = {"click": Count(2, 0, 2, 0), "long_click": none, "drag": none, "force_press": none}
    assert score(truth_of((10, 20), (40, 50)), []) == Scoreboard(Count(2, 0, 2, 0), gestures, None, None, None)


def test_a_touch_where_there_is_none_is_false() -> None:
    board = score(truth_of((10, 20)), [*touch(10, 20), *touch(60, 70)])
    assert board.touches == Count(1, 1, 0, 1)


def test_a_true_touch_broken_in_two_counts_once_and_the_rest_is_false() -> None:
    board = score(truth_of((10, 40)), [*touch(10, 20), *touch(25, 40)])
    assert board.touches == Count(1, 1, 0, 1)


def test_one_long_touch_over_two_true_ones_finds_only_one() -> None:
    board = score(truth_of((10, 20), (30, 40)), touch(10, 40))
    assert board.touches == Count(2, 1, 1, 0)


def test_the_wrong_finger_is_both_missed_and_false() -> None:
    board = score(truth_of((10, 20)), touch(10, 20, finger=Finger.MIDDLE))
    assert (board.touches, board.force_mae_n) == (Count(1, 0, 1, 1), None)


def test_a_cancelled_touch_was_still_found() -> None:
    assert score(truth_of((10, 20)), touch(11, 15, last=EventType.CANCEL)).touches.found == 1


@pytest.mark.parametrize(("end", "found"), [(7, 1), (6, 0)])
def test_a_touch_may_end_three_frames_early_and_no_more(end: int, found: int) -> None:
    assert score(truth_of((10, 20)), touch(2, end)).touches.found == found


def test_a_clip_left_early_is_scored_on_what_had_begun() -> None:
    assert score(truth_of((10, 20), (60, 70)).until(at_ns(30)), touch(10, 20)).touches.missed == 0


def moving_truth(way_mm: float) -> ClipTruth:
    """A touch from frame 10 to 30 that goes `way_mm` along the host."""

    def frame(index: int) -> dict[str, Any]:
        return {
            "frame": index,
            "touching": 10 <= index <= 30,
            "force_n": 2.0 if 15 <= index <= 25 else 0.5,
            "finger": "index",
            "hand": "right",
            "at_mm": [5.0, 30.0 + way_mm * min(max(index - 10, 0), 20) / 20],
        }

    return ClipTruth.from_dict({"fps": FPS, "frames": [frame(i) for i in range(60)], "touches": [{"start_frame": 10, "end_frame": 30}]})


def with_kinds(contact: list[TouchEvent], *kinds: EventType) -> list[TouchEvent]:
    """The contact, in which these events happened at its end as well."""
    return [*contact, *(replace(event(kind, 31), contact_id=contact[0].contact_id) for kind in kinds)]


def test_a_held_true_touch_is_a_long_click_and_a_click_and_a_force_press() -> None:
    found = with_kinds(touch(11, 31), EventType.LONG_CLICK, EventType.CLICK, EventType.FORCE_ENTER)
    one, none = Count(1, 1, 0, 0), Count(0, 0, 0, 0)
    assert score(moving_truth(0.0), found).gestures == {"click": one, "long_click": one, "drag": none, "force_press": one}


def test_a_true_touch_that_moves_on_its_host_is_a_drag() -> None:
    gestures = score(moving_truth(30.0), with_kinds(touch(11, 31), EventType.DRAG_START, EventType.FORCE_ENTER)).gestures
    assert (gestures["click"], gestures["drag"]) == (Count(0, 0, 0, 0), Count(1, 1, 0, 0))


def test_another_gesture_than_the_true_one_is_missed_and_false() -> None:
    gestures = score(moving_truth(30.0), with_kinds(touch(11, 31), EventType.CLICK)).gestures
    assert (gestures["click"], gestures["drag"]) == (Count(0, 0, 0, 1), Count(1, 0, 1, 0))


def test_a_click_of_a_touch_that_was_none_is_false() -> None:
    false = [replace(each, contact_id=2) for each in [*touch(50, 55), event(EventType.CLICK, 55)]]
    gestures = score(moving_truth(0.0), [*with_kinds(touch(11, 31), EventType.CLICK), *false]).gestures
    assert gestures["click"] == Count(1, 1, 0, 1)


def test_the_settings_say_what_a_true_drag_is() -> None:
    assert score(moving_truth(30.0), [], GestureConfig(touch_slop_mm=40.0)).gestures["drag"].true == 0


def test_the_true_force_of_a_frame() -> None:
    truth = truth_of((10, 20), force_n=1.5)
    assert [truth.force_at_n(frame) for frame in (9, 10, 20, 21)] == [0.0, 1.5, 1.5, 0.0]


def test_the_dictionary_has_the_documented_keys() -> None:
    assert list(score(truth_of((10, 20)), touch(12, 21)).to_dict()) == [
        "counts",
        "onset_error_ms_median",
        "onset_error_ms_p95",
        "force_mae_n",
    ]


@pytest.mark.parametrize("data", [{}, {"fps": 30}, {"fps": "x", "frames": [], "touches": []}, {"fps": 0, "frames": [], "touches": [{}]}])
def test_truth_of_another_form_is_refused(data: dict[str, Any]) -> None:
    with pytest.raises(SourceError, match="ground truth"):
        ClipTruth.from_dict(data)
