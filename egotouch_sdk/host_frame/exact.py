"""Host points from landmarks that are exact, as a simulator's: rigid hands seen from afar, not guesses from a picture.

Nothing has to be corrected for them; plain geometry gives back the place and the angles.
"""

from __future__ import annotations

from math import asin, atan2, pi

import numpy as np
import numpy.typing as npt

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame.locate import PALM_MM
from egotouch_sdk.joints import Finger, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation, HostPoint, TouchPair
from egotouch_sdk.surface import surface_at

Floats = npt.NDArray[np.float64]

#: Landmarks are exact when those in the picture and the metric ones have one shape, up to this share of its size. A tracker that
#: guesses both from a picture is 0.20 to 0.56 off (302 hands of the demo clip), a headset's joints seen by a near camera 0.07 to 0.36
#: (1500 random poses at 0.3 to 0.6 m, medians and 99th percentiles), the simulator less than 0.00001 (all our measurement).
MAX_DISAGREEMENT = 0.01
#: A host seen flatter than this (cosine between its normal and the line of sight) gives no place on its skin (our choice: 80 degrees).
MIN_FACING = 0.17


def has_exact_landmarks(pair: TouchPair) -> bool:
    """True when the picture's and the metric landmarks of both hands agree."""
    return _disagreement(pair.host) <= MAX_DISAGREEMENT and _disagreement(pair.touching) <= MAX_DISAGREEMENT


def locate_exact(pair: TouchPair, finger: Finger, config: HostConfig, *, mirrored: bool = False) -> HostPoint | None:
    """The host point of one finger of `pair`; None when the host is seen along its palm.

    The fingertip is taken to be in the plane of wrist and knuckles, as its height is not in the picture. `mirrored` says that the
    picture is a mirror image.
    """
    frame = _host_axes(pair.host)
    if frame is None or abs(frame[2, 2]) < MIN_FACING:
        return None
    across, along, palm_normal = frame
    if (pair.host.handedness is Handedness.LEFT) != mirrored:
        palm_normal = -palm_normal
    shows_palm = bool(palm_normal[2] < 0)
    outward = palm_normal if shows_palm else -palm_normal
    at_px = pair.touching.xy_px(finger.tip).astype(np.float64) - pair.host.xy_px(HandJoint.WRIST)
    axis = pair.host.world_mm[HandJoint.MIDDLE_FINGER_MCP] - pair.host.world_mm[HandJoint.WRIST]
    per_px = (config.palm_mm or PALM_MM) / (float(np.linalg.norm(axis)) * _px_per_mm(pair.host))
    x_mm, y_mm = (np.linalg.solve(np.column_stack([across[:2], along[:2]]), at_px) * per_px).tolist()
    bone = (pair.touching.world_mm[finger.tip] - pair.touching.world_mm[finger.dip]).astype(np.float64)
    bone /= max(float(np.linalg.norm(bone)), 1e-9)
    pitch_rad = min(max(asin(min(max(-float(bone @ outward), -1.0), 1.0)), 0.0), pi / 2)
    return HostPoint(surface_at(y_mm, palm_side=shows_palm), x_mm, y_mm, pitch_rad, atan2(float(bone @ across), float(bone @ along)))


def _host_axes(host: HandObservation) -> Floats | None:
    """Rows: +x, +y of the host frame and their cross product, in the camera's axes; None for a hand without width or length."""
    points = host.world_mm.astype(np.float64)
    along = points[HandJoint.MIDDLE_FINGER_MCP] - points[HandJoint.WRIST]
    thumbwards = points[HandJoint.INDEX_FINGER_MCP] - points[HandJoint.PINKY_MCP]
    along /= max(float(np.linalg.norm(along)), 1e-9)
    across = thumbwards - (thumbwards @ along) * along
    width = float(np.linalg.norm(across))
    if width < 1e-6:
        return None
    across /= width
    return np.stack([across, along, np.cross(across, along)])


def _px_per_mm(hand: HandObservation) -> float:
    """Scale that takes the metric landmarks closest to those in the picture."""
    pixels, world = _centred(hand.landmarks_px), _centred(hand.world_mm)
    return float((pixels * world).sum() / max(float((world * world).sum()), 1e-9))


def _disagreement(hand: HandObservation) -> float:
    """What is left between the picture's landmarks and the scaled metric ones, as a share of the former's spread."""
    pixels, world = _centred(hand.landmarks_px), _centred(hand.world_mm)
    off = pixels - _px_per_mm(hand) * world
    return float(np.linalg.norm(off) / max(float(np.linalg.norm(pixels)), 1e-9))


def _centred(points: npt.NDArray[np.float32]) -> Floats:
    exact = points.astype(np.float64)
    return np.asarray(exact - exact.mean(axis=0))
