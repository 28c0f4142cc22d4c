"""The façade with a played finger: real threads, real event engine."""

from __future__ import annotations

import asyncio
import signal
import threading
import weakref
from collections.abc import Collection

import pytest

from egotouch_sdk import EgoTouch, PushSource, TouchConfig, TouchEvent, TouchListener, TrackingState
from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.joints import Handedness
from egotouch_sdk.listeners import ErrorEvent
from egotouch_sdk.observation import GateReason
from egotouch_sdk.sources.push import WhenFull
from egotouch_sdk.touch_event import CancelReason, EventType
from tests.support.hands import make_hand
from tests.support.listening import PlayedFinger
from tests.support.sources import ScriptedHands, grey_frame

PATIENCE_S = 30.0
TAP = ["hover_enter", "down", "up", "click"]


class Heard(TouchListener):
    """Everything that was heard, moves left out, and a way to wait for something."""

    def __init__(self, et: EgoTouch) -> None:
        self.events: list[TouchEvent] = []
        self.states: list[TrackingState] = []
        self.errors: list[ErrorEvent] = []
        self._changed = threading.Condition()
        for register in (et.onHoverEnter, et.onTouchDown, et.onTouchUp, et.onTouchCancel, et.onClick, et.onHoverExit):
            register(self._take)
        et.addListener(self)

    def _take(self, event: TouchEvent) -> None:
        with self._changed:
            self.events.append(event)
            self._changed.notify_all()

    def onTrackingChanged(self, state: TrackingState) -> None:
        self.states.append(state)

    def onError(self, error: ErrorEvent) -> None:
        self.errors.append(error)

    @property
    def types(self) -> list[str]:
        return [event.type.value for event in self.events]

    def wait_for(self, event_type: str) -> TouchEvent:
        """The last event of a type, once there is one."""
        with self._changed:
            assert self._changed.wait_for(lambda: event_type in self.types, PATIENCE_S), self.types
        return next(event for event in reversed(self.events) if event.type == event_type)


def test_a_tap_reaches_the_listeners_and_the_end_of_the_source_ends_the_run() -> None:
    finger = PlayedFinger()
    finger.tap()
    finger.end()
    with EgoTouch(finger, realtime=False) as et:
        heard = Heard(et)
        et.run()
    assert heard.types == [*TAP, "hover_exit"]
    assert finger.closed >= 1
    assert (et.stats.frames, et.stats.merged, et.stats.listener_errors) == (9, 0, 0)


def test_every_event_is_heard_in_order_and_keeps_the_grammar() -> None:
    finger = PlayedFinger()
    for _ in range(20):
        finger.tap()
    finger.leave()
    finger.end()
    heard: list[TouchEvent] = []

    class All(TouchListener):
        pass

    names = [name for name in vars(TouchListener) if name.startswith("on") and name not in ("onError", "onTrackingChanged")]
    listener = type("All", (TouchListener,), {name: lambda self, event: heard.append(event) for name in names})()
    with EgoTouch(finger, TouchConfig(debug=True), realtime=False) as et:
        et.addListener(listener)
        et.run()
    verifier = GrammarVerifier()
    verifier.feed(heard)
    assert verifier.close() == ()
    assert verifier.violations == []
    assert len(heard) == et.stats.events
    assert [event.type for event in heard].count(EventType.DOWN) == 20


def test_stop_cancels_an_open_touch_and_is_idempotent() -> None:
    finger = PlayedFinger(is_live=True)
    et = EgoTouch(finger, TouchConfig(state={"stall_ms": 60_000}))
    heard = Heard(et)
    et.start()
    et.start()
    finger.touch()
    heard.wait_for("down")
    et.stop()
    et.stop()
    assert heard.types == ["hover_enter", "down", "cancel", "hover_exit"]
    assert heard.wait_for("cancel").reason is CancelReason.SOURCE_ENDED
    assert finger.closed >= 1
    with pytest.raises(SourceError, match="has been stopped"):
        et.start()


