"""The simulated wearer's hand: 21 landmarks in millimetres, flat for a host and pointing for a touching hand.

A hand is described in its own frame: x to its thumb side, y from the wrist to the middle MCP, z out of the palm. Sizes are those
between MediaPipe's landmarks on the generic WebXR hand, rounded (our measurement).
"""

from __future__ import annotations

from collections.abc import Collection
from math import cos, radians, sin
from typing import Final

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import FINGERS, NUM_JOINTS, Finger

Points = npt.NDArray[np.float64]

#: Wrist to middle MCP; the host frame's millimetres are those of a hand of this size.
PALM_MM: Final = 83.0

_KNUCKLES_MM = {Finger.INDEX: (22.0, 80.0), Finger.MIDDLE: (0.0, PALM_MM), Finger.RING: (-18.0, 77.0), Finger.PINKY: (-36.0, 66.0)}
_PHALANGES_MM = {
    Finger.INDEX: (38.0, 24.0, 16.0),
    Finger.MIDDLE: (40.0, 27.0, 17.6),
    Finger.RING: (36.0, 27.0, 16.7),
    Finger.PINKY: (28.0, 20.0, 15.3),
}
_OPEN_THUMB_MM = ((23.0, 18.0, 8.0), (42.0, 44.0, 12.0), (58.0, 72.0, 14.0), (67.0, 87.5, 14.0))
_TUCKED_THUMB_MM = ((23.0, 18.0, 8.0), (38.0, 46.0, 18.0), (15.0, 58.0, 30.0), (-3.0, 59.0, 31.0))
_FLAT_DEG = (0.0, 0.0, 0.0)
_POINTING_DEG = (12.0, 8.0, 5.0)
_FIST_DEG = (75.0, 100.0, 65.0)


def flat_hand() -> Points:
    """Landmarks (21, 3) of an open hand whose palm and fingers lie in one plane."""
    return _hand(dict.fromkeys(FINGERS, _FLAT_DEG))


def pointing_hand(pointing: Collection[Finger]) -> Points:
    """Landmarks (21, 3) of a hand that points with some fingers, slightly bent, and makes a fist of the others."""
    return _hand({finger: _POINTING_DEG if finger in pointing else _FIST_DEG for finger in FINGERS})


def _hand(bends_deg: dict[Finger, tuple[float, float, float]]) -> Points:
    points = np.zeros((NUM_JOINTS, 3))
    for finger in FINGERS:
        chain = list(finger.chain)
        if finger is Finger.THUMB:
            points[chain] = _TUCKED_THUMB_MM if bends_deg[finger] is _FIST_DEG else _OPEN_THUMB_MM
            continue
        position, angle_rad = np.array([*_KNUCKLES_MM[finger], 0.0]), 0.0
        points[chain[0]] = position
        for joint, bone_mm, bend_deg in zip(chain[1:], _PHALANGES_MM[finger], bends_deg[finger], strict=True):
            angle_rad += radians(bend_deg)
            position = position + bone_mm * np.array([0.0, cos(angle_rad), sin(angle_rad)])
            points[joint] = position
    return points
