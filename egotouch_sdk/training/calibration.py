"""Turns held-out logits into honest probabilities and thresholds. Only rendered patches ever come in here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

#: Steps of Newton's method; a two-parameter logistic fit converges in fewer than ten.
NEWTON_STEPS = 25
#: Pulls the fit towards 0, so that perfectly separated classes do not send it to infinity.
RIDGE = 1e-3
#: Thresholds looked at for the balanced-accuracy optimum.
GRID = np.linspace(0.05, 0.95, 181)
#: A touch ends where its probability falls this far below the threshold that began it, on the logit scale (our choice).
HYSTERESIS_LOGITS = 0.8


@dataclass(frozen=True, slots=True)
class Calibration:
    """`scale * logit + shift` is the calibrated logit; thresholds are probabilities after it."""

    scale: float
    shift: float
    down: float
    up: float


def calibrate(touch: npt.NDArray[np.bool_], logit: npt.NDArray[np.floating]) -> Calibration:
    """Fit scale and shift (Platt) with both classes weighing the same, then place the thresholds.

    `down` is the centre of the probabilities whose balanced accuracy is within half a percent of the best.
    """
    weight = np.where(touch, 0.5 / max(int(touch.sum()), 1), 0.5 / max(int((~touch).sum()), 1))
    scale, shift = _fit_logistic(touch.astype(float), np.asarray(logit, float), weight)
    probability = 1 / (1 + np.exp(-(scale * logit + shift)))
    balanced = np.array([0.5 * ((probability[touch] >= t).mean() + (probability[~touch] < t).mean()) for t in GRID])
    near_best = GRID[balanced >= balanced.max() - 0.005]
    down = float((near_best[0] + near_best[-1]) / 2)
    up = float(1 / (1 + np.exp(-(np.log(down / (1 - down)) - HYSTERESIS_LOGITS))))
    return Calibration(scale, shift, down, up)


def _fit_logistic(target: npt.NDArray[np.float64], logit: npt.NDArray[np.float64], weight: npt.NDArray[np.float64]) -> tuple[float, float]:
    spread = max(float(logit.std()), 1e-6)
    features = np.stack([logit / spread, np.ones_like(logit)], 1)
    solution = np.zeros(2)
    for _ in range(NEWTON_STEPS):
        probability = 1 / (1 + np.exp(-np.clip(features @ solution, -30, 30)))
        gradient = features.T @ (weight * (probability - target)) + RIDGE * solution
        hessian = (features * (weight * probability * (1 - probability))[:, None]).T @ features + RIDGE * np.eye(2)
        solution = solution - np.linalg.solve(hessian, gradient)
    return float(solution[0] / spread), float(solution[1])
