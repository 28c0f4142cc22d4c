"""Hairs, freckles and moles, baked into the albedo as dark strokes and spots."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.mesh import IntArray
from egotouch_sdk.synthetic.skin_side import SkinSide

#: Visible hairs per square millimetre for one unit of density (arms show 0.02-0.1 dark terminal hairs per mm^2).
_HAIRS_PER_MM2 = 0.03
_HAIR_STEP_M = 0.0003
#: A hair is 0.05-0.09 mm wide and mesh edges are 0.43 mm: a stroke one vertex wide covers about that share of it.
_HAIR_COVER = (0.12, 0.32)
_SPLAT_M = 0.00038


def hair_cover(side: SkinSide, tree: cKDTree, density: float, vertex_area_mm2: float) -> Array:
    """Share of each vertex covered by hair, (n,) in 0..0.7.

    Hairs grow on the forearm and, sparser, on the back of hand and first finger bones; they lie towards the little finger's side.
    `density` 0 (none) .. 3 (thick); `vertex_area_mm2` is the mean skin area of a vertex.
    """
    rng = np.random.default_rng(side.seed + 700)
    cover = np.zeros(len(side.points))
    growth = _growth(side) * np.clip(0.7 + 0.5 * side.noise(0.02, 701), 0, None)
    expected = growth * density * _HAIRS_PER_MM2 * vertex_area_mm2
    roots = np.flatnonzero(rng.random(len(expected)) < expected)
    if not len(roots):
        return cover
    on_arm = smoothstep(-0.02, 0.04, side.points[roots, 2])
    length = rng.uniform(0.003, 0.007, len(roots)) + on_arm * rng.uniform(0, 0.008, len(roots))
    heading = _comb(side, roots, rng)
    curl = rng.normal(0, 60, len(roots))
    strength = rng.uniform(*_HAIR_COVER, len(roots))
    position = side.points[roots].copy()
    for step in range(int(length.max() / _HAIR_STEP_M)):
        alive = step * _HAIR_STEP_M < length
        distance, nearest = tree.query(position[alive])
        taper = 1 - 0.6 * step * _HAIR_STEP_M / length[alive]
        np.maximum.at(cover, nearest, strength[alive] * taper * np.exp(-((distance / _SPLAT_M) ** 2)))
        normal = side.normals_in_wrist[nearest]
        ahead = heading[alive] + _HAIR_STEP_M * curl[alive, None] * np.cross(normal, heading[alive])
        ahead -= normal * (ahead * normal).sum(axis=1, keepdims=True)
        heading[alive] = ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
        position[alive] = side.points[nearest] * 0.3 + position[alive] * 0.7 + _HAIR_STEP_M * heading[alive]
    return np.clip(cover, 0, 0.7)


def _growth(side: SkinSide) -> Array:
    z = side.points[:, 2]
    arm = smoothstep(0.01, 0.05, z) * (0.12 + 0.88 * smoothstep(-0.5, 0.2, side.dorsal))
    back_of_hand = 0.4 * smoothstep(0.3, 0.7, side.dorsal) * smoothstep(-0.1, -0.06, z) * smoothstep(0.01, -0.02, side.points[:, 0] - 0.01)
    fingers = 0.25 * smoothstep(0.5, 0.8, side.dorsal) * smoothstep(-0.135, -0.125, z) * smoothstep(-0.1, -0.11, z)
    return np.asarray(np.maximum(arm, np.maximum(back_of_hand * (z < 0.05), fingers)))


def _comb(side: SkinSide, roots: IntArray, rng: np.random.Generator) -> Array:
    """Direction each hair lies in: across the arm to the little finger's side and towards the hand, spread by 25 degrees."""
    normal = side.normals_in_wrist[roots]
    lie = np.array([-0.75, 0.0, -0.65]) + rng.normal(0, 0.35, (len(roots), 3))
    lie -= normal * (lie * normal).sum(axis=1, keepdims=True)
    return np.asarray(lie / np.maximum(np.linalg.norm(lie, axis=1, keepdims=True), 1e-9))


def spots(side: SkinSide, tree: cKDTree, freckles: int, moles: int) -> Array:
    """Extra pigment (n,) from freckles (faint, 0.5-1.5 mm) and moles (dark, 0.4-1.3 mm radius), none on the palm."""
    rng = np.random.default_rng(side.seed + 800)
    pigment = np.zeros(len(side.points))
    for count, radius_m, strength in ((freckles, (0.0005, 0.0015), (0.05, 0.3)), (moles, (0.0004, 0.0013), (0.3, 1.2))):
        for centre in rng.integers(0, len(pigment), count):
            radius, depth = rng.uniform(*radius_m), rng.uniform(*strength)
            if side.palmar[centre] > 0.4:
                continue
            ids = tree.query_ball_point(side.points[centre], 2.5 * radius)
            squared = ((side.points[ids] - side.points[centre]) ** 2).sum(axis=1)
            pigment[ids] += depth * np.exp(-squared / radius**2)
    return pigment
