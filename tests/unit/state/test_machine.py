from __future__ import annotations

from dataclasses import replace

import pytest

from egotouch_sdk.config import StateConfig
from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.state import Thresholds
from egotouch_sdk.state.table import REASONS, TABLE, Input, PointerState
from egotouch_sdk.touch_event import CancelReason, EventType
from tests.support.finger import FRAME_NS, ScriptedFinger

ENTER, HOVER, EXIT = EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT
DOWN, MOVE, UP, CANCEL = EventType.DOWN, EventType.MOVE, EventType.UP, EventType.CANCEL


@pytest.fixture
def finger() -> ScriptedFinger:
    return ScriptedFinger()


def pressed(finger: ScriptedFinger) -> ScriptedFinger:
    finger.hover()
    finger.touch_down()
    finger.expect(ENTER, DOWN)
    return finger


def test_a_tap(finger: ScriptedFinger) -> None:
    finger.hover(2)
    finger.touch_down(force_n=1.5)
    finger.move(1.0, force_n=2.0)
    finger.lift()
    finger.hover()
    finger.expect(ENTER, HOVER)
    down = finger.expect(DOWN)
    assert (down.pointer_id, down.contact_id, down.force_n, down.timestamp_ns) == (1, 1, 1.5, 3 * FRAME_NS)
    assert finger.expect(MOVE).force_n == 2.0
    up = finger.expect(UP)
    assert (up.pointer_id, up.contact_id, up.force_n, up.reason) == (1, 1, 0.0, None)
    finger.expect(HOVER)
    finger.expect_nothing_else()


def test_a_finger_that_appears_touching_goes_down_one_frame_later(finger: ScriptedFinger) -> None:
    finger.touch_down()
    finger.expect(ENTER)
    finger.expect_nothing_else()
    finger.move()
    finger.expect(DOWN)
    finger.expect_nothing_else()


def test_between_the_thresholds_nothing_begins(finger: ScriptedFinger) -> None:
    finger.hover()
    finger.waver(3)
    finger.expect(ENTER, HOVER, HOVER, HOVER)
    finger.expect_nothing_else()


def test_between_the_thresholds_nothing_ends(finger: ScriptedFinger) -> None:
    pressed(finger).waver(3)
    finger.expect(MOVE, MOVE, MOVE)
    finger.expect_nothing_else()


def test_a_second_touch_is_the_next_contact_of_the_same_pointer(finger: ScriptedFinger) -> None:
    pressed(finger).lift()
    finger.touch_down()
    finger.expect(UP)
    down = finger.expect(DOWN)
    assert (down.pointer_id, down.contact_id) == (1, 2)
    finger.expect_nothing_else()


@pytest.mark.parametrize("frames", [1, 2])
def test_a_short_loss_is_bridged(finger: ScriptedFinger, frames: int) -> None:
    pressed(finger).vanish(frames)
    finger.expect_nothing_else()
    finger.move()
    finger.expect(MOVE)
    finger.expect_nothing_else()


def test_a_lift_seen_after_a_bridge_is_a_lift(finger: ScriptedFinger) -> None:
    pressed(finger).vanish(2)
    finger.lift()
    finger.expect(UP)
    finger.expect_nothing_else()


def test_a_long_loss_cancels_at_the_third_unseen_frame(finger: ScriptedFinger) -> None:
    pressed(finger).vanish(3)
    cancel = finger.expect(CANCEL)
    assert (cancel.reason, cancel.timestamp_ns, cancel.force_n) == (CancelReason.TRACKING_LOST, 5 * FRAME_NS, 0.0)
    finger.expect(EXIT)
    finger.expect_nothing_else()


def test_losses_do_not_add_up(finger: ScriptedFinger) -> None:
    pressed(finger)
    for _ in range(3):
        finger.vanish(2)
        finger.move()
        finger.expect(MOVE)
    finger.expect_nothing_else()


def test_a_hovering_finger_that_is_lost_just_leaves(finger: ScriptedFinger) -> None:
    finger.hover()
    finger.vanish(5)
    finger.expect(ENTER, EXIT)
    finger.expect_nothing_else()


def test_a_finger_that_comes_back_is_a_new_pointer(finger: ScriptedFinger) -> None:
    finger.hover()
    finger.vanish(3)
    finger.hover()
    finger.expect(ENTER, EXIT)
    assert finger.expect(ENTER).pointer_id == 2
    finger.expect_nothing_else()


def test_a_stalled_camera_cancels(finger: ScriptedFinger) -> None:
    pressed(finger).stall(250_000_001)
    finger.touch_down()
    assert finger.expect(CANCEL).reason is CancelReason.SOURCE_STALLED
    finger.expect(EXIT)
    assert finger.expect(ENTER).pointer_id == 2
    finger.expect_nothing_else()


def test_a_gap_of_exactly_the_limit_is_no_stall(finger: ScriptedFinger) -> None:
    pressed(finger).stall(250_000_000)
    finger.move()
    finger.expect(MOVE)
    finger.expect_nothing_else()


