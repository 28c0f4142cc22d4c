"""From the landmarks of two hands to a point in the host frame."""

from __future__ import annotations

from math import asin, atan2, pi, sqrt

import numpy as np

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame.limb_skin import Floats, height_mm, normal_at, surface_at
from egotouch_sdk.host_frame.palm_pose import PALM_MM, PalmPose, fit_palm
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair

DEFAULTS = HostConfig()

#: The TIP landmark of a finger that touches lies this far above the skin, and the contact this far ahead of it along the finger (mm;
#: medians over the generator's touches, our measurement).
_TIP_HEIGHT_MM = 3.2
_AHEAD_MM = {True: -5.0, False: -0.6}
#: Away from the camera, as a share of its length, a finger points by this much, plus these shares of MediaPipe's z (mm) from DIP, PIP
#: and MCP to TIP: regression on rendered stills of 16 participants (our measurement).
_DIP_BASE = 0.3
_DIP_PER_MM = (0.0, 0.0, 0.0)
#: A surface seen flatter than this (cosine) moves the point no further with its height.
_LEAST_FACING = 0.4
_STEPS = 3


def locate(pair: TouchPair, finger: Finger, config: HostConfig = DEFAULTS, *, mirrored: bool = False) -> HostPoint | None:
    """The host point of one finger of `pair`; None when the host's landmarks show no palm.

    `mirrored` says that the picture is a mirror image.
    """
    flip = (pair.host.handedness is Handedness.RIGHT) != mirrored
    pose = fit_palm(_upright(pair.host, flip))
    if pose is None:
        return None
    touching = _upright(pair.touching, flip)
    axis = _finger_axis(touching, finger, pose)
    at = _on_skin(pose, touching[finger.tip, :2], surface_at(0.0, pose.shows_back))
    if at[1] < -16.0:
        at = _on_skin(pose, touching[finger.tip, :2], surface_at(at[1], pose.shows_back))
    surface = surface_at(at[1], pose.shows_back)
    normal = normal_at(surface, at[0], at[1])
    along = pose.rotation.T @ axis
    level = np.array([0.0, 1.0, 0.0]) - normal * normal[1]
    level /= np.linalg.norm(level)
    across = np.array([1.0, 0.0, 0.0]) - normal * normal[0]
    across -= level * float(across @ level)
    across /= np.linalg.norm(across)
    yaw = atan2(float(along @ across), float(along @ level))
    pitch = min(max(asin(min(max(-float(along @ normal), -1.0), 1.0)), 0.0), pi / 2)
    ahead = _AHEAD_MM[finger is Finger.THUMB]
    size = (config.palm_mm or PALM_MM) / PALM_MM
    x = (at[0] + ahead * np.sin(yaw)) * size
    y = (at[1] + ahead * np.cos(yaw)) * size
    return HostPoint(surface, float(x), float(y), pitch, yaw)


def _upright(hand: HandObservation, flip: bool) -> Floats:
    """Landmarks (21, 3) as if the host were a left hand in a picture that is not mirrored."""
    return hand.landmarks_px.astype(np.float64) * ((-1.0, 1.0, 1.0) if flip else (1.0, 1.0, 1.0))


def _on_skin(pose: PalmPose, tip_px: Floats, surface) -> Floats:
    """Where the ray through a fingertip meets the skin, (3,) in the host frame."""
    start = pose.rotation[:2].T @ pose.to_camera_mm(tip_px)
    ray = pose.rotation[2]
    facing = ray[2] if abs(ray[2]) > _LEAST_FACING else (-_LEAST_FACING if ray[2] < 0 else _LEAST_FACING)
    at = start - ray * (start[2] / facing)
    for _ in range(_STEPS):
        outward = 1.0 if pose.shows_back else -1.0
        height = height_mm(surface, float(at[0]), float(at[1])) + outward * _TIP_HEIGHT_MM
        at = start + ray * ((height - start[2]) / facing)
    return np.asarray(at, np.float64)


def _finger_axis(landmarks: Floats, finger: Finger, pose: PalmPose) -> Floats:
    """Unit vector (3,) DIP to TIP in the camera's axes."""
    tip = landmarks[finger.tip]
    flat = tip[:2] - landmarks[finger.dip, :2]
    length = max(float(np.linalg.norm(flat)), 1e-6)
    z = [(tip[2] - landmarks[joint, 2]) / pose.px_per_mm for joint in (finger.dip, finger.chain[1], finger.chain[0])]
    away = _DIP_BASE + sum(a * b for a, b in zip(_DIP_PER_MM, z, strict=True))
    away = min(max(float(away), -0.9), 0.9)
    return np.append(flat / length * sqrt(1 - away * away), away)