def test_an_exception_in_the_block_stops_too() -> None:
    finger = PlayedFinger(is_live=True)
    et = EgoTouch(finger, TouchConfig(state={"stall_ms": 60_000}))
    heard = Heard(et)

    def app() -> None:
        with et:
            et.start()
            finger.touch()
            heard.wait_for("down")
            raise ValueError("app")

    with pytest.raises(ValueError, match="app"):
        app()
    assert heard.wait_for("cancel").reason is CancelReason.SOURCE_ENDED


def test_a_listener_may_stop_the_run() -> None:
    finger = PlayedFinger()
    finger.tap()
    with EgoTouch(finger, realtime=False) as et:
        heard = Heard(et)
        et.onClick(lambda event: et.stop())
        et.run()
    assert heard.types == [*TAP, "hover_exit"]


def test_a_stalled_camera_cancels_and_goes_on() -> None:
    finger = PlayedFinger(is_live=True)
    with EgoTouch(finger, TouchConfig(state={"stall_ms": 400}, debug=True)) as et:
        heard = Heard(et)
        et.start()
        finger.touch()
        cancel = heard.wait_for("cancel")
        assert cancel.reason is CancelReason.SOURCE_STALLED
        assert cancel.timestamp_ns == 5 * 33_333_333
        finger.tap()
        heard.wait_for("click")
    assert heard.types == ["hover_enter", "down", "cancel", "hover_exit", *TAP, "hover_exit"]
    assert heard.events[0].pointer_id != heard.events[-1].pointer_id


def test_a_source_that_fails_cancels_and_is_heard_twice() -> None:
    finger = PlayedFinger()
    finger.touch()
    finger.fail(SourceError("the camera was unplugged"))
    et = EgoTouch(finger, realtime=False)
    heard = Heard(et)
    with pytest.raises(SourceError, match="unplugged"):
        et.run()
    et.stop()
    assert heard.wait_for("cancel").reason is CancelReason.SOURCE_STALLED
    assert [(error.site, str(error.error)) for error in heard.errors] == [("source", "the camera was unplugged")]


def test_a_failed_source_raises_in_stop_once() -> None:
    finger = PlayedFinger()
    finger.fail(SourceError("the camera was unplugged"))
    et = EgoTouch(finger)
    failed = threading.Event()
    et.onError(lambda error: failed.set())
    et.start()
    assert failed.wait(PATIENCE_S)
    with pytest.raises(SourceError, match="unplugged"):
        et.stop()
    et.stop()


def test_ctrl_c_ends_the_run_without_an_exception() -> None:
    finger = PlayedFinger(is_live=True)
    with EgoTouch(finger, TouchConfig(state={"stall_ms": 60_000})) as et:
        heard = Heard(et)
        et.onTouchDown(lambda event: signal.raise_signal(signal.SIGINT))
        finger.touch()
        et.run()
    assert heard.types == ["hover_enter", "down", "cancel", "hover_exit"]


def test_a_throwing_listener_does_not_stop_the_others(caplog: pytest.LogCaptureFixture) -> None:
    finger = PlayedFinger()
    finger.tap()
    finger.end()
    with EgoTouch(finger, realtime=False) as et:
        et.onTouchDown(lambda event: 1 / 0)
        heard = Heard(et)
        et.run()
    assert heard.types == [*TAP, "hover_exit"]
    assert [type(error.error) for error in heard.errors] == [ZeroDivisionError]
    assert et.stats.listener_errors == 1


def test_tracking_is_reported_when_it_changes() -> None:
    finger = PlayedFinger()
    finger.leave()
    finger.hover()
    finger.leave()
    finger.end()
    with EgoTouch(finger, realtime=False) as et:
        heard = Heard(et)
        et.run()
    left, both = (Handedness.LEFT,), (Handedness.LEFT, Handedness.RIGHT)
    assert [(state.hands, state.gate) for state in heard.states] == [
        (left, GateReason.NO_HOST),
        (both, GateReason.OPEN),
        (left, GateReason.NO_HOST),
        ((), GateReason.NO_HANDS),
    ]


