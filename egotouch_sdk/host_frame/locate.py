"""From the landmarks of two hands to a point in the host frame."""

from __future__ import annotations

from math import asin, atan2, cos, sin, sqrt

import numpy as np

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame.limb_skin import FOREARM, height_mm, normal_at, surface_at
from egotouch_sdk.host_frame.palm_pose import PALM_MM, Floats, PalmPose, fit_palm
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair
from egotouch_sdk.surface import Surface

DEFAULTS = HostConfig()

#: The TIP landmark of a finger that touches lies this far above the skin (mm, mean over 601 posed touches of the generator), and the
#: contact this far ahead of the tracker's TIP along the finger (mm; thumb and fingers; medians over 4 and 94 rendered stills). The
#: demo clip would rather have 0 or less for fingers (all our measurement).
_TIP_HEIGHT_MM = 3.2
_AHEAD_MM = {True: 0.0, False: 3.0}
#: Away from the camera, as a share of its length, a last phalanx points by the first, plus the second times MediaPipe's z from MCP to
#: TIP in mm: regression on rendered stills of 16 participants, 7.5 degrees off (median) on 16 others, where a constant is 9.5. On an
#: earlier 168 stills z from DIP to TIP alone was 17 off, MediaPipe's metric landmarks 17, the phalanx' foreshortening 16. Most of it is
#: thus how the generator's fingers usually point (all our measurement).
_AWAY = (0.334, 0.0094)
_MOST_AWAY = 0.9
#: A skin seen flatter than this (cosine) moves the point no further with its height (our choice).
_LEAST_FACING = 0.4
_STEPS = 3


def locate(pair: TouchPair, finger: Finger, config: HostConfig = DEFAULTS, *, mirrored: bool = False) -> HostPoint | None:
    """The host point of one finger of `pair`; None when the host's landmarks lie on one spot.

    `mirrored` says that the picture is a mirror image.
    """
    flip = (pair.host.handedness is Handedness.RIGHT) != mirrored
    pose = fit_palm(_as_left(pair.host, flip))
    if pose is None:
        return None
    touching = _as_left(pair.touching, flip)
    surface, x_mm, y_mm = _skin_under(pose, touching[finger.tip, :2])
    pitch_rad, yaw_rad = _angles(pose.rotation.T @ _finger_axis(touching, finger, pose), normal_at(surface, x_mm, y_mm))
    ahead_mm = _AHEAD_MM[finger is Finger.THUMB]
    scale = (config.palm_mm or PALM_MM) / PALM_MM
    return HostPoint(surface, (x_mm + ahead_mm * sin(yaw_rad)) * scale, (y_mm + ahead_mm * cos(yaw_rad)) * scale, pitch_rad, yaw_rad)


def _as_left(hand: HandObservation, flip: bool) -> Floats:
    """Landmarks (21, 3) as if the host were a left hand in a picture that is not mirrored."""
    return hand.landmarks_px.astype(np.float64) * ((-1.0, 1.0, 1.0) if flip else (1.0, 1.0, 1.0))


def _skin_under(pose: PalmPose, tip_px: Floats) -> tuple[Surface, float, float]:
    """The surface under a fingertip and where on it, for a palm of `PALM_MM`."""
    x_mm, y_mm = _on_hand(pose, tip_px)
    surface = surface_at(y_mm, pose.shows_back)
    return (surface, *_on_forearm(pose, tip_px)) if surface in FOREARM else (surface, x_mm, y_mm)


def _on_hand(pose: PalmPose, tip_px: Floats) -> tuple[float, float]:
    """Where the line of sight through a fingertip meets the skin of the hand, raised by the tip's own height."""
    start = pose.rotation[:2].T @ pose.to_camera_mm(tip_px)
    ray = pose.rotation[2]
    outward = 1.0 if pose.shows_back else -1.0
    facing = -outward * max(abs(float(ray[2])), _LEAST_FACING)
    surface = surface_at(0.0, pose.shows_back)
    at = start - ray * (start[2] / facing)
    for _ in range(_STEPS):
        height = height_mm(surface, float(at[0]), float(at[1])) + outward * _TIP_HEIGHT_MM
        at = start + ray * ((height - start[2]) / facing)
    return float(at[0]), float(at[1])


def _on_forearm(pose: PalmPose, tip_px: Floats) -> tuple[float, float]:
    """Where a fingertip is beyond the wrist, taking the forearm as facing the camera.

    A wrist bends, so the palm's plane says little about the forearm's: with the wearer's palm length, prolonging it gave a median error
    of 27 mm on rendered stills, an in-plane similarity of wrist and middle MCP 21 mm, this 18 mm (our measurement).
    """
    along = pose.rotation[:2, 1] / max(float(np.linalg.norm(pose.rotation[:2, 1])), 1e-6)
    across = np.array([along[1], -along[0]]) * (-1.0 if pose.shows_back else 1.0)
    offset = pose.to_camera_mm(tip_px)
    return float(offset @ across), float(offset @ along)


def _finger_axis(landmarks: Floats, finger: Finger, pose: PalmPose) -> Floats:
    """Unit vector (3,) DIP to TIP in the camera's axes."""
    tip = landmarks[finger.tip]
    flat = tip[:2] - landmarks[finger.dip, :2]
    z_mm = float(tip[2] - landmarks[finger.chain[0], 2]) / pose.px_per_mm
    away = _AWAY[0] + _AWAY[1] * z_mm
    away = min(max(away, -_MOST_AWAY), _MOST_AWAY)
    return np.append(flat / max(float(np.linalg.norm(flat)), 1e-6) * sqrt(1 - away * away), away)


def _angles(axis: Floats, normal: Floats) -> tuple[float, float]:
    """Pitch and yaw of a finger (unit vector in the host frame) against skin with this outward normal."""
    level = np.array([0.0, 1.0, 0.0]) - normal * normal[1]
    across = np.cross(level, normal) * (1.0 if normal[2] > 0 else -1.0)
    pitch = asin(min(max(-float(axis @ normal), 0.0), 1.0))
    return pitch, atan2(float(axis @ across), float(axis @ level))
