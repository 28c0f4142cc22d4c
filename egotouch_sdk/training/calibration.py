"""Turns held-out logits into honest probabilities and thresholds. Only rendered patches ever come in here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

#: Steps of Newton's method; a two-parameter logistic fit converges in fewer than ten.
NEWTON_STEPS = 25
#: Pulls the fit towards 0, so that perfectly separated classes do not send it to infinity.
RIDGE = 1e-3
#: Share of touches among the frames that pass the gate (125,656 of 307,500; EgoTouch, UIST'24, section 5): thresholds are placed for it.
TOUCH_SHARE = 0.41
#: Thresholds looked at.
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

    `down` is the centre of the probabilities whose accuracy, at the share of touches under the gate, is within half a percent of the best.
    """
    weight = np.where(touch, 0.5 / max(int(touch.sum()), 1), 0.5 / max(int((~touch).sum()), 1))
    scale, shift = _fit_logistic(touch.astype(float), np.asarray(logit, float), weight)
    probability = 1 / (1 + np.exp(-(scale * logit + shift)))
    down, up = place_thresholds(touch, probability)
    return Calibration(scale, shift, down, up)


def place_thresholds(touch: npt.NDArray[np.bool_], probability: npt.NDArray[np.floating]) -> tuple[float, float]:
    """The thresholds (down, up) for calibrated probabilities, by the rule of `calibrate`."""
    found = np.array([(probability[touch] >= t).mean() for t in GRID])
    refused = np.array([(probability[~touch] < t).mean() for t in GRID])
    accuracy = TOUCH_SHARE * found + (1 - TOUCH_SHARE) * refused
    near_best = GRID[accuracy >= accuracy.max() - 0.005]
    down = round(float((near_best[0] + near_best[-1]) / 2), 4)
    up = round(float(1 / (1 + np.exp(-(np.log(down / (1 - down)) - HYSTERESIS_LOGITS)))), 4)
    return down, up


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
