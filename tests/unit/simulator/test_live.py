"""Fingers played by pages become one scene, and never a stuck touch."""

from __future__ import annotations

from math import pi
from typing import Any

import pytest

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import GateReason
from egotouch_sdk.simulator import LiveSimulation, LiveSource, SimulatedFinger, fingers_from_proto
from egotouch_sdk.simulator.live import STALE_NS
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

FRAME_NS = 16_666_667
TOUCHING = SimulatedFinger(Surface.PALM, 5.0, 40.0, force_n=1.2)
HOVERING = SimulatedFinger(Surface.PALM, 5.0, 40.0, hover_mm=12.0)
STREAM = {EventType.HOVER_MOVE, EventType.MOVE, EventType.FORCE_CHANGE, EventType.DRAG}


class Stage:
    """A live simulation in front of a real engine; every step is one frame."""

    def __init__(self) -> None:
        self.simulation = LiveSimulation()
        self.engine = EventEngine(TouchConfig(debug=True))
        self.now_ns = 0

    def play(self, *fingers: SimulatedFinger, player: str = "page", frames: int = 8) -> list[TouchEvent]:
        """What happens, apart from moves, while a page plays these fingers and sends them again with every frame."""
        events: list[TouchEvent] = []
        for _ in range(frames):
            self.simulation.play(player, fingers)
            events += self.wait(1)
        return events

    def wait(self, frames: int) -> list[TouchEvent]:
        """What happens, apart from moves, while nobody sends anything."""
        events: list[TouchEvent] = []
        for _ in range(frames):
            events += self.engine.process(self.simulation.observe(self.now_ns)).events
            self.now_ns += FRAME_NS
        return [event for event in events if event.type not in STREAM]


def kinds(events: list[TouchEvent]) -> list[EventType]:
    return [event.type for event in events]


def test_a_played_press_and_lift_is_a_click_where_it_was_played() -> None:
    stage = Stage()
    assert kinds(stage.play(HOVERING)) == [EventType.HOVER_ENTER]
    (down,) = stage.play(TOUCHING, frames=6)
    assert (down.type, down.hand, down.finger, down.surface) == (EventType.DOWN, Handedness.RIGHT, Finger.INDEX, Surface.PALM)
    assert (down.x_mm, down.y_mm) == pytest.approx((5.0, 40.0), abs=2.0)
    assert down.force_n == pytest.approx(1.2)
    assert kinds(stage.play(HOVERING)) == [EventType.UP, EventType.CLICK]
    assert kinds(stage.play()) == [EventType.HOVER_EXIT]


def test_a_page_that_leaves_while_touching_cancels() -> None:
    stage = Stage()
    stage.play(HOVERING)
    stage.play(TOUCHING)
    stage.simulation.leave("page")
    cancel, hover_exit = stage.wait(10)
    assert (cancel.type, cancel.reason, hover_exit.type) == (EventType.CANCEL, CancelReason.TRACKING_LOST, EventType.HOVER_EXIT)


def test_a_page_that_hangs_while_touching_cancels_too() -> None:
    stage = Stage()
    stage.play(HOVERING)
    stage.play(TOUCHING)
    until_stale = STALE_NS // FRAME_NS
    assert EventType.CANCEL not in kinds(stage.wait(until_stale))
    assert kinds(stage.wait(10)) == [EventType.CANCEL, EventType.HOVER_EXIT]


def test_a_page_that_left_may_leave_again() -> None:
    simulation = LiveSimulation()
    simulation.leave("never seen")
    assert simulation.observe(0).gate.reason is GateReason.NO_HOST


def test_two_pages_play_two_hands_at_once() -> None:
    stage = Stage()
    left = SimulatedFinger(Surface.BACK_OF_HAND, 0.0, 50.0, force_n=1.0, hand=Handedness.LEFT)
    stage.simulation.play("other", (left,))
    events = stage.play(TOUCHING)
    assert {(event.hand, event.surface) for event in events if event.type is EventType.DOWN} == {
        (Handedness.RIGHT, Surface.PALM),
        (Handedness.LEFT, Surface.BACK_OF_HAND),
    }


