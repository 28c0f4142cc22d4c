"""Clicks and long clicks: every timing case of the recogniser's list, in its order."""

from __future__ import annotations

from dataclasses import replace

import pytest

from egotouch_sdk.touch_event import EventType
from tests.support.finger import ScriptedFinger
from tests.support.gestures import CLICK, FORCE_CHANGE, FORCE_ENTER, FORCE_EXIT, LONG_CLICK, MOVE, UP, new_finger, pressed


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
