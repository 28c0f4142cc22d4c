from __future__ import annotations

import subprocess
import sys
from collections import deque

import pytest

from egotouch_sdk.config import StateConfig, TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.gestures import DragState, ForceState, PressState
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import Fingertip, GateReason, GateResult, TouchEstimate, TouchPair
from egotouch_sdk.state import PointerState
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.hands import host_hand, make_hand, palm_centre, with_tip_at

T = EventType
HOST = host_hand()
CENTRE = palm_centre(HOST)
FINGERS = (Finger.INDEX, Finger.MIDDLE)


class WatchedHand:
    """A right hand over a left palm whose two fingers are seen touching or not, in front of a whole engine in debug mode."""

    def __init__(self, fps: float = 30.0) -> None:
        self.engine = EventEngine(TouchConfig(debug=True))
        self.frame_ns = round(1e9 / fps)
        self.index = 0
        self.time_ns = 0
        self.x_px = 0.0
        self.events: deque[TouchEvent] = deque()

    def show(
        self,
        *touching: Finger,
        force_n: float = 1.0,
        sigma_n: float | None = None,
        frames: int = 1,
        seen: tuple[Finger, ...] = FINGERS,
    ) -> None:
        """Be seen for some frames with these fingers on the skin and the other one above it."""
        for _ in range(frames):
            hand = with_tip_at(make_hand(extended=FINGERS, pointing_deg=135.0), Finger.INDEX, (CENTRE[0] + self.x_px, CENTRE[1]))
            tips = tuple(
                Fingertip(
                    hand_id=1,
                    handedness=Handedness.RIGHT,
                    finger=finger,
                    tip_px=(float(hand.xy_px(finger.tip)[0]), float(hand.xy_px(finger.tip)[1])),
                    px_per_mm=2.0,
                )
                for finger in seen
            )
            estimates = tuple(
                TouchEstimate(1, tip.finger, *((0.99, force_n) if tip.finger in touching else (0.01, 0.0)), sigma_n) for tip in tips
            )
            gate = GateResult(GateReason.OPEN, (TouchPair(hand, HOST, 0.5, seen),)) if seen else GateResult(GateReason.TOO_FAR)
            self.time_ns += self.frame_ns
            observation = FrameObservation(self.index, self.time_ns, 1280, 720, (hand, HOST), gate, tips, estimates)
            self.events += self.engine.process(observation).events
            self.index += 1

    def of(self, finger: Finger) -> list[EventType]:
        """The kinds of events of one finger so far, without those of hovering and staying."""
        return [event.type for event in self.events if event.finger is finger and event.type not in (T.HOVER_MOVE, T.MOVE)]


@pytest.fixture
def hand() -> WatchedHand:
    return WatchedHand()


@pytest.mark.parametrize("fps", [15, 30, 60, 90])
def test_a_long_click_through_the_whole_engine_is_within_one_frame_of_400_ms(fps: float) -> None:
    hand = WatchedHand(fps)
    hand.show(frames=3)
    hand.show(Finger.INDEX, frames=round(fps * 0.6))
    (long_click,) = [event for event in hand.events if event.type is T.LONG_CLICK]
    assert 400.0 - 1e-3 <= long_click.duration_ms < 400.0 + 1000 / fps


def test_the_error_of_the_force_is_told_while_the_finger_is_seen_on_the_skin(hand: WatchedHand) -> None:
    hand.show(frames=3, sigma_n=0.4)
    hand.show(Finger.INDEX, force_n=2.0, frames=4, sigma_n=0.3)
    hand.show(frames=3, sigma_n=0.4)
    told = {
        event.type: event.force_sigma_n for event in hand.events if event.finger is Finger.INDEX and event.timestamp_ns < 8 * hand.frame_ns
    }
    assert told == {T.HOVER_ENTER: None, T.HOVER_MOVE: None, T.DOWN: 0.3, T.FORCE_ENTER: 0.3, T.MOVE: 0.3}
    after = {event.type: event.force_sigma_n for event in hand.events if event.type in (T.FORCE_EXIT, T.UP, T.CLICK)}
    assert after == dict.fromkeys((T.FORCE_EXIT, T.UP, T.CLICK))


def test_two_fingers_touch_independently(hand: WatchedHand) -> None:
    hand.show(frames=3)
    hand.show(Finger.INDEX, frames=3)
    hand.show(Finger.INDEX, Finger.MIDDLE, frames=3)
    hand.show(Finger.INDEX, frames=10)
    hand.show(frames=3)
    assert hand.of(Finger.INDEX) == [T.HOVER_ENTER, T.DOWN, T.LONG_CLICK, T.UP, T.CLICK]
    assert hand.of(Finger.MIDDLE) == [T.HOVER_ENTER, T.DOWN, T.UP, T.CLICK]