def test_replays_give_the_same_events_at_any_speed() -> None:
    def play(realtime: bool) -> list[TouchEvent]:
        finger = PlayedFinger()
        finger.tap()
        finger.end()
        with EgoTouch(finger, realtime=realtime) as et:
            heard = Heard(et)
            et.run()
        return heard.events

    assert play(realtime=False) == play(realtime=True)


def test_a_source_that_cannot_be_opened_raises_at_the_start() -> None:
    with EgoTouch("no-such-video.mp4") as et, pytest.raises(SourceError, match="no such source"):
        et.run()


def test_perception_has_no_place_before_observations() -> None:
    finger = PlayedFinger()
    with EgoTouch(finger, hands=ScriptedHands()) as et, pytest.raises(ConfigError, match="hands= and touch="):
        et.start()
    assert finger.closed


def test_a_headsets_own_hands_and_pushed_frames() -> None:
    hands = ScriptedHands()
    hands.hands = (make_hand(),)
    camera = PushSource(capacity=8)
    with EgoTouch(camera, hands=hands) as et:
        heard = Heard(et)
        et.start()
        for index in range(3):
            camera.push(grey_frame(index).image)
        camera.close()
        et.run()
    assert et.stats.frames == 3
    assert heard.states[0].hands == (Handedness.RIGHT,)


def test_several_asynchronous_consumers_see_everything() -> None:
    finger = PlayedFinger()
    finger.tap()
    finger.end()

    async def collect(et: EgoTouch, *types: str | Collection[str]) -> list[str]:
        return [event.type.value async for event in et.events(*types)]

    async def consume() -> list[list[str]]:
        async with EgoTouch(finger, realtime=False) as et:
            return await asyncio.gather(collect(et, "down", "up", "click"), collect(et, {"hover_enter", "hover_exit"}))

    assert asyncio.run(consume()) == [["down", "up", "click"], ["hover_enter", "hover_exit"]]


def test_an_asynchronous_consumer_gets_the_sources_error_once() -> None:
    finger = PlayedFinger()
    finger.tap()
    finger.fail(SourceError("the camera was unplugged"))
    seen: list[str] = []

    async def consume() -> None:
        async with EgoTouch(finger, realtime=False) as et:
            async for event in et.events(["click", "hover_exit"]):
                seen.append(event.type.value)  # noqa: PERF401 - what was seen before the error counts

    with pytest.raises(SourceError, match="unplugged"):
        asyncio.run(consume())
    assert seen == ["click", "hover_exit"]


def test_a_consumer_that_stops_early_frees_its_queue_and_ends_the_block() -> None:
    finger = PlayedFinger(is_live=True)
    finger.tap()

    async def consume() -> None:
        async with EgoTouch(finger, TouchConfig(state={"stall_ms": 60_000})) as et:
            freed = threading.Event()
            stream = et.events("down")
            weakref.finalize(stream, freed.set)
            async for _ in stream:
                break
            del stream
            assert await asyncio.to_thread(freed.wait, PATIENCE_S)

    asyncio.run(asyncio.wait_for(consume(), PATIENCE_S))
    assert finger.closed


def test_a_stream_asked_for_after_the_end_is_empty() -> None:
    finger = PlayedFinger()
    finger.end()

    async def consume() -> list[TouchEvent]:
        et = EgoTouch(finger, realtime=False)
        await asyncio.to_thread(et.run)
        return [event async for event in et.events()]

    assert asyncio.run(consume()) == []


def test_stop_ends_a_source_that_waits_for_the_app() -> None:
    camera = PushSource(when_full=WhenFull.BLOCK)
    et = EgoTouch(camera, hands=ScriptedHands())
    et.start()
    et.stop()
    with pytest.raises(SourceError, match="closed"):
        camera.push(grey_frame(0).image)
