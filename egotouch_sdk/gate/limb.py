"""The host limb in the image: the hand's outline and the forearm behind its wrist."""

from __future__ import annotations

from math import acos, hypot, pi, sin

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.config import GateConfig
from egotouch_sdk.hand_geometry import palm_length_px
from egotouch_sdk.joints import HandJoint
from egotouch_sdk.observation import HandObservation


class Limb:
    """One host limb; distances are in its own palm lengths."""

    def __init__(self, host: HandObservation, config: GateConfig) -> None:
        self._palm_px = palm_length_px(host)
        self._points = host.landmarks_px[:, :2]
        self._outline = cv2.convexHull(np.ascontiguousarray(self._points))
        wrist, knuckle = host.xy_px(HandJoint.WRIST).tolist(), host.xy_px(HandJoint.MIDDLE_FINGER_MCP).tolist()
        self._wrist = wrist
        length = hypot(wrist[0] - knuckle[0], wrist[1] - knuckle[1])
        self._behind = ((wrist[0] - knuckle[0]) / length, (wrist[1] - knuckle[1]) / length) if length > 0.0 else None
        self._forearm_palms = config.forearm_palms
        self._half_angle_rad = config.forearm_half_angle_rad

    def hand_distance_palms(self, points_px: npt.NDArray[np.float32]) -> float:
        """Shortest distance between any of `points_px` (N, 2) and any of the host's landmarks."""
        difference = points_px[:, None, :] - self._points[None, :, :]
        return float(np.sqrt((difference * difference).sum(axis=2).min())) / self._palm_px

    def gap_palms(self, x_px: float, y_px: float) -> float:
        """Distance from a point to the limb's outline, negative inside it."""
        to_hand = -float(cv2.pointPolygonTest(self._outline, (x_px, y_px), True)) / self._palm_px
        return min(to_hand, self._forearm_gap_palms(x_px, y_px))

    def _forearm_gap_palms(self, x_px: float, y_px: float) -> float:
        """Distance to a sector with its apex at the wrist: as long as the forearm and as wide as the wrist can bend."""
        dx, dy = (x_px - self._wrist[0]) / self._palm_px, (y_px - self._wrist[1]) / self._palm_px
        radius = hypot(dx, dy)
        if self._behind is None or radius == 0.0:
            return radius
        cosine = (dx * self._behind[0] + dy * self._behind[1]) / radius
        beyond_rad = acos(min(1.0, max(-1.0, cosine))) - self._half_angle_rad
        beside = radius if beyond_rad > pi / 2 else radius * sin(max(beyond_rad, -pi / 2))
        return max(beside, radius - self._forearm_palms)
