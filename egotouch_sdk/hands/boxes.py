"""Axis-aligned boxes: overlap and MediaPipe's weighted non-maximum suppression."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.floating]


def bounding_box(points: FloatArray) -> FloatArray:
    """(x0, y0, x1, y1) around points (N, 2 or more)."""
    return np.concatenate([points[:, :2].min(0), points[:, :2].max(0)])


def overlaps(box: FloatArray, boxes: FloatArray) -> FloatArray:
    """Intersection over union, 0..1, of one box (4,) with each of (N, 4)."""
    low, high = np.maximum(box[:2], boxes[:, :2]), np.minimum(box[2:], boxes[:, 2:])
    shared = np.clip(high - low, 0, None).prod(1)
    union = (box[2:] - box[:2]).prod() + (boxes[:, 2:] - boxes[:, :2]).prod(1) - shared
    return np.asarray(np.where(union > 0, shared / np.maximum(union, 1e-12), 0.0))


def weighted_suppression(boxes: FloatArray, scores: FloatArray, threshold: float) -> list[tuple[npt.NDArray[np.intp], FloatArray]]:
    """Group boxes (N, 4) that overlap the best remaining one by more than `threshold`, best group first.

    Each group is (member indices, weights that sum to 1): MediaPipe takes the score-weighted mean of a group's members
    (`non_max_suppression_calculator.cc`, WEIGHTED).
    """
    groups: list[tuple[npt.NDArray[np.intp], FloatArray]] = []
    remaining = np.argsort(-scores, kind="stable")
    while len(remaining):
        close = overlaps(boxes[remaining[0]], boxes[remaining]) > threshold
        close[0] = True  # a box of no area overlaps nothing, not even itself
        members = remaining[close]
        groups.append((members, scores[members] / scores[members].sum()))
        remaining = remaining[~close]
    return groups
