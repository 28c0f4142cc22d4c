"""How a worn camera moves against the touched limb: slow sway, breathing, and the bounce of steps."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.linalg import Array

#: Steps per second and the height a head bounces relative to the hands held in front of it (our choice; heads bob 20 to 40 mm and hands
#: go along in part), with a half as strong harmonic; standing still, a head sways and breathing lifts the forearm by about a millimetre.
_STEP_HZ, _BOUNCE_MM = (1.7, 2.2), (3.0, 8.0)
_BREATH_HZ, _BREATH_MM = (0.2, 0.35), (0.4, 1.2)
_SWAY_HZ, _SWAY_MM, _SWAYS = (0.2, 1.2), (0.2, 1.2), 4


class HeadMotion:
    """Place of the touched limb in the camera's image plane over time, from one random state; smooth, zero mean."""

    def __init__(self, rng: np.random.Generator, walking: bool) -> None:
        hz = rng.uniform(*_SWAY_HZ, (_SWAYS, 2))
        size = rng.uniform(*_SWAY_MM, (_SWAYS, 2))
        breath_hz, breath_mm = rng.uniform(*_BREATH_HZ), rng.uniform(*_BREATH_MM)
        step_hz, bounce_mm = rng.uniform(*_STEP_HZ), rng.uniform(*_BOUNCE_MM) * walking
        rolls_hz, rolls_mm = step_hz / 2, 0.6 * bounce_mm
        extra_hz = [[breath_hz, breath_hz], [rolls_hz, step_hz], [step_hz, 2 * step_hz]]
        extra_mm = [[0.3 * breath_mm, breath_mm], [rolls_mm, bounce_mm], [0.2 * bounce_mm, 0.5 * bounce_mm]]
        self._hz, self._mm = np.vstack([hz, extra_hz]), np.vstack([size, extra_mm])
        self._phase = rng.uniform(0, 2 * np.pi, self._hz.shape)

    def at(self, time_s: npt.ArrayLike) -> Array:
        """Offset (T, 2) in millimetres (right, up) at times (T,)."""
        t = np.atleast_1d(np.asarray(time_s, np.float64))
        return np.asarray((self._mm * np.sin(2 * np.pi * self._hz * t[:, None, None] + self._phase)).sum(1), np.float64)
