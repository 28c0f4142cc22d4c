"""From a simulated scene to what perception would find in a picture of it."""

from __future__ import annotations

from math import atan2, exp, hypot
from typing import Final

import numpy as np

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import FINGERS, HandJoint, Handedness
from egotouch_sdk.observation import Fingertip, GateReason, GateResult, HandObservation, TouchEstimate, TouchPair
from egotouch_sdk.simulator.hand_shape import Points
from egotouch_sdk.simulator.pose import host_on_limb, touching_on_limb
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedScene, SimulatedView

#: Height at which the simulated recogniser is undecided, and how fast it makes up its mind around it (our choice: .98 on the skin,
#: .5 at 2 mm, under .01 from 5 mm).
UNSURE_MM: Final = 2.0
SPREAD_MM: Final = 0.5

#: Identities of the hands in one generation. A hand that touches and is touched at once counts as two.
_TOUCHING_ID = {Handedness.RIGHT: 1, Handedness.LEFT: 3}
_HOST_ID = {Handedness.LEFT: 2, Handedness.RIGHT: 4}
_IDS_PER_GENERATION = 4


def observe(scene: SimulatedScene, index: int, timestamp_ns: int) -> FrameObservation:
    """What an ideal tracker, gate and recogniser find in one picture of `scene`, landmarks and estimates without noise.

    The scene is a rigid one in millimetres, seen by a distant camera. The gate is open exactly when a finger is in the scene.
    """
    hands: list[HandObservation] = []
    pairs: list[TouchPair] = []
    tips: list[Fingertip] = []
    estimates: list[TouchEstimate] = []
    for hand in (Handedness.RIGHT, Handedness.LEFT):
        fingers = sorted(scene.of_hand(hand), key=lambda finger: FINGERS.index(finger.finger))
        if fingers:
            pair = _pair(scene, hand)
            hands += [pair.touching, pair.host]
            pairs.append(pair)
            tips += [_fingertip(finger, pair, scene.view) for finger in fingers]
            estimates += [_estimate(finger, pair.touching.hand_id) for finger in fingers]
        elif hand.other in scene.hosts and not scene.of_hand(hand.other):
            hands.append(_host(scene, hand.other))
    gate = GateResult(_reason(hands, pairs), tuple(pairs))
    size_px = scene.view.width_px, scene.view.height_px
    return FrameObservation(index, timestamp_ns, *size_px, tuple(hands), gate, tuple(tips), tuple(estimates))


def touch_probability(hover_mm: float) -> float:
    """What the simulated recogniser says about a fingertip at this height over the skin."""
    return 1.0 / (1.0 + exp(min((hover_mm - UNSURE_MM) / SPREAD_MM, 50.0)))


def _reason(hands: list[HandObservation], pairs: list[TouchPair]) -> GateReason:
    if pairs:
        return GateReason.OPEN
    return GateReason.NO_HOST if hands else GateReason.NO_HANDS


def _pair(scene: SimulatedScene, hand: Handedness) -> TouchPair:
    host = _host(scene, hand.other)
    fingers = scene.of_hand(hand)
    points = touching_on_limb(fingers, palm_side=scene.shows_palm_side(hand.other))
    touching = _hand(scene, hand, hand.other, points, _TOUCHING_ID[hand])
    tips_px = touching.landmarks_px[[finger.tip for finger in FINGERS], :2]
    difference = tips_px[:, None, :] - host.landmarks_px[None, :, :2]
    nearest_px = float(np.sqrt((difference**2).sum(axis=2).min()))
    palm_px = float(np.linalg.norm(host.xy_px(HandJoint.INDEX_FINGER_MCP) - host.xy_px(HandJoint.WRIST)))
    order = tuple(finger for finger in FINGERS if any(each.finger is finger for each in fingers))
    return TouchPair(touching, host, nearest_px / palm_px, order)


def _host(scene: SimulatedScene, host: Handedness) -> HandObservation:
    return _hand(scene, host, host, host_on_limb(palm_side=scene.shows_palm_side(host)), _HOST_ID[host])


def _hand(scene: SimulatedScene, handedness: Handedness, host: Handedness, on_limb_mm: Points, number: int) -> HandObservation:
    """One hand of the scene around the limb of `host`, as the camera sees it."""
    matrix = scene.view.camera_from_limb(host, palm_side=scene.shows_palm_side(host))
    world_mm = (on_limb_mm @ matrix.T).astype(np.float32)
    landmarks_px = world_mm * scene.view.px_per_mm
    landmarks_px[:, :2] += scene.view.wrist_px(host)
    landmarks_px[:, 2] -= landmarks_px[HandJoint.WRIST, 2]
    hand_id = number + _IDS_PER_GENERATION * scene.generation
    return HandObservation(hand_id, handedness, 1.0, landmarks_px, world_mm - world_mm.mean(axis=0))


def _fingertip(finger: SimulatedFinger, pair: TouchPair, view: SimulatedView) -> Fingertip:
    tip = pair.touching.xy_px(finger.finger.tip)
    wrist, knuckle = pair.host.xy_px(HandJoint.WRIST), pair.host.xy_px(HandJoint.MIDDLE_FINGER_MCP)
    axis_x, axis_y = (knuckle - wrist).tolist()
    to_x, to_y = (tip - wrist).tolist()
    theta_rad = atan2(axis_y * to_x - axis_x * to_y, axis_x * to_x + axis_y * to_y)
    return Fingertip(
        hand_id=pair.touching.hand_id,
        handedness=finger.hand,
        finger=finger.finger,
        tip_px=(float(tip[0]), float(tip[1])),
        px_per_mm=view.px_per_mm,
        r_palms=hypot(to_x, to_y) / hypot(axis_x, axis_y),
        theta_rad=theta_rad if finger.hand is Handedness.RIGHT else -theta_rad,
    )


def _estimate(finger: SimulatedFinger, hand_id: int) -> TouchEstimate:
    return TouchEstimate(hand_id, finger.finger, touch_probability(finger.hover_mm), finger.force_n)
