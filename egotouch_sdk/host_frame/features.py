"""What the landmarks of two hands say about a fingertip on the host, in numbers that do not depend on where and how large it is seen.

All lengths are in the host's palm as seen in the image (wrist to middle MCP), in the frame that has its origin at the wrist, +y to the
middle MCP and +x to the host's thumb side. Left and right hosts, mirrored pictures included, thus give the same numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, dist, hypot, sin

from egotouch_sdk.joints import Finger, HandJoint
from egotouch_sdk.observation import TouchPair

_OUTLINE = (HandJoint.WRIST, HandJoint.INDEX_FINGER_MCP, HandJoint.PINKY_MCP, HandJoint.WRIST)
_CORNERS = (HandJoint.THUMB_CMC, HandJoint.INDEX_FINGER_MCP, HandJoint.MIDDLE_FINGER_MCP, HandJoint.PINKY_MCP)
_DEPTHS = (HandJoint.THUMB_CMC, HandJoint.MIDDLE_FINGER_MCP, HandJoint.PINKY_MCP)


@dataclass(frozen=True, slots=True)
class SeenTip:
    """A fingertip in the host's frame as seen.

    `tip` and `yaw_rad` are the TIP landmark and the direction DIP to TIP; `position` and `angle` are the numbers that
    `tracker_fit.json` has weights for.
    """

    tip: tuple[float, float]
    yaw_rad: float
    position: tuple[float, ...]
    angle: tuple[float, ...]


def see(pair: TouchPair, finger: Finger) -> SeenTip | None:
    """How one finger of `pair` is seen; None when wrist and middle MCP of the host lie on one spot."""
    host, hand = pair.host.landmarks_px.tolist(), pair.touching.landmarks_px.tolist()
    wrist, knuckle = host[HandJoint.WRIST], host[HandJoint.MIDDLE_FINGER_MCP]
    axis_x, axis_y = knuckle[0] - wrist[0], knuckle[1] - wrist[1]
    palm_px = hypot(axis_x, axis_y)
    if palm_px < 1.0:
        return None
    thumb_x, thumb_y = (host[HandJoint.INDEX_FINGER_MCP][k] - host[HandJoint.PINKY_MCP][k] for k in (0, 1))
    side = 1.0 if axis_x * thumb_y - axis_y * thumb_x >= 0 else -1.0

    def place(point: list[float]) -> tuple[float, float]:
        x, y = point[0] - wrist[0], point[1] - wrist[1]
        return side * (axis_x * y - axis_y * x) / palm_px**2, (axis_x * x + axis_y * y) / palm_px**2

    bones = [hand[joint] for joint in finger.chain]
    (tip_x, tip_y), (dip_x, dip_y) = place(bones[3]), place(bones[2])
    yaw_rad = atan2(tip_x - dip_x, tip_y - dip_y)
    thumb, index, middle, pinky = (place(host[joint]) for joint in _CORNERS)
    depths = [host[joint][2] / palm_px for joint in _DEPTHS]
    outline = sum(dist(host[a], host[b]) for a, b in pairwise(_OUTLINE)) / palm_px
    rises = [(bones[3][2] - bone[2]) / palm_px for bone in bones[:3]]
    lengths = [dist(a[:2], b[:2]) / palm_px for a, b in pairwise(bones)]
    whole = dist(bones[0][:2], bones[3][:2]) / palm_px
    position = (
        *(tip_x, tip_y, *thumb, *index, *pinky, *depths, rises[0], outline, tip_x - dip_x, tip_y - dip_y),
        *(tip_x * tip_x, tip_x * tip_y, tip_y * tip_y),
        *(tip_x * depth for depth in depths),
        *(tip_y * depth for depth in depths),
        *(tip * corner for tip in (tip_x, tip_y) for corner in (*index, *pinky)),
        *(tip_x * outline, tip_y * outline),
    )
    across, along = sin(yaw_rad), cos(yaw_rad)
    shape = (*index, *pinky)
    angle = (
        *(float(finger is Finger.THUMB), lengths[2], whole, across, along, *rises, *lengths, tip_x, tip_y),
        *(*index, *middle, *pinky, *depths, outline),
        *(across * depth for depth in depths),
        *(along * depth for depth in depths),
        *(across * value for value in shape),
        *(along * value for value in shape),
        *(rises[0] * across, rises[0] * along),
    )
    return SeenTip((tip_x, tip_y), yaw_rad, position, angle)
