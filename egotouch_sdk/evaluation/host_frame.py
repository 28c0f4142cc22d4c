"""How far `locate` is from the exact answer: position in mm, pitch and yaw in degrees, the surface's name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import degrees, hypot, nan, pi
from typing import Any

import numpy as np

from egotouch_sdk.config import GateConfig, HostConfig
from egotouch_sdk.frame import Frame
from egotouch_sdk.gate import find_pairs
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.host_frame.locate import TrackerFit, locate
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HostPoint, TouchPair

Report = dict[str, dict[str, float]]

#: Frames of one still that the tracker gets, so that it follows the hands as it does in a video instead of only finding them.
_SETTLE_FRAMES = 3
_FRAME_NS = 33_333_333


@dataclass(frozen=True, slots=True)
class HostCase:
    """A pair of hands as seen, the finger that touches, the exact answer, the wearer's own palm length and number."""

    pair: TouchPair
    finger: Finger
    truth: HostPoint
    palm_mm: float
    participant: int = -1


@dataclass(frozen=True, slots=True)
class HostErrors:
    """Errors of one case: `nominal_mm` with the usual palm length, `fitted_mm` with the wearer's own; angles signed, in degrees."""

    nominal_mm: float
    fitted_mm: float
    pitch_deg: float
    yaw_deg: float
    right_surface: bool


def errors_of(case: HostCase, fit: TrackerFit | None = None) -> HostErrors | None:
    """What `locate` makes of a case with the shipped or another fit; None when it finds no host point."""
    nominal = locate(case.pair, case.finger, fit=fit)
    fitted = locate(case.pair, case.finger, HostConfig(palm_mm=case.palm_mm), fit=fit)
    if nominal is None or fitted is None:
        return None
    truth = case.truth
    return HostErrors(
        hypot(nominal.x_mm - truth.x_mm, nominal.y_mm - truth.y_mm),
        hypot(fitted.x_mm - truth.x_mm, fitted.y_mm - truth.y_mm),
        degrees(nominal.pitch_rad - truth.pitch_rad),
        degrees((nominal.yaw_rad - truth.yaw_rad + pi) % (2 * pi) - pi),
        nominal.surface is truth.surface,
    )


def host_report(cases: Iterable[HostCase], fit_for: Callable[[HostCase], TrackerFit | None] = lambda _: None) -> Report:
    """Median and 95th percentile of every error, per true surface and for "all"; `fit_for` a case gives None for the shipped fit."""
    found: dict[str, list[HostErrors]] = {}
    cases_n: dict[str, int] = {}
    for case in cases:
        errors = errors_of(case, fit_for(case))
        for name in (str(case.truth.surface), "all"):
            cases_n[name] = cases_n.get(name, 0) + 1
            found.setdefault(name, []).extend([] if errors is None else [errors])
    order = [*sorted(name for name in cases_n if name != "all"), *(["all"] if cases_n else [])]
    return {name: _row(found[name], cases_n[name]) for name in order}


def _row(errors: Sequence[HostErrors], cases_n: int) -> dict[str, float]:
    row: dict[str, Any] = {"cases": cases_n, "located": len(errors)}
    for name in ("nominal_mm", "fitted_mm", "pitch_deg", "yaw_deg"):
        sizes = [abs(getattr(error, name)) for error in errors] or [nan]
        row[f"{name}_median"], row[f"{name}_p95"] = (round(float(np.percentile(sizes, q)), 2) for q in (50, 95))
    row["surface_accuracy"] = round(float(np.mean([float(error.right_surface) for error in errors] or [nan])), 4)
    return row


def seen_pair(tracker: HandSource, image: Any) -> TouchPair | None:
    """What the tracker and the gate make of a still BGR picture of a right hand touching a left limb; None when they miss it."""
    tracker.reset()
    for index in range(_SETTLE_FRAMES):
        hands = tracker.track(Frame(image, index * _FRAME_NS, index))
    pairs = find_pairs(hands, GateConfig()).pairs
    return next((pair for pair in pairs if pair.touching.handedness is Handedness.RIGHT), None)


def format_report(report: Report) -> str:
    """The report as a table: median and p95 of each error."""
    head = f"{'':<15}{'cases':>6}{'located':>8}{'position mm':>15}{'own palm mm':>15}{'pitch deg':>14}{'yaw deg':>14}{'surface':>9}"
    lines = [head]
    for name, row in report.items():
        cells = "".join(
            f"{row[f'{key}_median']:>{width - 8}.1f} /{row[f'{key}_p95']:>6.1f}"
            for key, width in (("nominal_mm", 15), ("fitted_mm", 15), ("pitch_deg", 14), ("yaw_deg", 14))
        )
        lines.append(f"{name:<15}{row['cases']:>6.0f}{row['located']:>8.0f}{cells}{row['surface_accuracy']:>9.1%}")
    return "\n".join(lines)
