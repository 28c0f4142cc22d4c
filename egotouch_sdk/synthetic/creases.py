"""Creases of the skin: finger joints, palm lines, wrist bracelets; sizes in metres judged against photographs."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from egotouch_sdk.joints import FINGERS, Finger
from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.skin_side import Relief, SkinSide

_DEPTH_M = 0.00036
_DARK = 0.75
#: Distance from the knuckle to the crease at the finger's root, where the palm's web begins.
_ROOT_CREASE_M = 0.021
#: Wrinkles over the knuckles at the finger's root are faint while the hand is open.
_KNUCKLE_SHARE = 0.25
#: The three main palm lines in the mirrored wrist frame, (x, z) in millimetres: thumb's, head's and heart's line.
_PALM_LINES_MM = (
    ((34, -72), (16, -62), (2, -42), (-2, -20), (2, -4)),
    ((33, -72), (10, -62), (-14, -50), (-34, -36)),
    ((14, -92), (2, -80), (-18, -70), (-42, -62)),
)
_SMALL_LINES = 9


def carve_finger_creases(side: SkinSide, relief: Relief, strength: float) -> None:
    """Two or three palmar creases and four dorsal wrinkles at every finger joint."""
    for number, finger in enumerate(FINGERS):
        rng = np.random.default_rng(side.seed + number)
        joints = side.rig.finger_joint_ids(finger)
        for bone, joint in enumerate(joints[1:-1], start=1):
            at_root = bone == 1
            palmar_lines = 2 if at_root else 3
            for line in range(palmar_lines + 4):
                palmar = line < palmar_lines
                shift = -_ROOT_CREASE_M if palmar and at_root and finger is not Finger.THUMB else 0.0
                share = _KNUCKLE_SHARE if at_root and not palmar else 1.0
                _carve_joint_line(side, relief, rng, finger, joint, line, palmar, shift, strength * share)


def _carve_joint_line(
    side: SkinSide,
    relief: Relief,
    rng: np.random.Generator,
    finger: Finger,
    joint: int,
    line: int,
    palmar: bool,
    shift_m: float,
    strength: float,
) -> None:
    ids = side.finger_ids(finger)
    points, normals = side.in_bone(joint, ids)
    offset = rng.uniform(-0.0022, 0.0022) if palmar else rng.uniform(-0.0045, 0.0045)
    amount = (rng.uniform(0.5, 1.2) if palmar else rng.uniform(0.3, 0.9)) * strength
    width = rng.uniform(0.00035, 0.0006)
    near = np.abs(points[:, 2] - shift_m) < 0.012
    ids, points, normals = ids[near], points[near], normals[near]
    bend = 0.0008 * side.noise(0.006, 31 * joint + line, ids)
    if not palmar:
        bend -= 0.0012 * (points[:, 0] / 0.008) ** 2 * np.sign(offset)
    profile = np.exp(-(((points[:, 2] - shift_m - offset - bend) / width) ** 2)) * amount
    profile *= smoothstep(0.2, -0.2, normals[:, 1]) if palmar else smoothstep(0.1, 0.5, normals[:, 1])
    profile *= np.clip(0.6 + 0.5 * side.noise(0.005, 77 * joint + line, ids), 0, 1.2)
    relief.carve(ids, profile, _DEPTH_M, _DARK)


def carve_palm(side: SkinSide, relief: Relief, strength: float) -> None:
    """The three main lines of the palm, each person's a little different, and nine small random ones."""
    rng = np.random.default_rng(side.seed + 999)
    for number, line in enumerate(_PALM_LINES_MM):
        path = np.array(line) + rng.normal(0, 2.5, (len(line), 2))
        _carve_path(side, relief, path * 1e-3, 0.0006, (1.0 if number == 0 else 0.95) * strength, 100 + 10 * number)
    for number in range(_SMALL_LINES):
        start, angle, length = rng.uniform([-32, -75], [30, -10]), rng.uniform(0, np.pi), rng.uniform(8, 28)
        end = start + length * np.array([np.cos(angle), np.sin(angle)])
        path = np.stack([start, (start + end) / 2 + rng.normal(0, 2, 2), end]) * 1e-3
        _carve_path(side, relief, path, rng.uniform(0.0003, 0.00045), rng.uniform(0.2, 0.6) * strength, 200 + 11 * number)


def _carve_path(side: SkinSide, relief: Relief, path: Array, width_m: float, strength: float, salt: int) -> None:
    points = side.points
    ids = np.flatnonzero((side.palmar > 0.3) & (points[:, 2] < 0.02) & (points[:, 2] > -0.12))
    t = np.linspace(0, 1, 200)
    curve = CubicSpline(np.linspace(0, 1, len(path)), path)(t)
    flat = points[ids][:, [0, 2]]
    near = _within_box(flat, curve, 0.006)
    ids, flat = ids[near], flat[near]
    wobble = [0.0009 * side.noise(0.008, salt + k, ids) + 0.00013 * side.noise(0.002, salt + 2 + k, ids) for k in range(2)]
    distance, nearest = cKDTree(curve).query(flat + np.stack(wobble, axis=1))
    ends = np.sqrt(np.sin(np.pi * np.clip(t[nearest] * 0.94 + 0.03, 0, 1))) * strength
    sharp = np.exp(-((distance / width_m) ** 2)) * ends * np.clip(0.8 + 0.35 * side.noise(0.006, salt + 4, ids), 0.1, 1.3)
    soft = np.exp(-((distance / (4 * width_m)) ** 2)) * ends
    relief.carve(ids, sharp, 0.0006, 1.25)
    relief.carve(ids, soft, 0.0007, 0.12)


def _within_box(flat: Array, curve: Array, margin_m: float) -> Array:
    return np.asarray(((flat > curve.min(axis=0) - margin_m) & (flat < curve.max(axis=0) + margin_m)).all(axis=1))


def carve_wrist(side: SkinSide, relief: Relief, strength: float) -> None:
    """Three bracelet lines across the inner wrist."""
    rng = np.random.default_rng(side.seed + 888)
    points = side.points
    ids = np.flatnonzero((points[:, 2] > -0.005) & (points[:, 2] < 0.04) & (points[:, 1] < 0) & (side.palmar > 0))
    x, z = points[ids, 0], points[ids, 2]
    for line in range(3):
        centre = 0.004 + 0.007 * line + rng.normal(0, 0.001)
        offset = z - centre - 0.0012 * side.noise(0.012, 300 + line, ids) + 5.0 * x**2
        profile = np.exp(-((offset / 0.0006) ** 2)) * side.palmar[ids] * rng.uniform(0.4, 0.9) * strength
        relief.carve(ids, profile, 0.0004, 0.5)
