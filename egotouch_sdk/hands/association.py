"""Which findings are the same hand.

MediaPipe compares the axis-aligned squares around hands and drops one of two that overlap by more than half. A finger that
touches the other hand does exactly that, so palms are compared by their keypoints and hands by their landmarks instead.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from egotouch_sdk.hands.boxes import bounding_box, overlaps
from egotouch_sdk.hands.palm_detector import PalmDetection
from egotouch_sdk.joints import HandJoint as J

FloatArray = npt.NDArray[np.floating]

#: Landmarks that the palm detector's seven keypoints stand for (palm_detection model card).
PALM_JOINTS = np.array([J.WRIST, J.INDEX_FINGER_MCP, J.MIDDLE_FINGER_MCP, J.RING_FINGER_MCP, J.PINKY_MCP, J.THUMB_CMC, J.THUMB_MCP])

#: A palm belongs to a hand when its keypoints are on average this close, in palm boxes (our measurement on composed overlaps).
_SAME_PALM_DISTANCE = 0.35
#: Two results are one hand when this many landmarks are this close, in hand baselines, and their boxes overlap this much
#: (MediaPipe Tasks, `hand_landmarks_deduplication_calculator.cc`).
_SAME_HAND_JOINTS, _SAME_HAND_DISTANCE, _SAME_HAND_OVERLAP = 10, 0.2, 0.2


def is_same_palm(palm: PalmDetection, palm_keypoints_px: FloatArray) -> bool:
    """True when a detection's keypoints lie on those (7, 2) of a hand that is already known."""
    distances = np.linalg.norm(palm.keypoints_px - palm_keypoints_px, axis=1)
    return bool(distances.mean() <= _SAME_PALM_DISTANCE * palm.size_px)


def hand_baseline_px(landmarks_px: FloatArray) -> float:
    """Size of a hand: the longest of wrist to index MCP, across the knuckles, and wrist to pinky MCP; steady under foreshortening."""
    wrist, index, pinky = (landmarks_px[joint, :2] for joint in (J.WRIST, J.INDEX_FINGER_MCP, J.PINKY_MCP))
    return float(max(np.linalg.norm(index - wrist), np.linalg.norm(pinky - index), np.linalg.norm(pinky - wrist)))


def is_same_hand(a: FloatArray, b: FloatArray) -> bool:
    """True when two sets of landmarks (21, 2 or 3) in pixels lie on one hand."""
    near = np.linalg.norm(a[:, :2] - b[:, :2], axis=1) < _SAME_HAND_DISTANCE * max(hand_baseline_px(a), hand_baseline_px(b))
    return int(near.sum()) >= _SAME_HAND_JOINTS and float(overlaps(bounding_box(a), bounding_box(b)[None])[0]) > _SAME_HAND_OVERLAP
