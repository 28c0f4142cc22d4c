"""Random touches without pictures: landmarks of both hands, exact or as noisy as a tracker's, and the exact answer."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from egotouch_sdk.joints import NUM_JOINTS, Handedness
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.host_truth import HostTruth, view_of
from egotouch_sdk.synthetic.linalg import Array
from egotouch_sdk.synthetic.patches_job import participant
from egotouch_sdk.synthetic.stage import ImpossibleSceneError
from egotouch_sdk.synthetic.stills import draw_scene

#: Standard deviation of the tracker's landmarks in millimetres, along the picture and in depth: medians over the palm landmarks of
#: 35 rendered stills of touching hands (our measurement).
NOISE_MM, DEPTH_NOISE_MM = 3.0, 16.0


def draw_poses(count: int, participants: tuple[int, ...], seed: int) -> Iterator[HostTruth]:
    """Up to `count` views of scenes drawn as for stills, about five a second; the same arguments give the same ones."""
    host, touching = HandRig("left"), HandRig("right")
    for index in range(count):
        number = participants[index % len(participants)]
        try:
            stage, touch, camera = draw_scene(np.random.default_rng([seed, index]), host, touching, participant(number), detail=False)
        except ImpossibleSceneError:
            continue
        yield view_of(stage, touch, camera, number)


def observed(truth: HostTruth, rng: np.random.Generator, noise_mm: float = NOISE_MM, depth_noise_mm: float = DEPTH_NOISE_MM) -> TouchPair:
    """Both hands as a tracker with independent noise on every landmark would see them (0 for exact ones)."""
    touching = _seen(1, Handedness.RIGHT, truth, truth.touching_mm, rng, (noise_mm, noise_mm, depth_noise_mm))
    host = _seen(2, Handedness.LEFT, truth, truth.host_mm, rng, (noise_mm, noise_mm, depth_noise_mm))
    return TouchPair(touching, host, 0.0, (truth.finger,))


def _seen(
    hand_id: int, side: Handedness, truth: HostTruth, landmarks_mm: Array, rng: np.random.Generator, noise_mm: tuple[float, float, float]
) -> HandObservation:
    px_per_mm = truth.focal_px / float(landmarks_mm[:, 2].mean())
    noise = rng.standard_normal((NUM_JOINTS, 3)) * noise_mm
    world = landmarks_mm - landmarks_mm.mean(0)
    landmarks = truth.landmarks_px(landmarks_mm) + noise * px_per_mm
    return HandObservation(hand_id, side, 1.0, landmarks.astype(np.float32), (world + noise).astype(np.float32))
