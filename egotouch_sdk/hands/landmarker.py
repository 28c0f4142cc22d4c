"""21 landmarks of the hand inside a given region: MediaPipe's hand landmark network."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.hands.roi import Roi, crop_matrix, landmarks_to_image, world_to_image_axes
from egotouch_sdk.inference import create_session
from egotouch_sdk.joints import NUM_JOINTS
from egotouch_sdk.model_store import hand_model

Image = npt.NDArray[np.uint8]

#: Side of the network's input (hand_landmark_full.tflite).
INPUT_PX = 224
_MM_PER_M = 1000.0
_OUTPUTS = ["landmarks", "presence", "handedness", "world"]


@dataclass(frozen=True, slots=True, eq=False)
class LocatedHand:
    """What the network saw in one region.

    `landmarks_px` (21, 3) and `world_mm` (21, 3) as in `HandObservation`; `presence` 0..1;
    `right_probability` 0..1 that it is a right hand, taking the image as not mirrored.
    """

    landmarks_px: npt.NDArray[np.float32]
    world_mm: npt.NDArray[np.float32]
    presence: float
    right_probability: float


class Landmarker:
    """Runs the landmark network on one region at a time; may be called from several threads at once."""

    def __init__(self, model: str = "hand_landmark_full") -> None:
        self._session = create_session(hand_model(model))

    def locate(self, image: Image, roi: Roi) -> LocatedHand:
        """The hand in this region of a BGR image; look at `presence` before you use it."""
        matrix = crop_matrix(roi, INPUT_PX)
        crop = cv2.warpAffine(image, matrix, (INPUT_PX, INPUT_PX), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        landmarks, presence, handedness, world = self._session.run(_OUTPUTS, {"image": crop[None]})
        return LocatedHand(
            landmarks_to_image(landmarks.reshape(NUM_JOINTS, 3), roi, INPUT_PX),
            world_to_image_axes(world.reshape(NUM_JOINTS, 3) * _MM_PER_M, roi),
            float(presence[0, 0]),
            float(handedness[0, 0]),
        )
