"""Which fingers could touch: pointing away from the wrist and not tucked in (EgoTouch, UIST'24, section 4)."""

from __future__ import annotations

from collections.abc import Collection
from itertools import pairwise
from math import dist

from egotouch_sdk import hand_geometry
from egotouch_sdk.config import GateConfig
from egotouch_sdk.joints import FINGERS, Finger, HandJoint
from egotouch_sdk.observation import HandObservation

Points = list[list[float]]

_CHAINS = {finger: tuple(int(joint) for joint in finger.chain) for finger in FINGERS}
_PINKY_MCP = int(HandJoint.PINKY_MCP)


def active_fingers(hand: HandObservation, config: GateConfig, already: Collection[Finger] = ()) -> tuple[Finger, ...]:
    """Fingers that could touch, thumb first; those in `already` were active a frame ago and stay so more easily.

    Measured in three dimensions, so a finger that points at the camera counts as well as one seen from the side. Both the
    metric and the image landmarks are asked: on a curled finger they seldom err together (our measurement on rendered hands).
    """
    views: list[Points] = [hand.landmarks_px.tolist()]
    if hand_geometry.has_metric_landmarks(hand):
        views.append(hand.world_mm.tolist())
    return tuple(finger for finger in FINGERS if _is_active(views, finger, config, finger in already))


def _is_active(views: list[Points], finger: Finger, config: GateConfig, was_active: bool) -> bool:
    away = config.reach_exit if was_active else config.reach_enter
    stretched = config.extended_exit if was_active else config.extended_enter
    return (
        sum(reach(points, finger) for points in views) >= away * len(views)
        and min(extension(points, finger) for points in views) >= stretched
    )


def reach(points: Points, finger: Finger) -> float:
    """Distance wrist to tip over wrist to second joint (PIP; thumb: MCP): above 1 the finger points away from the wrist."""
    _, second, _, tip = _CHAINS[finger]
    wrist = points[HandJoint.WRIST]
    base = dist(points[second], wrist)
    return dist(points[tip], wrist) / base if base > 0.0 else 0.0


def extension(points: Points, finger: Finger) -> float:
    """How far a finger is stretched, as a share of its full length, 0..1.

    For the four fingers MCP to tip over the sum of the bones. A thumb stays straight when it is tucked in and instead
    crosses the palm, so its length is measured from the pinky's MCP.
    """
    joints = _CHAINS[finger]
    if finger is Finger.THUMB:
        joints = (_PINKY_MCP, *joints[1:])
    length = sum(dist(points[a], points[b]) for a, b in pairwise(joints))
    return dist(points[joints[0]], points[joints[-1]]) / length if length > 0.0 else 0.0
