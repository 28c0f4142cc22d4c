"""Fits what the tracker's landmarks mean for the host frame, and scores such a fit on people it was not made from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.evaluation.host_frame import HostCase
from egotouch_sdk.host_frame.features import SeenTip, see
from egotouch_sdk.host_frame.linear_map import MAX_DEVIATION, LinearMap
from egotouch_sdk.host_frame.locate import PALM_MM, TrackerFit, wrapped
from egotouch_sdk.surface import Surface

Floats = npt.NDArray[np.float64]

#: Ridge penalties, in standardised features (chosen from 1, 5, 20 and 60 by people left out, beside a few others; they matter little).
POSITION_RIDGE, ANGLE_RIDGE = 5.0, 20.0
#: People are left out in so many groups.
FOLDS = 4
#: A case whose yaw is farther than this from the direction as seen has its finger mistaken by the tracker; it counts as this far.
_MAX_TURN_RAD = 1.0


def fit_tracker(cases: Sequence[HostCase]) -> TrackerFit:
    """Ridge regressions: a place for each surface, the angles for all of them together. Raises `ConfigError` without cases of a surface."""
    seen = [(case, tip) for case in cases if (tip := see(case.pair, case.finger)) is not None]
    position = {}
    for surface in Surface:
        here = [(case, tip) for case, tip in seen if case.truth.surface is surface]
        if not here:
            raise ConfigError(f"no still shows a touch on the {surface}", hint="Render more of them with --render N")
        targets = np.array([[case.truth.x_mm, case.truth.y_mm] for case, _ in here]) / PALM_MM
        position[surface] = _ridge(np.array([tip.position for _, tip in here]), targets, POSITION_RIDGE)
    angles = _ridge(np.array([tip.angle for _, tip in seen]), np.array([_angles(case, tip) for case, tip in seen]), ANGLE_RIDGE)
    return TrackerFit(position, angles)


def fits_of_others(cases: Sequence[HostCase]) -> Callable[[HostCase], TrackerFit]:
    """For each case a fit to the other people; people are in `FOLDS` groups by their number."""
    fits = [fit_tracker([case for case in cases if case.participant % FOLDS != fold]) for fold in range(FOLDS)]
    return lambda case: fits[case.participant % FOLDS]


def to_dict(fit: TrackerFit) -> dict[str, Any]:
    """The form of `tracker_fit.json`, numbers to six digits."""
    return {"position": {surface.value: _map_to_dict(one) for surface, one in fit.position.items()}, "angle": _map_to_dict(fit.angle)}


def _map_to_dict(one: LinearMap) -> dict[str, Any]:
    def short(values: Sequence[float]) -> list[float]:
        return [float(f"{value:.6g}") for value in values]

    return {"mean": short(one.mean), "spread": short(one.spread), "weights": [short(row) for row in one.weights], "bias": short(one.bias)}


def _angles(case: HostCase, tip: SeenTip) -> tuple[float, float]:
    turn = wrapped(case.truth.yaw_rad - tip.yaw_rad)
    return case.truth.pitch_rad, min(max(turn, -_MAX_TURN_RAD), _MAX_TURN_RAD)


def _ridge(features: Floats, targets: Floats, penalty: float) -> LinearMap:
    mean, spread = features.mean(0), features.std(0)
    spread[spread < 1e-6] = 1.0
    deviations = np.clip((features - mean) / spread, -MAX_DEVIATION, MAX_DEVIATION)
    bias = targets.mean(0)
    square = deviations.T @ deviations + penalty * np.eye(deviations.shape[1])
    weights = np.linalg.solve(square, deviations.T @ (targets - bias))
    bias = bias - deviations.mean(0) @ weights
    return LinearMap(tuple(mean.tolist()), tuple(spread.tolist()), tuple(map(tuple, weights.T.tolist())), tuple(bias.tolist()))
