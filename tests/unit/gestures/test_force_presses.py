"""Force presses: every timing case of the recogniser's list, in its order."""

from __future__ import annotations

from tests.support.finger import ScriptedFinger
from tests.support.gestures import CLICK, FORCE_CHANGE, FORCE_ENTER, FORCE_EXIT, MOVE, UP, pressed


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
