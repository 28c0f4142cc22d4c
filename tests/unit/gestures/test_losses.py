"""The ways in which a camera can lose a finger: coast, then cancel; never a lift, a click or a jump."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from egotouch_sdk.joints import Handedness
from egotouch_sdk.touch_event import CancelReason
from tests.support.finger import ScriptedFinger
from tests.support.gestures import (
    CANCEL,
    CLICK,
    DOWN,
    DRAGGED,
    DRAG_END,
    DRAG_START,
    ENTER,
    EXIT,
    FORCE_ENTER,
    FORCE_EXIT,
    HOVER,
    MOVE,
    UP,
    pressed,
)

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


@pytest.mark.parametrize("loss", [lose, swap, change_sides, jump, stall], ids=lambda loss: loss.__name__)
def test_a_finger_that_is_found_pressing_does_not_click_when_it_lifts(finger: ScriptedFinger, loss: Loss) -> None:
    pressed(finger)
    loss(finger)
    for _ in range(20):
        finger.move()
    finger.lift()
    finger.skip(CANCEL, EXIT, ENTER, DOWN, MOVE)
    finger.expect(UP)
    finger.expect_nothing_else()


def test_it_clicks_again_once_it_was_seen_to_land(finger: ScriptedFinger) -> None:
    pressed(finger)
    lose(finger)
    finger.hover(4)
    finger.tap()
    finger.skip(CANCEL, EXIT, ENTER, HOVER, DOWN, MOVE)
    finger.expect(UP, CLICK)
    finger.expect_nothing_else()
