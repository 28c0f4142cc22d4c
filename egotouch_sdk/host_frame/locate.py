"""From the landmarks of two hands to a point in the host frame."""

from __future__ import annotations

from math import atan2, hypot, pi

from egotouch_sdk.config import HostConfig
from egotouch_sdk.hand_geometry import host_frame_xy
from egotouch_sdk.joints import Finger, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair
from egotouch_sdk.surface import Surface

#: Wrist to middle MCP in millimetres between MediaPipe's landmarks (the generic WebXR hand with landmarks placed as MediaPipe
#: places them, our measurement).
PALM_MM = 83.0

DEFAULTS = HostConfig()


def locate(pair: TouchPair, finger: Finger, config: HostConfig = DEFAULTS, *, mirrored: bool = False) -> HostPoint | None:
    """The host point of one finger of `pair`; None when the host is seen along its palm and has no usable axis.

    `mirrored` says that the picture is a mirror image.
    """
    hand, host = pair.touching, pair.host
    tip, dip = hand.landmarks_px[finger.tip], hand.landmarks_px[finger.dip]
    at = host_frame_xy(host, (float(tip[0]), float(tip[1])))
    base = host_frame_xy(host, (float(dip[0]), float(dip[1])))
    if at is None or base is None:
        return None
    palm_mm = config.palm_mm or PALM_MM
    x_mm, y_mm = at[0] * palm_mm, at[1] * palm_mm
    yaw_rad = atan2(at[0] - base[0], at[1] - base[1])
    flat_px = hypot(float(tip[0] - dip[0]), float(tip[1] - dip[1]))
    pitch_rad = min(max(atan2(float(tip[2] - dip[2]), flat_px), 0.0), pi / 2)
    return HostPoint(_surface(host, y_mm, mirrored), x_mm, y_mm, pitch_rad, yaw_rad)


def _surface(host: HandObservation, y_mm: float, mirrored: bool) -> Surface:
    shows_palm = _shows_palm(host) != mirrored
    if y_mm < 0:
        return Surface.INNER_FOREARM if shows_palm else Surface.OUTER_FOREARM
    return Surface.PALM if shows_palm else Surface.BACK_OF_HAND


def _shows_palm(host: HandObservation) -> bool:
    """True when the palm faces the camera: seen from the palm, a left hand's thumb side lies to the left of wrist to knuckles."""
    wrist = host.xy_px(HandJoint.WRIST)
    along = host.xy_px(HandJoint.MIDDLE_FINGER_MCP) - wrist
    thumbwards = host.xy_px(HandJoint.INDEX_FINGER_MCP) - host.xy_px(HandJoint.PINKY_MCP)
    clockwise = float(along[0] * thumbwards[1] - along[1] * thumbwards[0]) > 0
    return clockwise == (host.handedness is Handedness.RIGHT)
