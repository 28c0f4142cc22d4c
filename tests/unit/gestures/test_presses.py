"""The five ways in which a button is pressed wrongly: slowly, fast, sideways, again, and from where nobody saw."""

from __future__ import annotations

import pytest

from tests.support.finger import ScriptedFinger
from tests.support.gestures import CLICK, DOWN, DRAGGED, DRAG_END, DRAG_START, ENTER, FLING, HOVER, MOVE, UP, clicked, new_finger, pressed


@pytest.mark.parametrize("fps", [15, 30, 60, 90])
def test_a_slow_press_through_the_threshold_is_one_touch(fps: float) -> None:
    finger = new_finger(fps)
    finger.hover()
    finger.waver(round(fps / 2))
    finger.touch_down(0.2)
    finger.waver(round(fps / 10))
    finger.lift()
    finger.expect(ENTER)
    finger.skip(HOVER)
    finger.expect(DOWN)
    finger.skip(MOVE)
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


def test_a_fast_press_of_one_frame_is_a_click(finger: ScriptedFinger) -> None:
    pressed(finger).lift()
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


def test_a_press_that_leaves_sideways_ends_without_a_click(finger: ScriptedFinger) -> None:
    pressed(finger).move(8.0)
    finger.move(8.0)
    finger.x_mm += 8.0
    finger.lift()
    finger.expect(MOVE, DRAG_START, MOVE, DRAGGED, DRAG_END, UP, FLING)
    finger.expect_nothing_else()


def test_a_press_again_without_leaving_is_a_second_touch(finger: ScriptedFinger) -> None:
    clicked(finger).touch_down()
    finger.lift()
    assert finger.expect(DOWN).contact_id == 2
    finger.expect(UP)
    assert finger.expect(CLICK).click_count == 1  # 33 ms after the first: a bounce
    finger.expect_nothing_else()


def test_a_finger_that_comes_into_sight_touching_hovers_first(finger: ScriptedFinger) -> None:
    finger.touch_down()
    finger.expect(ENTER)
    finger.expect_nothing_else()
    finger.move()
    finger.lift()
    finger.expect(DOWN, UP, CLICK)
    finger.expect_nothing_else()
