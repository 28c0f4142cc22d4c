"""Poses of the receiving and the pointing hand, drawn at random within anatomical ranges (degrees; our choice)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from egotouch_sdk.joints import FINGERS, Finger

Rotations = Mapping[str, tuple[float, float, float]]
_LONG = tuple(f for f in FINGERS if f is not Finger.THUMB)


def _set(pose: dict[str, tuple[float, float, float]], finger: Finger, flexions: tuple[float, float, float], spread: float) -> None:
    for part, flexion in zip(("proximal", "intermediate", "distal"), flexions, strict=True):
        pose[f"{finger}-finger-phalanx-{part}"] = (flexion, spread if part == "proximal" else 0.0, 0.0)


def open_hand(rng: np.random.Generator) -> Rotations:
    """A relaxed to flat receiving hand: joint name -> (flexion, abduction, twist) in degrees."""
    pose: dict[str, tuple[float, float, float]] = {}
    curl = rng.uniform(0.1, 1.0)
    for i, finger in enumerate(_LONG):
        flexions = (rng.uniform(-4, 22) * curl + i * rng.uniform(0, 4), rng.uniform(2, 30) * curl, rng.uniform(0, 18) * curl)
        _set(pose, finger, flexions, -(1.5 - i) * rng.uniform(-2, 5))
    pose["thumb-phalanx-proximal"] = (rng.uniform(-5, 20), rng.uniform(-10, 10), 0.0)
    pose["thumb-phalanx-distal"] = (rng.uniform(-10, 25), 0.0, 0.0)
    pose["forearm"] = (rng.uniform(-18, 18), rng.uniform(-12, 12), 0.0)
    return pose


def pointing_hand(rng: np.random.Generator, finger: Finger) -> Rotations:
    """A hand with `finger` stretched out and the others tucked in: joint name -> (flexion, abduction, twist) in degrees."""
    pose: dict[str, tuple[float, float, float]] = {}
    tuck = 1.0 if finger is not Finger.THUMB else rng.uniform(0.3, 0.9)
    for i, other in enumerate(_LONG):
        c = rng.uniform(0.75, 1.05) * tuck
        _set(pose, other, (62 * c, 88 * c, 48 * c), (1.5 - i) * 2)
    if finger is Finger.THUMB:
        pose["thumb-metacarpal"] = (rng.uniform(-32, 2), rng.uniform(5, 42), rng.uniform(-42, 5))
        pose["thumb-phalanx-proximal"] = (rng.uniform(-5, 15), 0.0, 0.0)
        pose["thumb-phalanx-distal"] = (rng.uniform(-15, 20), 0.0, 0.0)
    else:
        pose["thumb-metacarpal"] = (rng.uniform(0, 12), 0.0, 0.0)
        pose["thumb-phalanx-proximal"] = (rng.uniform(15, 35), 0.0, 0.0)
        pose["thumb-phalanx-distal"] = (rng.uniform(20, 50), 0.0, 0.0)
        _set(pose, finger, (rng.uniform(5, 38), rng.uniform(4, 30), rng.uniform(-4, 16)), rng.uniform(-6, 6))
    pose["forearm"] = (rng.uniform(-22, 22), rng.uniform(-12, 12), 0.0)
    return pose
