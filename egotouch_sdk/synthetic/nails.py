"""Fingernails: where they lie on the mesh, and the groove and fold round them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from egotouch_sdk.joints import FINGERS, Finger
from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.skin_side import Relief, SkinSide


@dataclass(frozen=True, slots=True, eq=False)
class NailMasks:
    """Per-vertex masks (n,) in 0..1: the `nail` plate, its `lunula`, its free `edge`, and the fingertip's `pulp`."""

    nail: Array
    lunula: Array
    edge: Array
    pulp: Array


def mark_nails(side: SkinSide, relief: Relief, nail_length: float) -> NailMasks:
    """Place a rounded nail on every fingertip and carve its surroundings into `relief`.

    `nail_length` 0 is cut short, 1 stands about 1.6 mm further out.
    """
    count = len(side.rig.vertices)
    masks = NailMasks(*(np.zeros(count) for _ in range(4)))
    for finger in FINGERS:
        _mark_nail(side, relief, masks, finger, nail_length)
    return masks


def _mark_nail(side: SkinSide, relief: Relief, masks: NailMasks, finger: Finger, nail_length: float) -> None:
    dip, tip = side.rig.finger_joint_ids(finger)[-2:]
    ids = side.finger_ids(finger)
    points, normals = side.in_bone(dip, ids)
    bone = float(np.linalg.norm(side.rig.bind[tip, :3, 3] - side.rig.bind[dip, :3, 3]))
    end_z = points[:, 2].min()
    half_width = 0.78 * np.percentile(np.abs(points[points[:, 2] < -0.3 * bone, 0]), 97)
    root_z = -(0.55 if finger is Finger.THUMB else 0.45) * bone
    free_z = end_z + 0.0012 * (1 - 1.6 * nail_length)
    length = root_z - free_z

    x, along = points[:, 0] / half_width, (points[:, 2] - root_z) / (free_z - root_z)
    to_root = along - (-0.02 + 0.12 * x**2)
    to_free = 1 - 0.16 * x**2 - along
    inside_m = np.minimum(np.minimum(to_root, to_free) * length, (1 - np.abs(x)) * half_width)
    facing = smoothstep(0.05, 0.3, normals[:, 1])
    nail = smoothstep(-0.0002, 0.0003, inside_m) * facing
    masks.nail[ids] = np.maximum(masks.nail[ids], nail)
    masks.lunula[ids] = np.maximum(masks.lunula[ids], 0.7 * nail * smoothstep(0.24, 0.12, along + 0.25 * x**2))
    masks.edge[ids] = np.maximum(masks.edge[ids], nail * smoothstep(0.86 - 0.1 * nail_length, 0.95, along + 0.12 * x**2))
    masks.pulp[ids] += smoothstep(-0.2 * bone, 0.9 * end_z, points[:, 2])

    groove = np.exp(-((inside_m / 0.0006) ** 2)) * facing * (along < 1.02)
    relief.carve(ids, groove, 0.00022, 0.35)
    fold = np.exp(-(((inside_m + 0.0011) / 0.0008) ** 2)) * facing * (along < 0.9)
    relief.carve(ids, fold, -0.00025, 0.0)