def test_the_first_page_keeps_a_finger_that_another_page_wants() -> None:
    stage = Stage()
    stage.play(HOVERING, player="first")
    elsewhere = SimulatedFinger(Surface.PALM, -20.0, 10.0, force_n=2.0)
    stage.simulation.play("second", (elsewhere,))
    assert stage.play(HOVERING, player="first") == []
    stage.simulation.leave("first")
    (down,) = [event for event in stage.play(elsewhere, player="second", frames=6) if event.type is EventType.DOWN]
    assert (down.x_mm, down.y_mm) == pytest.approx((-20.0, 10.0), abs=2.0)


def test_a_limb_shows_one_side_at_a_time() -> None:
    stage = Stage()
    behind = SimulatedFinger(Surface.BACK_OF_HAND, 0.0, 50.0, force_n=1.0, finger=Finger.THUMB)
    stage.play(HOVERING, player="first")
    stage.simulation.play("second", (behind,))
    assert {event.surface for event in stage.play(TOUCHING, player="first")} <= {Surface.PALM}


def test_the_limb_stays_as_it_was_when_the_hand_leaves() -> None:
    simulation = LiveSimulation()
    simulation.play("page", (SimulatedFinger(Surface.OUTER_FOREARM, 0.0, -50.0, force_n=1.0),))
    (_, host_before) = simulation.observe(0).hands
    simulation.leave("page")
    (host_after,) = simulation.observe(FRAME_NS).hands
    assert host_after.handedness is Handedness.LEFT
    assert host_after.landmarks_px == pytest.approx(host_before.landmarks_px)


def test_messages_become_fingers() -> None:
    assert fingers_from_proto(played(x_mm=5.0, y_mm=40.0, force_n=1.5, pitch_rad=pi / 2, yaw_rad=pi)) == (
        SimulatedFinger(Surface.PALM, 5.0, 40.0, force_n=1.5, pitch_rad=pi / 2, yaw_rad=pi),
    )
    assert fingers_from_proto(pb.SimulatedPointers()) == ()


@pytest.mark.parametrize(
    "wrong",
    [
        {"finger": pb.FINGER_UNSPECIFIED},
        {"hand": pb.HANDEDNESS_UNSPECIFIED},
        {"surface": pb.SURFACE_UNSPECIFIED},
        {"surface": pb.SURFACE_INNER_FOREARM},
        {"force_n": 3.6},
        {"force_n": float("nan")},
        {"hover_mm": -1.0},
        {"hover_mm": 5.0, "force_n": 1.0},
        {"pitch_rad": 1.6},
        {"yaw_rad": -3.2},
        {"x_mm": float("inf")},
        {"x_mm": 1001.0},
        {"y_mm": 1e30},
    ],
)
def test_nonsense_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ProtocolError):
        fingers_from_proto(played(**wrong))


def test_a_finger_given_twice_is_refused() -> None:
    with pytest.raises(ProtocolError, match="twice"):
        fingers_from_proto(pb.SimulatedPointers(pointers=[*played().pointers, *played(x_mm=9.0).pointers]))


def test_the_source_ticks_until_it_is_closed() -> None:
    with LiveSource(fps=240.0) as source:
        source.play("page", played(x_mm=5.0, y_mm=40.0, force_n=1.0))
        observations = [observation for _, observation in zip(range(5), source, strict=False)]
    assert list(source) == []
    assert [observation.index for observation in observations] == [0, 1, 2, 3, 4]
    times_ns = [observation.timestamp_ns for observation in observations]
    assert times_ns == sorted(set(times_ns))
    assert [len(observation.fingertips) for observation in observations] == [1] * 5
    assert (source.is_live, source.width_px, source.height_px, source.fps) == (True, 1280, 720, 240.0)


def played(**fields: Any) -> pb.SimulatedPointers:
    """A right index finger on the left palm; `fields` replace the defaults."""
    defaults: dict[str, Any] = {
        "id": 1,
        "hand": pb.HANDEDNESS_RIGHT,
        "finger": pb.FINGER_INDEX,
        "surface": pb.SURFACE_PALM,
        "y_mm": 50.0,
        "pitch_rad": 0.7,
    }
    return pb.SimulatedPointers(pointers=[pb.SimulatedPointer(**{**defaults, **fields})])
