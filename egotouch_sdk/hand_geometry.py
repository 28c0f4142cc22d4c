"""Measures of one hand that several stages need; pure functions of its landmarks."""

from __future__ import annotations

from itertools import pairwise
from math import dist, hypot

import numpy as np

from egotouch_sdk.joints import HandJoint
from egotouch_sdk.observation import HandObservation

#: A wrist to middle-MCP axis seen shorter than this share of the palm is too foreshortened to measure by (our choice).
MIN_AXIS_SHARE = 0.25

#: Wrist to index MCP to pinky MCP to wrist in millimetres, between MediaPipe's landmarks: 219 mm on the generic WebXR hand (MIT)
#: with landmarks placed as MediaPipe places them, 215 mm as found by the tracker on renders of it (our measurement).
PALM_OUTLINE_MM = 215.0
_PALM_OUTLINE = (HandJoint.WRIST, HandJoint.INDEX_FINGER_MCP, HandJoint.PINKY_MCP, HandJoint.WRIST)


def palm_length_px(hand: HandObservation) -> float:
    """Length of the palm in image pixels, at least 1.

    The longest of wrist to index MCP, index to pinky MCP and pinky MCP to wrist: unlike wrist to middle MCP alone, it does not
    collapse on a hand that points at the camera (16 px in a 224 px FreiHAND photo, our measurement).
    """
    points = hand.landmarks_px[:, :2].tolist()
    return max(1.0, *(dist(points[a], points[b]) for a, b in pairwise(_PALM_OUTLINE)))


def px_per_mm(hand: HandObservation) -> float:
    """Image scale of the whole hand: the palm's outline in pixels, landmarks' z included, over its usual length. Positive.

    The palm is used because it does not bend. MediaPipe's metric landmarks are not: over 14 rendered frames of pointing hands
    they made the scale 1.2 to 1.5 times too large, the palm 0.94 to 1.02 times (our measurement).
    """
    points = hand.landmarks_px.tolist()
    return max(sum(dist(points[a], points[b]) for a, b in pairwise(_PALM_OUTLINE)), 1.0) / PALM_OUTLINE_MM


def has_metric_landmarks(hand: HandObservation) -> bool:
    """False for a hand from a source that knows only pixels and leaves `world_mm` on one spot."""
    return float(np.ptp(hand.world_mm, axis=0).max()) > 1.0


def has_axis(host: HandObservation) -> bool:
    """True when the axis wrist to middle MCP is long enough in the image to locate points by it."""
    axis = host.xy_px(HandJoint.MIDDLE_FINGER_MCP) - host.xy_px(HandJoint.WRIST)
    return hypot(float(axis[0]), float(axis[1])) >= MIN_AXIS_SHARE * palm_length_px(host)
