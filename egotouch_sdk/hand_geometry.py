"""Measures of one hand that several stages need; pure functions of its landmarks."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import numpy as np

from egotouch_sdk.joints import HandJoint
from egotouch_sdk.observation import FloatArray, HandObservation

#: A wrist to middle-MCP axis seen shorter than this share of the palm is too foreshortened to measure by (our choice).
MIN_AXIS_SHARE = 0.25


def palm_length_px(hand: HandObservation) -> float:
    """Length of the palm in image pixels, at least 1.

    The longest of wrist to index MCP, index to pinky MCP and pinky MCP to wrist: unlike wrist to middle MCP alone, it does not
    collapse on a hand that points at the camera (16 px in a 224 px FreiHAND photo, our measurement).
    """
    points = hand.landmarks_px
    corners = (HandJoint.WRIST, HandJoint.INDEX_FINGER_MCP, HandJoint.PINKY_MCP, HandJoint.WRIST)
    return max(1.0, *(hypot(float(points[a, 0] - points[b, 0]), float(points[a, 1] - points[b, 1])) for a, b in pairwise(corners)))


def px_per_mm(hand: HandObservation) -> float | None:
    """Weak-perspective scale of the whole hand: spread of the landmarks in the image over their metric spread in the same plane.

    None when the metric landmarks have no spread, as from a source that knows only pixels.
    """
    image = hand.landmarks_px[:, :2] - hand.landmarks_px[:, :2].mean(axis=0)
    metric = hand.world_mm[:, :2] - hand.world_mm[:, :2].mean(axis=0)
    image_spread, metric_spread = float(np.sqrt((image * image).sum())), float(np.sqrt((metric * metric).sum()))
    if metric_spread < 1.0 or image_spread < 1.0:
        return None
    return image_spread / metric_spread


def shape(hand: HandObservation) -> FloatArray:
    """Points (21, 3) to measure the hand's pose by, in no particular unit: the metric ones, or the image's where there are none."""
    return hand.landmarks_px if px_per_mm(hand) is None else hand.world_mm


def has_axis(host: HandObservation) -> bool:
    """True when the axis wrist to middle MCP is long enough in the image to locate points by it."""
    axis = host.xy_px(HandJoint.MIDDLE_FINGER_MCP) - host.xy_px(HandJoint.WRIST)
    return hypot(float(axis[0]), float(axis[1])) >= MIN_AXIS_SHARE * palm_length_px(host)


def host_frame_xy(host: HandObservation, tip_px: tuple[float, float]) -> tuple[float, float] | None:
    """A fingertip in the host's own frame in the image: origin wrist, +y to the middle MCP, +x to the host's thumb side.

    Both in lengths wrist to middle MCP. None when that axis is too foreshortened.
    """
    if not has_axis(host):
        return None
    wrist = host.xy_px(HandJoint.WRIST)
    axis_x, axis_y = (float(v) for v in host.xy_px(HandJoint.MIDDLE_FINGER_MCP) - wrist)
    thumb_x, thumb_y = (float(v) for v in host.xy_px(HandJoint.INDEX_FINGER_MCP) - host.xy_px(HandJoint.PINKY_MCP))
    tip_x, tip_y = tip_px[0] - float(wrist[0]), tip_px[1] - float(wrist[1])
    squared = axis_x * axis_x + axis_y * axis_y
    thumb_side = 1.0 if axis_x * thumb_y - axis_y * thumb_x >= 0 else -1.0
    return thumb_side * (axis_x * tip_y - axis_y * tip_x) / squared, (axis_x * tip_x + axis_y * tip_y) / squared
