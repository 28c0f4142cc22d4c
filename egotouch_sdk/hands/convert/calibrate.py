"""Measure the activation ranges that `quantise` needs, on rendered hands (a tool for maintainers; needs onnxruntime and OpenCV).

    python -m egotouch_sdk.hands.convert.calibrate IMAGE_OR_CLIP...

Hands are found with the float networks, cropped with random placement, light, colour, blur and noise, and the least and greatest value
of every tensor is written to `activation_ranges.json` beside this file. Use images that this project made itself.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
import onnx
from onnx import TensorProto, helper

from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.convert.build import RANGES_FILE
from egotouch_sdk.hands.convert.quantise import quantised_tensors
from egotouch_sdk.hands.landmarker import INPUT_PX
from egotouch_sdk.hands.roi import Roi, crop_matrix, roi_from_landmarks
from egotouch_sdk.hands.tracker import HandTracker
from egotouch_sdk.inference import create_session
from egotouch_sdk.model_store import hand_model

_CROPS_PER_HAND = 12
_MAX_FRAMES = 24

Image = npt.NDArray[np.uint8]


def read_images(path: str) -> Iterator[Image]:
    """The image, or frames spread evenly over the clip."""
    clip = cv2.VideoCapture(path)
    count = max(int(clip.get(cv2.CAP_PROP_FRAME_COUNT)), 1)
    for number in range(count):
        ok, image = clip.read()
        if ok and number % max(1, count // _MAX_FRAMES) == 0:
            yield np.asarray(image, np.uint8)


def vary(image: Image, roi: Roi, rng: np.random.Generator) -> Image:
    """A crop around a hand as another camera might have seen it."""
    size = roi.size_px
    dx, dy = rng.normal(0, 0.06 * size, 2)
    moved = Roi(roi.x_px + dx, roi.y_px + dy, size * rng.uniform(0.8, 1.3), roi.rotation_rad + rng.normal(0, 0.3))
    crop = cv2.warpAffine(image, crop_matrix(moved, INPUT_PX), (INPUT_PX, INPUT_PX), borderMode=cv2.BORDER_REPLICATE)
    value = crop.astype(np.float32) * rng.uniform(0.25, 1.9) * rng.uniform(0.8, 1.2, 3).astype(np.float32)
    if rng.random() < 0.4:
        value = cv2.GaussianBlur(value, (0, 0), rng.uniform(0.5, 3)).astype(np.float32)
    value = 255 * (np.clip(value, 0, 255) / 255) ** rng.uniform(0.6, 1.6) + rng.normal(0, rng.uniform(0, 8), value.shape)
    if rng.random() < 0.5:
        value = value[:, ::-1]
    return np.asarray(np.clip(value, 0, 255).astype(np.uint8))


def hand_crops(paths: list[str], seed: int = 1) -> list[Image]:
    """Varied crops of every hand in the images and clips."""
    rng, tracker, crops = np.random.default_rng(seed), HandTracker(model="full"), []
    for image in (image for path in paths for image in read_images(path)):
        tracker.reset()
        for hand in tracker.track(Frame(image, 0, 0)):
            crops += [vary(image, roi_from_landmarks(hand.landmarks_px), rng) for _ in range(_CROPS_PER_HAND)]
    return crops


def measure(model_path: Path, crops: list[Image], scratch: Path) -> dict[str, tuple[float, float]]:
    """Least and greatest value of every tensor that will hold integers."""
    model = onnx.load(model_path)
    names = quantised_tensors(model)
    model.graph.output.extend(helper.make_tensor_value_info(name, TensorProto.FLOAT, None) for name in names)
    onnx.save(model, scratch)
    session = create_session(scratch)
    low, high = np.full(len(names), np.inf), np.full(len(names), -np.inf)
    for crop in crops:
        values = session.run(names, {"image": crop[None]})
        low, high = np.minimum(low, [v.min() for v in values]), np.maximum(high, [v.max() for v in values])
    return {name: (round(float(a), 4), round(float(b), 4)) for name, a, b in zip(names, low, high, strict=True)}


def main() -> None:
    """Write `activation_ranges.json` from the images and clips named on the command line."""
    crops = hand_crops(sys.argv[1:])
    if len(crops) < _CROPS_PER_HAND:
        sys.exit("no hands in these images; give rendered hands or a rendered clip")
    scratch = RANGES_FILE.with_suffix(".onnx")
    try:
        ranges = measure(hand_model("hand_landmark_full"), crops, scratch)
    finally:
        scratch.unlink(missing_ok=True)
    RANGES_FILE.write_text(json.dumps({"hand_landmark_full": ranges}, indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(f"{RANGES_FILE.name}: {len(ranges)} tensors from {len(crops)} crops\n")


if __name__ == "__main__":
    main()
