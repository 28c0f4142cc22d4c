"""What was asked of the simulator comes back from the real event engine."""

from __future__ import annotations

from itertools import pairwise, product
from math import pi, radians

import numpy as np
import pytest

from egotouch_sdk.config import GateConfig, TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.gate import find_pairs
from egotouch_sdk.joints import FINGERS, Finger, HandJoint, Handedness
from egotouch_sdk.observation import GateReason, HostPoint
from egotouch_sdk.patches.polar import polar
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, SimulatedView, observe, place_at
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent

#: How close the engine comes to what was asked for.
PLACE_MM, ANGLE_DEG = 2.0, 5.0

PLACES = {
    Surface.PALM: ((0.0, 45.0), (22.0, 70.0), (-25.0, 15.0)),
    Surface.BACK_OF_HAND: ((5.0, 40.0), (-20.0, 60.0)),
    Surface.INNER_FOREARM: ((0.0, -80.0), (15.0, -30.0)),
    Surface.OUTER_FOREARM: ((-10.0, -120.0), (10.0, -40.0)),
}
ON_SURFACES = [(surface, *place) for surface, places in PLACES.items() for place in places]


def points(*fingers: SimulatedFinger, view: SimulatedView | None = None) -> tuple[HostPoint, ...]:
    """Where the engine finds fingers that are held still."""
    engine = EventEngine(TouchConfig(debug=True))
    scene = SimulatedScene(fingers, view or SimulatedView())
    for index in range(10):
        result = engine.process(observe(scene, index, index * 33_333_333))
    found = [point for point in result.points if point is not None]
    assert len(found) == len(fingers)
    return tuple(found)


def assert_found(finger: SimulatedFinger, point: HostPoint) -> None:
    assert point.surface is finger.surface
    assert np.hypot(point.x_mm - finger.x_mm, point.y_mm - finger.y_mm) <= PLACE_MM, point
    assert abs(point.pitch_rad - finger.pitch_rad) <= radians(ANGLE_DEG), point
    turned = (point.yaw_rad - finger.yaw_rad + pi) % (2 * pi) - pi
    assert abs(turned) <= radians(ANGLE_DEG), point


@pytest.mark.parametrize(("surface", "x_mm", "y_mm"), ON_SURFACES)
@pytest.mark.parametrize("hand", Handedness)
@pytest.mark.parametrize("finger", [Finger.THUMB, Finger.INDEX, Finger.PINKY])
def test_place_surface_and_angles_come_back(surface: Surface, x_mm: float, y_mm: float, hand: Handedness, finger: Finger) -> None:
    asked = SimulatedFinger(surface, x_mm, y_mm, 0.0, 1.0, radians(50), radians(-30), finger, hand)
    assert_found(asked, *points(asked))


@pytest.mark.parametrize(("pitch_deg", "yaw_deg"), tuple(product((5, 30, 60, 80), (-170, -90, -20, 0, 45, 120))))
def test_every_angle_comes_back(pitch_deg: float, yaw_deg: float) -> None:
    asked = SimulatedFinger(Surface.PALM, 5.0, 40.0, 0.0, 1.0, radians(pitch_deg), radians(yaw_deg))
    assert_found(asked, *points(asked))


@pytest.mark.parametrize("turn_deg", [-120, -35, 60, 180])
def test_a_limb_turned_in_the_picture_changes_nothing(turn_deg: float) -> None:
    asked = SimulatedFinger(Surface.BACK_OF_HAND, -10.0, 50.0, 0.0, 1.0, radians(40), radians(30))
    assert_found(asked, *points(asked, view=SimulatedView(turn_rad=radians(turn_deg))))


@pytest.mark.parametrize("tilt_deg", [-50, -20, 30, 60])
@pytest.mark.parametrize("surface", Surface)
def test_a_limb_seen_at_a_slant_changes_nothing_for_a_finger_on_the_skin(surface: Surface, tilt_deg: float) -> None:
    asked = SimulatedFinger(surface, *PLACES[surface][0], 0.0, 1.0, radians(40), radians(-60))
    assert_found(asked, *points(asked, view=SimulatedView(turn_rad=0.5, tilt_rad=radians(tilt_deg))))


def test_fingers_of_one_hand_and_of_both_are_told_apart() -> None:
    asked = (
        SimulatedFinger(Surface.PALM, 12.0, 60.0, finger=Finger.INDEX),
        SimulatedFinger(Surface.PALM, -10.0, 62.0, finger=Finger.MIDDLE, pitch_rad=radians(55), yaw_rad=radians(-10)),
        SimulatedFinger(Surface.OUTER_FOREARM, 4.0, -70.0, finger=Finger.INDEX, hand=Handedness.LEFT),
    )
    for finger, point in zip(asked, points(*asked), strict=True):
        assert_found(finger, point)


def events_of(*scenes: SimulatedScene) -> list[TouchEvent]:
    engine = EventEngine(TouchConfig(debug=True))
    events = [event for index, scene in enumerate(scenes) for event in engine.process(observe(scene, index, index * 33_333_333)).events]
    return [*events, *engine.finish(len(scenes) * 33_333_333)]


