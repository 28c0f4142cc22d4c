"""Turns held-out logits into honest probabilities and thresholds. Only rendered patches ever come in here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

#: Steps of Newton's method; a two-parameter logistic fit converges in fewer than ten.
NEWTON_STEPS = 25
#: Pulls the fit towards 0, so that perfectly separated classes do not send it to infinity.
RIDGE = 1e-3
#: Share of hovers that may pass for touches where a touch begins: less than the study's goal of 2.6 %, since behind a real hand tracker
#: more of them do (with 2.6 % the rendered demo clip had four false touches, with 2 % none).
FALSE_TOUCH_SHARE = 0.02
#: A touch never begins below or above these probabilities, however well or badly the classes are separated (our choice).
DOWN_RANGE = (0.5, 0.95)
#: A touch ends where its probability falls this far below the threshold that began it, on the logit scale (our choice).
HYSTERESIS_LOGITS = 0.8


@dataclass(frozen=True, slots=True)
class Calibration:
    """`scale * logit + shift` is the calibrated logit; thresholds are probabilities after it."""

    scale: float
    shift: float
    down: float
    up: float

    def to_dict(self) -> dict[str, float]:
        """Scale and shift as a manifest has them."""
        return {"scale": round(self.scale, 4), "shift": round(self.shift, 4)}


def calibrate(touch: npt.NDArray[np.bool_], logit: npt.NDArray[np.floating], hover: npt.NDArray[np.bool_]) -> Calibration:
    """Fit scale and shift (Platt) with both classes weighing the same, then place the thresholds; all arrays (N,).

    `down` is the probability that `FALSE_TOUCH_SHARE` of the frames marked in `hover` reach.
    """
    weight = np.where(touch, 0.5 / max(int(touch.sum()), 1), 0.5 / max(int((~touch).sum()), 1))
    scale, shift = _fit_logistic(touch.astype(float), np.asarray(logit, float), weight)
    probability = 1 / (1 + np.exp(-(scale * logit + shift)))
    down, up = place_thresholds(probability[hover])
    return Calibration(scale, shift, down, up)


def place_thresholds(hovering: npt.NDArray[np.floating]) -> tuple[float, float]:
    """The thresholds (down, up) from calibrated probabilities (N,) of hovers, by the rule of `calibrate`."""
    down = round(float(np.clip(np.quantile(hovering, 1 - FALSE_TOUCH_SHARE), *DOWN_RANGE)), 4)
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
