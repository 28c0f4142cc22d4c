"""Rotated square regions of interest: from a palm or from landmarks, into the network's crop and back.

All constants are MediaPipe's (mediapipe 0.10.21, `palm_detection_detection_to_roi.pbtxt`,
`hand_landmark_landmarks_to_roi.pbtxt`, `hand_landmarks_to_rect_calculator.cc`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import HandJoint as J

Float64Array = npt.NDArray[np.float64]
FloatArray = npt.NDArray[np.floating]

#: Region around a palm: this many times the palm box, moved by this share of its height away from the wrist.
_PALM_SCALE, _PALM_SHIFT = 2.6, 0.5
#: Region around landmarks: this many times their box, moved by this share of its height away from the wrist.
_LANDMARKS_SCALE, _LANDMARKS_SHIFT = 2.0, 0.1
#: The network's depth is in crop pixels times this.
_DEPTH_SCALE = 0.4

#: Landmarks that span the region of the next frame: MediaPipe leaves the outer finger joints out.
_ROI_JOINTS = np.array(
    [
        *(J.WRIST, J.THUMB_CMC, J.THUMB_MCP, J.THUMB_IP, J.INDEX_FINGER_MCP, J.INDEX_FINGER_PIP),
        *(J.MIDDLE_FINGER_MCP, J.MIDDLE_FINGER_PIP, J.RING_FINGER_MCP, J.RING_FINGER_PIP, J.PINKY_MCP, J.PINKY_PIP),
    ]
)


@dataclass(frozen=True, slots=True)
class Roi:
    """A rotated square: centre and side in image pixels; `rotation_rad` turns image-up into the hand's wrist-to-fingers direction."""

    x_px: float
    y_px: float
    size_px: float
    rotation_rad: float

    def __post_init__(self) -> None:
        if not all(math.isfinite(v) for v in (self.x_px, self.y_px, self.size_px, self.rotation_rad)) or self.size_px <= 0:
            raise FrameError(f"region of interest is not usable: {self.x_px}, {self.y_px}, size {self.size_px} px, {self.rotation_rad} rad")

    def moved(self, offset_px: FloatArray) -> Roi:
        """The same square shifted by (dx, dy)."""
        return Roi(self.x_px + float(offset_px[0]), self.y_px + float(offset_px[1]), self.size_px, self.rotation_rad)


def roi_from_palm(box_px: FloatArray, keypoints_px: FloatArray) -> Roi:
    """Region for the landmark network from a palm box (x0, y0, x1, y1) and its 7 keypoints (7, 2): 0 = wrist, 2 = middle MCP."""
    rotation = _upright(keypoints_px[2] - keypoints_px[0])
    width, height = float(box_px[2] - box_px[0]), float(box_px[3] - box_px[1])
    centre = (box_px[:2] + box_px[2:]) / 2 + _PALM_SHIFT * height * _up(rotation)
    return Roi(float(centre[0]), float(centre[1]), max(width, height) * _PALM_SCALE, rotation)


def roi_from_landmarks(landmarks_px: FloatArray) -> Roi:
    """Region for the next frame from this frame's landmarks (21, 2 or 3)."""
    points = np.asarray(landmarks_px, np.float64)[:, :2]
    knuckles = points[J.INDEX_FINGER_MCP] / 4 + points[J.MIDDLE_FINGER_MCP] / 2 + points[J.RING_FINGER_MCP] / 4
    rotation = _upright(knuckles - points[J.WRIST])
    chosen = points[_ROI_JOINTS]
    pivot = (chosen.max(0) + chosen.min(0)) / 2
    to_hand = _rotation(rotation)
    aligned = (chosen - pivot) @ to_hand
    low, high = aligned.min(0), aligned.max(0)
    width, height = high - low
    centre = pivot + to_hand @ ((low + high) / 2) + _LANDMARKS_SHIFT * height * _up(rotation)
    return Roi(float(centre[0]), float(centre[1]), float(max(width, height)) * _LANDMARKS_SCALE, rotation)


def crop_matrix(roi: Roi, side_px: int) -> Float64Array:
    """(2, 3) affine from image pixels to the pixels of an upright crop of `side_px`."""
    scale = side_px / roi.size_px
    c, s = math.cos(roi.rotation_rad) * scale, math.sin(roi.rotation_rad) * scale
    half = side_px / 2
    return np.array([[c, s, half - c * roi.x_px - s * roi.y_px], [-s, c, half + s * roi.x_px - c * roi.y_px]])


def landmarks_to_image(crop_landmarks: FloatArray, roi: Roi, side_px: int) -> npt.NDArray[np.float32]:
    """Landmarks (21, 3) in crop pixels -> image pixels; z keeps its sign and takes the scale of x and y."""
    values = np.asarray(crop_landmarks, np.float64)
    scale = roi.size_px / side_px
    out = np.empty((len(values), 3), np.float32)
    out[:, :2] = (values[:, :2] - side_px / 2) * scale @ _rotation(roi.rotation_rad).T + (roi.x_px, roi.y_px)
    out[:, 2] = values[:, 2] * scale / _DEPTH_SCALE
    return out


def world_to_image_axes(world: FloatArray, roi: Roi) -> npt.NDArray[np.float32]:
    """Metric landmarks (21, 3) in the crop's axes -> the image's axes (x right, y down, z away)."""
    out = np.array(world, np.float32)
    out[:, :2] = np.asarray(world, np.float64)[:, :2] @ _rotation(roi.rotation_rad).T
    return out


def _rotation(angle_rad: float) -> Float64Array:
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[c, -s], [s, c]])


def _up(rotation_rad: float) -> Float64Array:
    return np.array([math.sin(rotation_rad), -math.cos(rotation_rad)])


def _upright(direction: FloatArray) -> float:
    """Angle in [-pi, pi) that turns image-up into `direction`."""
    angle = math.pi / 2 - math.atan2(-float(direction[1]), float(direction[0]))
    return angle - 2 * math.pi * math.floor((angle + math.pi) / (2 * math.pi))
