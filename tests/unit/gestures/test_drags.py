"""Drags and flings: every timing case of the recogniser's list, in its order."""

from __future__ import annotations

from math import hypot

import pytest

from tests.support.finger import ScriptedFinger
from tests.support.gestures import CLICK, DRAGGED, DRAG_END, DRAG_START, FLING, LONG_CLICK, MOVE, UP, new_finger, pressed


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
