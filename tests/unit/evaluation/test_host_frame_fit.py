"""A fit finds what landmarks mean where they mean something, and is scored on people it has not seen."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError, ModelError
from egotouch_sdk.evaluation.host_frame import HostCase, errors_of, format_report, host_report
from egotouch_sdk.evaluation.host_frame_fit import FOLDS, fit_tracker, fits_of_others, to_dict
from egotouch_sdk.host_frame.features import see
from egotouch_sdk.host_frame.linear_map import LinearMap
from egotouch_sdk.host_frame.locate import PALM_MM, TrackerFit, surface_under, tracker_fit
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HostPoint, TouchPair
from egotouch_sdk.surface import Surface
from tests.support.hands import host_hand, pointing_hand


def case(rng: np.random.Generator, participant: int, *, palm_up: bool, forearm: bool) -> HostCase:
    """A touch whose true place is 5 mm to the thumb side of where it is seen, at a pitch that its place tells."""
    host = host_hand(palm_up=palm_up, tilt_deg=float(rng.uniform(-30, 30)))
    wrist = host.xy_px(0)
    x, y = float(wrist[0] + rng.uniform(-50, 50)), float(wrist[1] + (rng.uniform(30, 200) if forearm else rng.uniform(-140, -30)))
    pair = TouchPair(pointing_hand((x, y), pointing_deg=float(rng.uniform(90, 180))), host, 0.0, (Finger.INDEX,))
    seen = see(pair, Finger.INDEX)
    assert seen is not None
    x_mm, y_mm = seen.tip[0] * PALM_MM + 5.0, seen.tip[1] * PALM_MM
    surface = surface_under(seen, shows_palm=palm_up)
    return HostCase(pair, Finger.INDEX, HostPoint(surface, x_mm, y_mm, 0.7 + 0.2 * seen.tip[0], seen.yaw_rad), 83.0, participant)


@pytest.fixture(scope="module")
def cases() -> list[HostCase]:
    rng = np.random.default_rng(1)
    kinds = [(palm_up, forearm) for palm_up in (True, False) for forearm in (True, False)]
    return [case(rng, index % 16, palm_up=palm_up, forearm=forearm) for index in range(80) for palm_up, forearm in kinds]


def test_people_left_out_are_located_by_what_the_others_show(cases: list[HostCase]) -> None:
    report = host_report(cases, fits_of_others(cases))
    assert report["all"]["cases"] == 320
    assert report["all"]["nominal_mm_median"] < 1.0
    assert report["all"]["pitch_deg_median"] < 1.0
    assert report["all"]["surface_accuracy"] == 1.0
    assert "all" in format_report(report)


def test_nobody_is_scored_by_a_fit_to_himself(cases: list[HostCase]) -> None:
    liar = [replace(one, truth=replace(one.truth, x_mm=one.truth.x_mm + 50)) if one.participant % FOLDS == 0 else one for one in cases]
    fit_for = fits_of_others(liar)
    errors = [errors_of(one, fit_for(one)) for one in liar if one.participant % FOLDS == 0]
    assert min(error.nominal_mm for error in errors if error) > 40.0


def test_a_fit_survives_its_file(cases: list[HostCase]) -> None:
    fit = fit_tracker(cases)
    data = json.loads(json.dumps(to_dict(fit)))
    position = {Surface(name): LinearMap.from_dict(one) for name, one in data["position"].items()}
    again = TrackerFit(position, LinearMap.from_dict(data["angle"]))
    for one in cases[:8]:
        first, second = errors_of(one, fit), errors_of(one, again)
        assert first is not None
        assert second is not None
        assert first.nominal_mm == pytest.approx(second.nominal_mm, abs=0.01)


def test_a_surface_without_cases_is_named(cases: list[HostCase]) -> None:
    with pytest.raises(ConfigError, match="outer_forearm"):
        fit_tracker([one for one in cases if one.truth.surface is not Surface.OUTER_FOREARM])


def test_the_shipped_fit_knows_every_surface() -> None:
    assert set(tracker_fit().position) == set(Surface)


def test_weights_that_do_not_fit_together_are_refused() -> None:
    with pytest.raises(ModelError, match="fit together"):
        LinearMap((0.0,), (1.0,), ((1.0, 2.0),), (0.0,))


def test_features_far_from_all_that_was_fitted_are_held_back() -> None:
    one = LinearMap((0.0,), (2.0,), ((1.0,),), (10.0,))
    assert one([1e9]) == one([6.0]) == (13.0,)
