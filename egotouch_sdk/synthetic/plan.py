"""Everything about one touch scene that is drawn at random before any geometry is moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from egotouch_sdk.joints import Finger
from egotouch_sdk.synthetic.contact import Tissue, draw_tissue
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Indices
from egotouch_sdk.synthetic.pose import Rotations, open_hand, pointing_hand

PLACES = ("palm", "back_of_hand", "inner_forearm", "outer_forearm")
_PLACE_ODDS = (0.46, 0.20, 0.20, 0.14)
_FINGER_ODDS = (0.27, 0.37, 0.14, 0.12, 0.10)
_THUMB_ON_PALM = 0.7
_LEVEL_OF_SITES = 1

#: Azimuth (degrees) of the receiving arm in the image for each place: how wearers hold it in front of them (our choice).
_ARM_AZIMUTH = {"palm": (-20, 105), "back_of_hand": (-10, 75), "inner_forearm": (0, 75), "outer_forearm": (0, 60)}


@dataclass(frozen=True, slots=True)
class ScenePlan:
    """One pose of both arms and the camera: angles in radians, lengths in metres.

    `site` is a vertex of the receiving rig; the finger comes in at `heading` (in the image), `pitch` and `roll`.
    """

    place: str
    finger: Finger
    host_pose: Rotations
    touching_pose: Rotations
    site: int
    arm_azimuth_rad: float
    view_tilt_rad: float
    view_azimuth_rad: float
    distance_m: float
    heading_rad: float
    pitch_rad: float
    roll_rad: float
    tissue: Tissue


def sites(rig: HandRig, place: str) -> Indices:
    """Vertices of the receiving rig (left hand, level 1) that belong to `place`, out to the rounded edges of the hand."""
    n = rig.vertex_count_at[_LEVEL_OF_SITES]
    local = rig.wrist_coords[:n]
    dorsal = (rig.normals[:n] @ rig.bind[0, :3, :3])[:, 1]
    on_hand = (np.abs(local[:, 0]) < 0.046) & (local[:, 2] < 0.004) & (local[:, 2] > -0.096)
    on_arm = (local[:, 2] > 0.03) & (local[:, 2] < 0.17)
    mask = {
        "palm": on_hand & (dorsal < -0.45),
        "back_of_hand": on_hand & (dorsal > 0.65),
        "inner_forearm": on_arm & (dorsal < -0.7),
        "outer_forearm": on_arm & (dorsal > 0.75),
    }[place]
    return np.flatnonzero(mask)


def draw_subject(rng: np.random.Generator) -> tuple[Finger, str]:
    """Which finger touches where. Drawn apart from the pose, so that what is often hidden or blocked does not become rare."""
    finger = list(Finger)[rng.choice(5, p=_FINGER_ODDS)]
    return finger, "palm" if finger is Finger.THUMB and rng.random() < _THUMB_ON_PALM else PLACES[rng.choice(4, p=_PLACE_ODDS)]


def draw_plan(rng: np.random.Generator, host: HandRig, finger: Finger, place: str) -> ScenePlan:
    """A random pose of that finger over that place; it may turn out impossible (hidden tip, colliding arms) once posed."""
    thumb = finger is Finger.THUMB
    return ScenePlan(
        place=place,
        finger=finger,
        host_pose=open_hand(rng),
        touching_pose=pointing_hand(rng, finger),
        site=int(rng.choice(sites(host, place))),
        arm_azimuth_rad=np.radians(rng.uniform(*_ARM_AZIMUTH[place])),
        view_tilt_rad=np.radians(rng.uniform(0, 38)),
        view_azimuth_rad=rng.uniform(0, 2 * np.pi),
        distance_m=rng.uniform(0.26, 0.5),
        heading_rad=np.radians(rng.uniform(40, 130) if thumb else rng.uniform(75, 172)),
        pitch_rad=np.radians(rng.uniform(8, 48) if thumb else rng.uniform(12, 60)),
        roll_rad=np.radians(rng.uniform(-60, 15) if thumb else rng.uniform(-25, 25)),
        tissue=draw_tissue(rng, place),
    )
