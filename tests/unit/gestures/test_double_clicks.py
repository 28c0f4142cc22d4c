"""Double clicks: every timing case of the recogniser's list, in its order."""

from __future__ import annotations

import pytest

from egotouch_sdk.joints import Handedness
from tests.support.finger import ScriptedFinger
from tests.support.gestures import (
    CANCEL,
    CLICK,
    DOUBLE_CLICK,
    DOWN,
    DRAGGED,
    DRAG_END,
    DRAG_START,
    ENTER,
    EXIT,
    HOVER,
    LONG_CLICK,
    MOVE,
    UP,
    clicked,
    new_finger,
    pressed,
)


def test_two_quick_clicks_are_a_double_click(finger: ScriptedFinger) -> None:
    clicked(finger).hover(2)
    finger.tap()
    finger.expect(HOVER, HOVER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 2
    assert finger.expect(DOUBLE_CLICK).click_count == 2
    finger.expect_nothing_else()


@pytest.mark.parametrize(("gap_ms", "count"), [(30, 1), (40, 2), (300, 2), (310, 1)])
def test_the_second_touch_begins_40_to_300_ms_after_the_first_ends(gap_ms: int, count: int) -> None:
    finger = clicked(new_finger(100))
    finger.hover(gap_ms // 10 - 1)
    finger.tap()
    finger.skip(HOVER)
    finger.expect(DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == count
    if count == 2:
        finger.expect(DOUBLE_CLICK)
    finger.expect_nothing_else()


@pytest.mark.parametrize(("way_mm", "count"), [(16.0, 2), (16.5, 1)])
def test_the_second_touch_begins_within_16_mm_of_the_first(finger: ScriptedFinger, way_mm: float, count: int) -> None:
    clicked(finger).x_mm += way_mm
    finger.hover()
    finger.tap()
    finger.expect(HOVER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == count
    if count == 2:
        finger.expect(DOUBLE_CLICK)
    finger.expect_nothing_else()


def test_the_place_of_a_click_is_that_of_its_down(finger: ScriptedFinger) -> None:
    pressed(finger).move(4.0)
    finger.lift()
    finger.x_mm -= 20.0
    finger.hover()
    finger.tap()
    finger.expect(MOVE, UP, CLICK, HOVER, DOWN, MOVE, MOVE, UP, CLICK, DOUBLE_CLICK)
    finger.expect_nothing_else()


def test_a_double_click_needs_no_common_pointer(finger: ScriptedFinger) -> None:
    clicked(finger).vanish(3)
    finger.hover()
    finger.tap()
    finger.expect(EXIT)
    assert finger.expect(ENTER).pointer_id == 2
    finger.expect(DOWN, MOVE, MOVE, UP, CLICK, DOUBLE_CLICK)
    finger.expect_nothing_else()


def test_a_second_touch_that_becomes_long_is_no_double_click(finger: ScriptedFinger) -> None:
    clicked(finger).hover()
    finger.touch_down()
    finger.hold(450)
    finger.lift()
    finger.hover()
    finger.tap()
    finger.expect(HOVER, DOWN)
    finger.skip(MOVE, LONG_CLICK)
    finger.expect(UP)
    assert finger.expect(CLICK).click_count == 1
    finger.expect(HOVER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    finger.expect_nothing_else()


def test_a_drag_between_two_clicks_parts_them() -> None:
    finger = clicked(new_finger(90))
    finger.hover(4)
    finger.touch_down()
    finger.move(6.0)
    finger.move(-6.0)
    finger.lift()
    finger.hover(4)
    finger.tap()
    finger.skip(HOVER)
    finger.expect(DOWN, MOVE, DRAG_START, MOVE, DRAGGED, DRAG_END, UP, HOVER, HOVER, HOVER, HOVER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    finger.expect_nothing_else()


def test_a_third_click_is_a_first_one_again(finger: ScriptedFinger) -> None:
    counts = []
    finger.hover()
    for _ in range(4):
        finger.tap()
        finger.hover()
    while finger.events:
        event = finger.events.popleft()
        counts += [event.click_count] if event.type in (CLICK, DOUBLE_CLICK) else []
    assert counts == [1, 2, 2, 1, 2, 2]


def test_a_cancel_between_two_clicks_parts_them() -> None:
    finger = clicked(new_finger(90))
    finger.hover(4)
    finger.touch_down()
    finger.vanish(3)
    finger.hover(10)
    finger.tap()
    finger.skip(HOVER)
    finger.expect(DOWN, CANCEL, EXIT, ENTER)
    finger.skip(HOVER)
    finger.expect(DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    finger.expect_nothing_else()


def test_the_same_finger_of_the_other_hand_makes_no_double_click(finger: ScriptedFinger) -> None:
    clicked(finger).handedness = Handedness.LEFT
    finger.hand_id = 2
    finger.hover()
    finger.tap()
    finger.expect(ENTER, DOWN, EXIT, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    finger.expect_nothing_else()