def test_a_teleport_is_another_pointer_and_never_a_move(finger: ScriptedFinger) -> None:
    pressed(finger).move(150.0)
    assert finger.expect(CANCEL).reason is CancelReason.HAND_SWAPPED
    finger.expect(EXIT)
    entered = finger.expect(ENTER)
    assert (entered.pointer_id, entered.contact_id) == (2, 0)
    finger.expect_nothing_else()


def test_a_swipe_at_two_metres_per_second_stays_one_touch(finger: ScriptedFinger) -> None:
    pressed(finger)
    for _ in range(4):
        finger.move(67.0)
    finger.expect(MOVE, MOVE, MOVE, MOVE)
    finger.expect_nothing_else()


def test_a_turning_head_moves_the_image_but_not_the_finger_on_its_host(finger: ScriptedFinger) -> None:
    pressed(finger)
    still = finger.sample(0.9, 1.0)
    turned = replace(still, tip_px=(still.tip_px[0] + 400, still.tip_px[1]))
    finger.verifier.feed(events := finger.machine.step([turned], finger.time_ns + FRAME_NS))
    assert [event.type for event in events] == [MOVE]
    finger.expect_nothing_else()


def test_a_noisy_host_does_not_end_a_hover(finger: ScriptedFinger) -> None:
    finger.hover()
    still = finger.sample(0.1)
    noisy = replace(still, point=replace(still.point, x_mm=150.0))
    events = finger.machine.step([noisy], finger.time_ns + FRAME_NS)
    assert [event.type for event in events] == [HOVER]


def test_a_touch_that_jumps_on_the_limb_is_cancelled_also_when_the_image_stands_still(finger: ScriptedFinger) -> None:
    pressed(finger)
    still = finger.sample(0.9, 1.0)
    finger.verifier.feed(events := finger.machine.step([replace(still, point=replace(still.point, x_mm=150.0))], finger.time_ns + FRAME_NS))
    assert [event.type for event in events] == [CANCEL, EXIT, ENTER]
    finger.expect_nothing_else()


@pytest.mark.parametrize("reason", CancelReason)
def test_whatever_ends_the_source_is_the_reason(finger: ScriptedFinger, reason: CancelReason) -> None:
    pressed(finger).end(reason)
    assert finger.expect(CANCEL).reason is reason
    finger.expect(EXIT)
    finger.expect_nothing_else()


def test_another_hand_id_on_this_side_is_another_finger(finger: ScriptedFinger) -> None:
    pressed(finger).hand_id = 7
    finger.touch_down()
    assert finger.expect(CANCEL).reason is CancelReason.HAND_SWAPPED
    finger.expect(EXIT, ENTER)
    finger.expect_nothing_else()


def test_a_hand_that_changes_sides_is_cancelled_at_once(finger: ScriptedFinger) -> None:
    pressed(finger).handedness = Handedness.LEFT
    finger.touch_down()
    cancel = finger.expect(CANCEL)
    assert (cancel.reason, cancel.hand) == (CancelReason.HAND_SWAPPED, Handedness.RIGHT)
    finger.expect(EXIT)
    assert finger.expect(ENTER).hand is Handedness.LEFT
    finger.expect_nothing_else()


def test_the_end_of_the_source_cancels_once(finger: ScriptedFinger) -> None:
    pressed(finger).end()
    cancel = finger.expect(CANCEL)
    assert (cancel.reason, cancel.timestamp_ns) == (CancelReason.SOURCE_ENDED, 2 * FRAME_NS)
    finger.expect(EXIT)
    finger.end()
    finger.expect_nothing_else()


def test_pointer_ids_go_on_after_the_end_of_a_source(finger: ScriptedFinger) -> None:
    finger.hover()
    finger.end()
    finger.hover()
    finger.expect(ENTER, EXIT)
    assert finger.expect(ENTER).pointer_id == 2
    finger.expect_nothing_else()


def test_no_coasting_when_it_is_switched_off() -> None:
    finger = pressed(ScriptedFinger(StateConfig(coast_frames=0)))
    finger.vanish()
    finger.expect(CANCEL, EXIT)
    finger.expect_nothing_else()


def test_time_that_does_not_rise_is_refused_and_changes_nothing(finger: ScriptedFinger) -> None:
    pressed(finger)
    with pytest.raises(FrameError, match="not after"):
        finger.machine.step([], finger.time_ns)
    finger.move()
    finger.expect(MOVE)
    finger.expect_nothing_else()


def test_two_samples_of_one_finger_are_refused(finger: ScriptedFinger) -> None:
    sample = finger.sample(0.1)
    with pytest.raises(FrameError, match="same finger"):
        finger.machine.step([sample, replace(sample, hand_id=2)], FRAME_NS)
    finger.expect_nothing_else()


def test_the_table_knows_every_input_of_an_open_pointer() -> None:
    for state in (PointerState.HOVER, PointerState.TOUCH):
        assert {cause for known, cause in TABLE if known is state} == set(Input)
    assert set(REASONS.values()) == set(CancelReason) - {CancelReason.DISCONNECTED, CancelReason.SERVER_STOPPED}


@pytest.mark.parametrize(("down", "up"), [(0.4, 0.6), (1.0, 0.5), (0.5, 0.0)])
def test_impossible_thresholds_are_refused(down: float, up: float) -> None:
    with pytest.raises(ConfigError, match="thresholds"):
        Thresholds(down, up)
