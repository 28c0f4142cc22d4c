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


def active_fingers(hand: HandObservation, config: GateConfig, already: Collection[Finger] = ()) -> tuple[Finger, ...]:
    """Fingers that could touch, thumb first; those in `already` were active a frame ago and stay so more easily.

    Measured on the metric landmarks, so a finger that points at the camera counts as well as one seen from the side.
    """
    points: Points = hand_geometry.shape(hand).tolist()
    return tuple(
        finger
        for finger in FINGERS
        if points_away(points, finger)
        and extension(points, finger) >= (config.extended_exit if finger in already else config.extended_enter)
    )


def points_away(points: Points, finger: Finger) -> bool:
    """True when the tip is farther from the wrist than the finger's knuckle (MCP), as in every press and no fist."""
    wrist = points[HandJoint.WRIST]
    knuckle = finger.chain[1] if finger is Finger.THUMB else finger.chain[0]
    return dist(points[finger.tip], wrist) > dist(points[knuckle], wrist)


def extension(points: Points, finger: Finger) -> float:
    """How far a finger reaches, as a share of its full reach, 0..1.

    For the four fingers MCP to tip over the sum of the bones. A thumb stays straight when it is tucked in and instead
    crosses the palm, so its reach is measured from the pinky's MCP.
    """
    _, second, third, tip = finger.chain
    if finger is Finger.THUMB:
        base = HandJoint.PINKY_MCP
        joints: tuple[HandJoint, ...] = (base, second, third, tip)
    else:
        base = finger.chain[0]
        joints = finger.chain
    reach = sum(dist(points[a], points[b]) for a, b in pairwise(joints))
    return dist(points[base], points[tip]) / reach if reach > 0.0 else 0.0