def test_the_end_of_a_source_ends_every_gesture_with_the_reason(hand: WatchedHand) -> None:
    hand.show(frames=3)
    hand.show(Finger.INDEX, force_n=2.0, frames=4)
    hand.events.clear()
    ended = hand.engine.finish(hand.time_ns, CancelReason.SERVER_STOPPED)
    assert [(event.type, event.finger) for event in ended if event.finger is Finger.INDEX] == [
        (T.FORCE_EXIT, Finger.INDEX),
        (T.CANCEL, Finger.INDEX),
        (T.HOVER_EXIT, Finger.INDEX),
    ]
    assert {event.reason for event in ended} == {CancelReason.SERVER_STOPPED, None}
    assert hand.engine.pointers == ()
    assert hand.engine.finish(hand.time_ns) == ()


def test_a_click_before_a_stall_is_not_half_of_a_double_click() -> None:
    """The camera stops for 251 ms; even so the second touch begins less than 300 ms after the first has ended."""
    hand = WatchedHand(fps=100)
    hand.show(frames=3)
    hand.show(Finger.INDEX, frames=5)
    hand.show(frames=2)
    hand.time_ns += 241_000_000
    hand.show(Finger.INDEX, frames=5)
    hand.show(frames=3)
    clicks = [event for event in hand.events if event.type is T.CLICK]
    downs = [event for event in hand.events if event.type is T.DOWN]
    assert (downs[1].timestamp_ns - clicks[0].timestamp_ns) / 1e6 <= 300
    assert [event.click_count for event in clicks] == [1, 1]


def test_the_pointers_tell_a_newcomer_what_is_going_on(hand: WatchedHand) -> None:
    assert hand.engine.pointers == ()
    hand.show(frames=3)
    hand.show(Finger.INDEX, force_n=2.0, frames=3)
    index, middle = hand.engine.pointers
    assert (index.pointer_id, index.contact_id, index.hand, index.finger) == (1, 1, Handedness.RIGHT, Finger.INDEX)
    assert (index.touch, index.unseen_frames, index.last_event.type) == (PointerState.TOUCH, 0, T.MOVE)
    assert (index.gestures.press, index.gestures.drag, index.gestures.force) == (PressState.HELD, DragState.STILL, ForceState.HARD)
    assert (middle.touch, middle.contact_id, middle.last_event.type) == (PointerState.HOVER, 0, T.HOVER_MOVE)
    assert middle.gestures.press is PressState.NONE
    hand.show(seen=(), frames=1)
    assert [pointer.unseen_frames for pointer in hand.engine.pointers] == [1, 1]
    hand.show(frames=3)
    assert [pointer.last_event.type for pointer in hand.engine.pointers] == [T.HOVER_MOVE, T.HOVER_MOVE]


def test_a_hand_that_leaves_the_frame_while_it_drags_is_cancelled_where_it_was_last_seen(hand: WatchedHand) -> None:
    hand.show(frames=3)
    hand.show(Finger.INDEX, frames=2)
    for _ in range(8):
        hand.x_px += 8.0
        hand.show(Finger.INDEX)
    last = next(event for event in reversed(hand.events) if event.finger is Finger.INDEX)
    assert last.type is T.DRAG
    hand.events.clear()
    hand.show(seen=(), frames=5)
    events = [event for event in hand.events if event.finger is Finger.INDEX]
    assert [(event.type, event.reason) for event in events] == [
        (T.DRAG_END, CancelReason.TRACKING_LOST),
        (T.CANCEL, CancelReason.TRACKING_LOST),
        (T.HOVER_EXIT, None),
    ]
    assert {(event.x_mm, event.y_mm) for event in events} == {(last.x_mm, last.y_mm)}


def test_the_engine_knows_no_clock() -> None:
    """So the same frames give the same events, however fast they are played."""
    script = "import egotouch_sdk.engine, sys; print('egotouch_sdk.clock' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout == "False\n"


def test_the_settings_reach_the_gestures_and_the_verifier() -> None:
    config = TouchConfig(debug=True, state=StateConfig(max_speed_mm_s=10.0, jump_slack_mm=1.0))
    hand = WatchedHand()
    hand.engine = EventEngine(config)
    hand.show(frames=3)
    hand.show(Finger.INDEX, frames=3)
    hand.x_px = 30.0
    hand.show(Finger.INDEX)
    assert hand.of(Finger.INDEX)[-3:] == [T.CANCEL, T.HOVER_EXIT, T.HOVER_ENTER]
