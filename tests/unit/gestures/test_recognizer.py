"""Every timing case of the recogniser's list, in its order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import hypot

import pytest

from egotouch_sdk.config import GestureConfig, StateConfig
from egotouch_sdk.errors import GrammarError
from egotouch_sdk.gestures import GestureRecognizer
from egotouch_sdk.gestures.table import DRAG, FORCE, PRESS, DragInput, DragState, ForceInput, ForceState, PressInput, PressState
from egotouch_sdk.joints import Handedness
from egotouch_sdk.touch_event import CancelReason, EventType
from tests.support.events import make_event
from tests.support.finger import ScriptedFinger

ENTER, HOVER, EXIT = EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT
DOWN, MOVE, UP, CANCEL = EventType.DOWN, EventType.MOVE, EventType.UP, EventType.CANCEL
CLICK, DOUBLE_CLICK, LONG_CLICK = EventType.CLICK, EventType.DOUBLE_CLICK, EventType.LONG_CLICK
DRAG_START, DRAGGED, DRAG_END, FLING = EventType.DRAG_START, EventType.DRAG, EventType.DRAG_END, EventType.FLING
FORCE_ENTER, FORCE_CHANGE, FORCE_EXIT = EventType.FORCE_ENTER, EventType.FORCE_CHANGE, EventType.FORCE_EXIT


def new_finger(fps: float = 30.0, state: StateConfig | None = None, gestures: GestureConfig | None = None) -> ScriptedFinger:
    return ScriptedFinger(state, gestures or GestureConfig(), fps)


@pytest.fixture
def finger() -> ScriptedFinger:
    return new_finger()


def pressed(finger: ScriptedFinger, force_n: float = 1.0) -> ScriptedFinger:
    finger.hover()
    finger.touch_down(force_n)
    finger.expect(ENTER, DOWN)
    return finger


def clicked(finger: ScriptedFinger) -> ScriptedFinger:
    finger.hover()
    finger.tap()
    finger.expect(ENTER, DOWN, MOVE, MOVE, UP)
    assert finger.expect(CLICK).click_count == 1
    return finger


# Clicks


def test_a_touch_and_a_lift_are_a_click(finger: ScriptedFinger) -> None:
    pressed(finger).move(0.5)
    finger.lift()
    finger.expect(MOVE)
    up = finger.expect(UP)
    click = finger.expect(CLICK)
    assert replace(click, type=UP, click_count=0) == up
    assert click.click_count == 1
    finger.expect_nothing_else()


def test_there_is_no_shortest_click() -> None:
    finger = pressed(new_finger(90))
    finger.lift()
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


@pytest.mark.parametrize("fps", [15, 24, 30, 60, 72, 90])
def test_a_long_click_comes_within_one_frame_of_400_ms(fps: float) -> None:
    finger = pressed(new_finger(fps))
    down_ns = finger.time_ns
    finger.hold(600)
    finger.skip(MOVE)
    long_click = finger.expect(LONG_CLICK)
    assert 400e6 - 1e3 <= long_click.timestamp_ns - down_ns < 400e6 + finger.frame_ns
    finger.skip(MOVE)
    finger.lift()
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


def test_a_long_click_is_never_sent_while_the_finger_is_unseen(finger: ScriptedFinger) -> None:
    pressed(finger).hold(370)
    finger.skip(MOVE)
    finger.vanish(2)
    finger.expect_nothing_else()
    finger.move()
    finger.expect(MOVE)
    assert finger.expect(LONG_CLICK).duration_ms == pytest.approx(467, abs=1)
    finger.expect_nothing_else()


def test_a_finger_that_was_unseen_at_400_ms_and_then_lifts_only_clicks(finger: ScriptedFinger) -> None:
    pressed(finger).hold(370)
    finger.skip(MOVE)
    finger.vanish(2)
    finger.lift()
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


def test_a_deep_press_brings_the_long_click_forward(finger: ScriptedFinger) -> None:
    pressed(finger, 0.5).hold(134, force_n=2.6)
    finger.expect(MOVE, FORCE_ENTER, MOVE, MOVE, MOVE)
    assert finger.expect(LONG_CLICK).duration_ms == pytest.approx(133.3, abs=0.1)
    finger.expect_nothing_else()


def test_a_deep_press_that_weakens_begins_anew(finger: ScriptedFinger) -> None:
    pressed(finger, 0.5).hold(100, force_n=2.6)
    finger.move(force_n=2.4)
    finger.hold(134, force_n=2.6)
    finger.expect(MOVE, FORCE_ENTER, MOVE, MOVE, MOVE, FORCE_CHANGE, MOVE, FORCE_CHANGE, MOVE, MOVE, MOVE, LONG_CLICK)
    finger.expect_nothing_else()


def test_a_hard_tap_is_no_long_click(finger: ScriptedFinger) -> None:
    pressed(finger, 3.0).hold(67, force_n=3.0)
    finger.lift()
    finger.expect(FORCE_ENTER, MOVE, MOVE, FORCE_EXIT, UP, CLICK)
    finger.expect_nothing_else()


@pytest.mark.parametrize(("way_mm", "events"), [(16.0, (UP, CLICK)), (16.5, (UP,))])
def test_a_finger_that_slid_away_between_two_frames_does_not_click(
    finger: ScriptedFinger, way_mm: float, events: tuple[EventType, ...]
) -> None:
    pressed(finger).x_mm += way_mm
    finger.lift()
    finger.expect(*events)
    finger.expect_nothing_else()


# Double clicks


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
    finger.hover(1)
    finger.tap()
    finger.skip(HOVER)
    finger.expect(DOWN, CANCEL, EXIT, ENTER, DOWN, MOVE, MOVE, UP)
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


# Drags


def test_a_drag_says_how_far_and_how_fast(finger: ScriptedFinger) -> None:
    pressed(finger).move(5.0)
    finger.expect(MOVE)
    finger.expect_nothing_else()
    for _ in range(4):
        finger.move(2.0, 1.0)
    finger.lift()
    finger.expect(MOVE)
    start = finger.expect(DRAG_START)
    assert (start.dx_mm, start.dy_mm) == (7.0, 1.0)
    finger.expect(MOVE, DRAGGED, MOVE, DRAGGED, MOVE)
    drag = finger.expect(DRAGGED)
    assert (drag.dx_mm, drag.dy_mm) == (13.0, 4.0)
    assert (drag.velocity_x_mm_s, drag.velocity_y_mm_s) == pytest.approx((60.0, 30.0), rel=1e-3)
    end = finger.expect(DRAG_END)
    assert (end.reason, end.force_n) == (None, 0.0)
    finger.expect(UP, FLING)
    finger.expect_nothing_else()


def test_a_finger_that_leaves_the_slop_at_400_ms_drags_and_does_not_click_long() -> None:
    finger = pressed(new_finger(100))
    finger.hold(390)
    finger.skip(MOVE)
    finger.move(5.1)
    finger.expect(MOVE)
    assert finger.expect(DRAG_START).duration_ms == 400.0
    finger.hold(100)
    finger.skip(MOVE, DRAGGED)
    finger.lift()
    finger.expect(DRAG_END, UP)
    finger.expect_nothing_else()


def test_a_drag_may_begin_after_a_long_click(finger: ScriptedFinger) -> None:
    pressed(finger).hold(400)
    finger.skip(MOVE)
    finger.expect(LONG_CLICK)
    finger.move(6.0)
    finger.hold(134)
    finger.lift()
    finger.expect(MOVE, DRAG_START)
    finger.skip(MOVE, DRAGGED)
    finger.expect(DRAG_END, UP)
    finger.expect_nothing_else()


def test_coming_back_does_not_end_a_drag(finger: ScriptedFinger) -> None:
    pressed(finger).move(6.0)
    finger.move(-6.0)
    finger.move()
    finger.expect(MOVE, DRAG_START, MOVE, DRAGGED, MOVE, DRAGGED)
    finger.expect_nothing_else()


@pytest.mark.parametrize(("speed_mm_s", "flung_mm_s"), [(49.0, None), (51.0, 51.0), (1200.0, 1200.0), (2500.0, 1270.0)])
@pytest.mark.parametrize("fps", [15, 30, 60, 90])
def test_a_fast_lift_is_a_fling(fps: float, speed_mm_s: float, flung_mm_s: float | None) -> None:
    finger = pressed(new_finger(fps))
    step_mm = speed_mm_s * finger.frame_ns / 1e9
    for _ in range(round(fps / 3)):
        finger.move(0.6 * step_mm, 0.8 * step_mm)
    finger.lift()
    finger.skip(MOVE, DRAG_START, DRAGGED)
    finger.expect(DRAG_END)
    up = finger.expect(UP)
    assert hypot(up.velocity_x_mm_s, up.velocity_y_mm_s) == pytest.approx(speed_mm_s)
    if flung_mm_s:
        fling = finger.expect(FLING)
        assert (fling.velocity_x_mm_s, fling.velocity_y_mm_s) == pytest.approx((0.6 * flung_mm_s, 0.8 * flung_mm_s))
    finger.expect_nothing_else()


@pytest.mark.parametrize("fps", [15, 30, 60, 90])
def test_a_drag_that_comes_to_rest_before_the_lift_is_no_fling(fps: float) -> None:
    finger = pressed(new_finger(fps))
    for _ in range(10):
        finger.move(6.0)
    finger.hold(max(45, 2 * finger.frame_ns / 1e6))
    finger.lift()
    finger.skip(MOVE, DRAG_START, DRAGGED)
    finger.expect(DRAG_END, UP)
    finger.expect_nothing_else()


def test_a_drag_that_was_unseen_before_the_lift_is_no_fling(finger: ScriptedFinger) -> None:
    pressed(finger)
    for _ in range(5):
        finger.move(6.0)
    finger.vanish(2)
    finger.lift()
    finger.skip(MOVE, DRAG_START, DRAGGED)
    finger.expect(DRAG_END)
    up = finger.expect(UP)
    assert (up.velocity_x_mm_s, up.velocity_y_mm_s) == (0.0, 0.0)
    finger.expect_nothing_else()


def test_a_lift_outside_the_slop_begins_no_drag(finger: ScriptedFinger) -> None:
    pressed(finger).x_mm += 10.0
    finger.lift()
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


# Force presses


def test_a_force_press_enters_changes_and_exits(finger: ScriptedFinger) -> None:
    pressed(finger)
    for force_n in (1.49, 1.5, 1.59, 1.61, 1.3, 1.19, 1.3):
        finger.move(force_n=force_n)
    finger.expect(MOVE, MOVE)
    assert finger.expect(FORCE_ENTER).force_n == 1.5
    finger.expect(MOVE, MOVE)
    assert finger.expect(FORCE_CHANGE).force_n == 1.61
    finger.expect(MOVE, FORCE_CHANGE, MOVE)
    exit_event = finger.expect(FORCE_EXIT)
    assert (exit_event.force_n, exit_event.reason) == (1.19, None)
    finger.expect(MOVE)
    finger.expect_nothing_else()


def test_a_finger_may_land_hard_and_lift_hard(finger: ScriptedFinger) -> None:
    pressed(finger, 2.0).lift()
    finger.expect(FORCE_ENTER)
    exit_event = finger.expect(FORCE_EXIT)
    assert (exit_event.force_n, exit_event.reason) == (0.0, None)
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()


# In all of them: the ways in which a camera can lose a finger

Loss = Callable[[ScriptedFinger], None]


def lose(finger: ScriptedFinger) -> None:
    finger.vanish(3)


def swap(finger: ScriptedFinger) -> None:
    finger.hand_id += 1
    finger.touch_down()


def change_sides(finger: ScriptedFinger) -> None:
    finger.handedness = Handedness.LEFT
    finger.touch_down()


def jump(finger: ScriptedFinger) -> None:
    finger.move(200.0)


def stall(finger: ScriptedFinger) -> None:
    finger.stall(300_000_000)
    finger.touch_down()


def end(finger: ScriptedFinger) -> None:
    finger.end()


LOSSES = [
    (lose, CancelReason.TRACKING_LOST),
    (swap, CancelReason.HAND_SWAPPED),
    (change_sides, CancelReason.HAND_SWAPPED),
    (jump, CancelReason.HAND_SWAPPED),
    (stall, CancelReason.SOURCE_STALLED),
    (end, CancelReason.SOURCE_ENDED),
]


@pytest.mark.parametrize(("loss", "reason"), LOSSES)
def test_a_finger_that_is_lost_while_it_presses_is_cancelled(finger: ScriptedFinger, loss: Loss, reason: CancelReason) -> None:
    pressed(finger).hold(100)
    loss(finger)
    finger.expect(MOVE, MOVE, MOVE)
    assert finger.expect(CANCEL).reason is reason
    finger.expect(EXIT)
    finger.skip(ENTER)
    finger.expect_nothing_else()


@pytest.mark.parametrize(("loss", "reason"), LOSSES)
def test_a_finger_that_is_lost_in_a_drag_ends_it_with_the_reason_and_does_not_fling(
    finger: ScriptedFinger, loss: Loss, reason: CancelReason
) -> None:
    pressed(finger)
    for _ in range(3):
        finger.move(10.0)
    place = finger.x_mm
    loss(finger)
    finger.expect(MOVE, DRAG_START, MOVE, DRAGGED, MOVE, DRAGGED)
    drag_end = finger.expect(DRAG_END)
    cancel = finger.expect(CANCEL)
    assert (drag_end.reason, cancel.reason) == (reason, reason)
    assert (drag_end.x_mm, cancel.x_mm) == (place, place)
    finger.expect(EXIT)
    finger.skip(ENTER)
    finger.expect_nothing_else()


@pytest.mark.parametrize(("loss", "reason"), LOSSES)
def test_a_finger_that_is_lost_in_a_forceful_drag_ends_both_with_the_reason(
    finger: ScriptedFinger, loss: Loss, reason: CancelReason
) -> None:
    pressed(finger).move(10.0, force_n=2.0)
    loss(finger)
    finger.expect(MOVE, DRAG_START, FORCE_ENTER)
    ends = [finger.expect(DRAG_END), finger.expect(FORCE_EXIT), finger.expect(CANCEL)]
    assert [event.reason for event in ends] == [reason] * 3
    assert [event.force_n for event in ends] == [0.0] * 3
    finger.expect(EXIT)
    finger.skip(ENTER)
    finger.expect_nothing_else()


@pytest.mark.parametrize("dropped", [1, 2])
def test_dropped_frames_change_nothing_but_the_number_of_moves(finger: ScriptedFinger, dropped: int) -> None:
    pressed(finger).move(10.0, force_n=2.0)
    finger.vanish(dropped)
    finger.move(1.0, force_n=2.0)
    finger.expect(MOVE, DRAG_START, FORCE_ENTER, MOVE, DRAGGED)
    finger.expect_nothing_else()


# The five ways in which a button is pressed wrongly


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


def test_a_move_without_a_down_is_refused() -> None:
    with pytest.raises(GrammarError, match="move of pointer 1 comes without a down"):
        GestureRecognizer(GestureConfig()).feed([make_event(MOVE)])


# The tables


def test_the_tables_know_every_input_of_every_state() -> None:
    for table, states, inputs in ((DRAG, DragState, DragInput), (FORCE, ForceState, ForceInput), (PRESS, PressState, PressInput)):
        for state in states:
            known = {cause for where, cause in table if where is state}
            missing = set(inputs) - known
            if state is PressState.NONE:
                assert known == {PressInput.LANDED}
            elif states is PressState:
                assert missing == {PressInput.LANDED}
            else:
                assert missing == ({ForceInput.STEADY} if state is ForceState.SOFT else set())
