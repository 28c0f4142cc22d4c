"""Palms in a whole image: MediaPipe's palm detection network, decoded."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.hands.boxes import weighted_suppression
from egotouch_sdk.hands.roi import Roi, roi_from_palm
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_store import hand_model

FloatArray = npt.NDArray[np.floating]
Image = npt.NDArray[np.uint8]

#: Side of the network's input (palm_detection_full.tflite).
INPUT_PX = 192
#: Cells per side and anchors per cell of each feature map (strides 8 and 3 x 16, two anchors each; palm_detection_gpu.pbtxt).
_ANCHOR_MAPS = ((24, 2), (12, 6))
#: Detections that overlap more than this are one palm (palm_detection_cpu.pbtxt).
_SAME_PALM_OVERLAP = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class PalmDetection:
    """One palm: box (x0, y0, x1, y1) and keypoints (7, 2) in image pixels, score 0..1.

    Keypoints: wrist, index, middle, ring, pinky MCP, thumb CMC, thumb MCP.
    """

    box_px: FloatArray
    keypoints_px: FloatArray
    score: float

    @property
    def roi(self) -> Roi:
        """Where the landmark network should look."""
        return roi_from_palm(self.box_px, self.keypoints_px)

    @property
    def size_px(self) -> float:
        """Longer side of the box."""
        return float(max(self.box_px[2:] - self.box_px[:2]))


def make_anchors() -> npt.NDArray[np.float32]:
    """Anchor centres (2016, 2), x and y in 0..1, in the network's order."""
    maps = []
    for cells, per_cell in _ANCHOR_MAPS:
        centres = (np.arange(cells, dtype=np.float32) + 0.5) / cells
        y, x = np.meshgrid(centres, centres, indexing="ij")
        maps.append(np.repeat(np.stack([x, y], -1).reshape(-1, 2), per_cell, axis=0))
    return np.concatenate(maps)


def decode(raw_boxes: FloatArray, logits: FloatArray, anchors: FloatArray, min_score: float) -> list[PalmDetection]:
    """Network outputs (2016, 18) and (2016,) -> palms in units of the square input (0..1), best first."""
    chosen = (logits >= np.log(min_score / (1 - min_score))) & (raw_boxes[:, 2:4] > 0).all(1)
    if not chosen.any():
        return []
    raw, centres = raw_boxes[chosen].astype(np.float64) / INPUT_PX, anchors[chosen]
    scores = 1 / (1 + np.exp(-np.clip(logits[chosen].astype(np.float64), -100, 100)))
    middle, half = raw[:, :2] + centres, raw[:, 2:4] / 2
    boxes = np.concatenate([middle - half, middle + half], axis=1)
    keypoints = raw[:, 4:].reshape(-1, 7, 2) + centres[:, None]
    return [
        PalmDetection(weights @ boxes[members], np.tensordot(weights, keypoints[members], 1), float(scores[members[0]]))
        for members, weights in weighted_suppression(boxes, scores, _SAME_PALM_OVERLAP)
    ]


class PalmDetector:
    """Finds palms anywhere in a BGR image; those below `min_score` (0..1) are dropped."""

    def __init__(self, model: str = "palm_detection_full", min_score: float = 0.5) -> None:
        self._session = create_session(hand_model(model))
        self._anchors = make_anchors()
        self._min_score = min_score

    def detect(self, image: Image) -> list[PalmDetection]:
        """Palms in image pixels, best first."""
        height, width = image.shape[:2]
        side = max(height, width)
        scale = INPUT_PX / side
        letterbox = np.array([[scale, 0, (INPUT_PX - width * scale) / 2], [0, scale, (INPUT_PX - height * scale) / 2]])
        canvas = cv2.warpAffine(image, letterbox, (INPUT_PX, INPUT_PX), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
        raw, logits = self._session.run(["boxes", "scores"], {"image": canvas[None]})
        margin = np.array([(side - width) / 2, (side - height) / 2])
        return [
            PalmDetection(palm.box_px * side - np.tile(margin, 2), palm.keypoints_px * side - margin, palm.score)
            for palm in decode(raw[0], logits[0, :, 0], self._anchors, self._min_score)
        ]
