"""The tracker against MediaPipe's own, on stored numbers (see make_reference.py)."""

import hashlib
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.association import hand_baseline_px
from egotouch_sdk.hands.boxes import overlaps
from egotouch_sdk.hands.roi import roi_from_landmarks
from egotouch_sdk.hands.tracker import HandTracker
from egotouch_sdk.observation import HandObservation
from tests.golden.hands.make_reference import find_files, read_frames

HERE = Path(__file__).parent
DEMO_CLIP = Path(__file__).parents[3] / "egotouch_sdk" / "assets" / "demo.mp4"
#: Mean landmark distance over palm length that still counts as the same hand.
MARGIN = 0.03
#: MediaPipe's labels take the image for a mirrored selfie.
SIDES = {"Left": "right", "Right": "left"}
#: MediaPipe drops one of two hands whose axis-aligned regions overlap by more than this; we keep both.
MEDIAPIPE_DROPS_ABOVE = 0.5
#: Share of frames in which a blurred hand may be found by one and missed by the other: in circlecc_12.mp4 frame 13 a palm scores
#: 0.503 against the threshold of 0.5, and OpenCV 5 interpolates more exactly than the OpenCV 4.11 behind the reference.
MAX_UNEQUAL_FRAMES = 0.02


def frames(reference: dict[str, Any], files: list[Path]) -> Iterator[tuple[str, Frame, list[dict[str, Any]]]]:
    """(name, frame, MediaPipe's hands) of every stored frame among the files."""
    for file in files:
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        if not any(key.startswith(digest) for key in reference["frames"]):
            continue
        for number, image in read_frames(file):
            yield f"{file.name}:{number}", Frame(image, 0, number), reference["frames"][f"{digest}:{number}"]["hands"]


def distance_palms(hand: HandObservation, expected: dict[str, Any]) -> float:
    landmarks = np.array(expected["landmarks_px"])
    return float(np.linalg.norm((hand.landmarks_px - landmarks)[:, :2], axis=1).mean() / hand_baseline_px(landmarks))


def box(hand: HandObservation) -> np.ndarray:
    roi = roi_from_landmarks(hand.landmarks_px)
    return np.array([roi.x_px, roi.y_px, roi.x_px, roi.y_px]) + np.array([-1, -1, 1, 1]) * roi.size_px / 2


def compare(hands: tuple[HandObservation, ...], expected: list[dict[str, Any]]) -> tuple[list[tuple[float, bool]], bool]:
    """((distance, same side) of each expected hand to ours, whether the same hands were found)."""
    pairs, left = [], list(hands)
    for theirs in expected[: len(hands)]:
        ours = min(left, key=lambda hand: distance_palms(hand, theirs))
        left.remove(ours)
        pairs.append((distance_palms(ours, theirs), ours.handedness == SIDES[theirs["label"]]))
    extra_is_justified = all(any(overlaps(box(e), box(h)[None])[0] > MEDIAPIPE_DROPS_ABOVE for h in hands if h is not e) for e in left)
    return pairs, len(hands) >= len(expected) and extra_is_justified


def check(model: str, reference_name: str, files: list[Path], at_least: int) -> None:
    stored = HERE / reference_name
    reference = json.loads(stored.read_text()) if stored.is_file() else {"frames": {}}
    tracker, pairs, unequal, count = HandTracker(model=model), [], [], 0
    for name, frame, expected in frames(reference, files):
        tracker.reset()
        found, equal = compare(tracker.track(frame), expected)
        pairs += [(name, *pair) for pair in found]
        unequal += [] if equal else [name]
        count += 1
    assert count, f"{reference_name} knows none of these files: run make_reference.py for them"
    distances = [distance for _, distance, _ in pairs]
    print(f"{model}: {len(pairs)} hands in {count} frames, palms away: median {np.median(distances):.4f}, worst {max(distances):.4f}")
    assert len(pairs) >= at_least
    assert [pair for pair in pairs if pair[1] >= MARGIN or not pair[2]] == []
    assert len(unequal) <= MAX_UNEQUAL_FRAMES * count, unequal


@pytest.mark.real_data
@pytest.mark.parametrize("model", ["int8", "full"])
def test_real_photos_and_clips(model):
    folder = os.environ.get("EGOTOUCH_REAL_DIR")
    if not folder:
        pytest.skip("EGOTOUCH_REAL_DIR does not name a folder of real photos")
    check(model, "real_reference.json", find_files([folder]), at_least=50)


@pytest.mark.parametrize("model", ["int8", "full"])
def test_demo_clip(model):
    if not DEMO_CLIP.is_file():
        pytest.skip("this checkout has no demo clip")
    check(model, "demo_reference.json", [DEMO_CLIP], at_least=8)