def test_a_press_gives_its_force_and_a_lift() -> None:
    above = SimulatedScene((SimulatedFinger(Surface.PALM, 0.0, 40.0, 12.0),))
    pressed = SimulatedScene((SimulatedFinger(Surface.PALM, 0.0, 40.0, 0.0, 2.0),))
    events = events_of(*[above] * 4, *[pressed] * 6, *[above] * 4)
    raw = [event for event in events if event.type in (EventType.DOWN, EventType.UP, EventType.CANCEL)]
    assert [event.type for event in raw] == [EventType.DOWN, EventType.UP]
    assert max(event.force_n for event in events) == pytest.approx(2.0)


def test_hands_found_as_new_ones_cancel_a_touch() -> None:
    touching = (SimulatedFinger(Surface.PALM, 0.0, 40.0),)
    events = events_of(*[SimulatedScene(touching)] * 5, *[SimulatedScene(touching, generation=1)] * 5)
    assert [event.reason for event in events if event.type is EventType.CANCEL] == ["hand_swapped", "source_ended"]


@pytest.mark.parametrize("finger", FINGERS)
@pytest.mark.parametrize("hand", Handedness)
def test_the_real_gate_sees_the_same_pair_and_finger(finger: Finger, hand: Handedness) -> None:
    observation = observe(SimulatedScene((SimulatedFinger(Surface.PALM, 0.0, 45.0, finger=finger, hand=hand),)), 0, 0)
    (simulated,) = observation.gate.pairs
    (found,) = find_pairs(observation.hands, GateConfig()).pairs
    assert (found.touching.hand_id, found.host.hand_id) == (simulated.touching.hand_id, simulated.host.hand_id)
    assert finger in found.active_fingers


@pytest.mark.parametrize("hand", Handedness)
def test_the_fingertip_lies_at_the_touch_models_r_and_theta(hand: Handedness) -> None:
    observation = observe(SimulatedScene((SimulatedFinger(Surface.PALM, 20.0, 30.0, hand=hand),)), 0, 0)
    (tip,), (pair,) = observation.fingertips, observation.gate.pairs
    host = pair.host
    expected = polar(host.xy_px(HandJoint.WRIST), host.xy_px(HandJoint.MIDDLE_FINGER_MCP), tip.tip_px, hand is Handedness.LEFT)
    assert (tip.r_palms, tip.theta_rad) == pytest.approx(expected, abs=1e-5)


def bones_mm(observation: FrameObservation, hand_id: int) -> np.ndarray:
    hand = next(hand for hand in observation.hands if hand.hand_id == hand_id)
    chains = [finger.chain for finger in FINGERS]
    return np.array([np.linalg.norm(hand.world_mm[b] - hand.world_mm[a]) for chain in chains for a, b in pairwise(chain)])


def test_hands_are_rigid_however_they_are_held() -> None:
    pair_of = [SimulatedFinger(Surface.PALM, 5.0, 30.0, pitch_rad=radians(pitch), yaw_rad=radians(2 * pitch)) for pitch in (0, 45, 90)]
    bones = [bones_mm(observe(SimulatedScene((finger,)), 0, 0), 1) for finger in pair_of]
    assert np.ptp(np.stack(bones), axis=0).max() < 0.01


def test_a_second_finger_keeps_its_bones_within_reach() -> None:
    fingers = (SimulatedFinger(Surface.PALM, 10.0, 40.0), SimulatedFinger(Surface.PALM, -10.0, 44.0, finger=Finger.MIDDLE))
    together = bones_mm(observe(SimulatedScene(fingers), 0, 0), 1)
    alone = bones_mm(observe(SimulatedScene(fingers[:1]), 0, 0), 1)
    assert np.abs(together - alone).max() < 0.01


@pytest.mark.parametrize(
    ("hosts", "reason"), [((Handedness.LEFT,), GateReason.NO_HOST), ((), GateReason.NO_HANDS), (tuple(Handedness), GateReason.NO_HOST)]
)
def test_without_a_finger_the_gate_is_closed(hosts: tuple[Handedness, ...], reason: GateReason) -> None:
    observation = observe(SimulatedScene(hosts=hosts), 0, 0)
    assert (observation.gate.reason, len(observation.hands)) == (reason, len(hosts))


def test_a_hand_that_touches_is_not_shown_as_a_host_as_well() -> None:
    scene = SimulatedScene((SimulatedFinger(Surface.PALM, 0.0, 40.0, hand=Handedness.LEFT),), hosts=tuple(Handedness))
    assert [hand.handedness for hand in observe(scene, 0, 0).hands] == [Handedness.LEFT, Handedness.RIGHT]


@pytest.mark.parametrize("host", Handedness)
@pytest.mark.parametrize("palm_side", [True, False])
def test_a_mouse_on_the_picture_points_at_the_place_under_it(host: Handedness, palm_side: bool) -> None:
    view = SimulatedView(turn_rad=0.4)
    surface = Surface.INNER_FOREARM if palm_side else Surface.OUTER_FOREARM
    finger = SimulatedFinger(surface, 11.0, -33.0, hand=host.other)
    (tip,) = observe(SimulatedScene((finger,), view), 0, 0).fingertips
    surface_there, x_mm, y_mm = place_at(*tip.tip_px, view=view, host=host, palm_side=palm_side)
    assert (surface_there, x_mm, y_mm) == (surface, pytest.approx(11.0, abs=1e-3), pytest.approx(-33.0, abs=1e-3))
