"""A study's or a data set's figures with their spread over participants, ready to be told. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Any

import numpy as np

from egotouch_sdk.errors import MissingExtraError, SourceError
from egotouch_sdk.evaluation.bayes import BayesFactor, bayes_factor
from egotouch_sdk.evaluation.bootstrap import Interval, interval_of_mean
from egotouch_sdk.evaluation.round_score import RoundScore
from egotouch_sdk.evaluation.study_score import Figures, Group, Spread, by_participant, figures, frame_figures, groups, worst

Curve = tuple[tuple[float, float], ...]
#: Points of a ROC curve that are kept, and bins of reliability and of onset delay (one frame at 30 fps each).
ROC_POINTS, BINS, DELAY_BIN_MS = 101, 10, 1000 / 30


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure: of all rounds pooled, and its spread and interval over participants."""

    pooled: float
    spread: Spread
    interval: Interval


@dataclass(frozen=True, slots=True)
class Condition:
    """One condition: its groups, the weakest, and the Bayes factor of the condition on accuracy."""

    groups: tuple[Group, ...]
    worst: str | None
    bayes: BayesFactor


@dataclass(frozen=True, slots=True)
class Summary:
    """Everything a report tells.

    `counts` are rounds, frames, touches and the like; `frames` rows of accuracy, TPR and FPR (means over participants, with the
    standard deviation of accuracy) by side; `roc` and `reliability` curves in 0..1; `onset_delays` counts by ms, one frame wide.
    """

    counts: Mapping[str, float]
    overall: Mapping[str, Figure]
    frames: Mapping[str, Mapping[str, float]]
    conditions: Mapping[str, Condition]
    participants: Mapping[str, Figures]
    roc: Curve
    reliability: Curve
    onset_delays: Curve

    def to_dict(self) -> dict[str, Any]:
        """For JSON: nested objects, numbers rounded to five digits after the point, None for what could not be measured."""
        conditions = {
            name: {
                "groups": {
                    part.name: {
                        "participants": len(part.accuracies),
                        "rounds": part.rounds,
                        "accuracy_mean": part.accuracy.mean,
                        "accuracy_std": part.accuracy.std,
                        **part.figures,
                    }
                    for part in condition.groups
                },
                "worst": condition.worst,
                "bayes_factor": condition.bayes.factor,
                "bayes_method": condition.bayes.method,
            }
            for name, condition in self.conditions.items()
        }
        overall = {
            name: {
                "pooled": figure.pooled,
                "mean": figure.spread.mean,
                "std": figure.spread.std,
                "low": figure.interval[0],
                "high": figure.interval[1],
                "participants": figure.spread.count,
            }
            for name, figure in self.overall.items()
        }
        content = {"counts": self.counts, "overall": overall, "frames": self.frames, "conditions": conditions}
        curves = {"roc": self.roc, "reliability": self.reliability, "onset_delays": self.onset_delays}
        told: dict[str, Any] = plain({**content, "participants": self.participants, **curves})
        return told


def plain(value: Any) -> Any:
    """A value for JSON: mappings and lists as they are, floats rounded, nan and infinity as None."""
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    if isinstance(value, float):
        return round(value, 5) if isfinite(value) else None
    return value


def summarise(scores: Sequence[RoundScore]) -> Summary:
    """Sum up the scores of rounds; raises `SourceError` when not one frame could be scored.

    Without the extra `[evaluation]` conditions of two values have no Bayes factor, and say so.
    """
    frames = sum(len(score.touch) for score in scores)
    if not frames:
        raise SourceError("not one frame has an open gate", hint="Look at it with `egotouch run VIDEO --show`: are two hands in view?")
    people = by_participant(scores)
    each = {name: figures(part) for name, part in people.items()}
    pooled = figures(scores)
    values = {name: [told[name] for told in each.values()] for name in pooled}
    return Summary(
        counts=_counts(scores, len(people)),
        overall={name: Figure(pooled[name], Spread.of(values[name]), interval_of_mean(values[name])) for name in pooled},
        frames=_frames([frame_figures(part) for part in people.values()]),
        conditions=_conditions(scores),
        participants=each,
        roc=_roc(scores),
        reliability=_reliability(scores),
        onset_delays=_onset_delays(scores),
    )


def _counts(scores: Sequence[RoundScore], people: int) -> dict[str, float]:
    touch = np.concatenate([score.touch for score in scores])
    return {
        "participants": people,
        "rounds": len(scores),
        "frames": len(touch),
        "touching_frames": int(touch.sum()),
        "touches": sum(score.touches for score in scores),
        "unseen_touches": sum(score.unseen for score in scores),
        "minutes": sum(score.seconds for score in scores) / 60,
    }


def _frames(tables: Sequence[Mapping[str, Figures]]) -> dict[str, dict[str, float]]:
    result: dict[str, dict[str, float]] = {}
    for row in tables[0]:
        spreads = {name: Spread.of([table[row][name] for table in tables]) for name in tables[0][row]}
        result[row] = {**{name: spread.mean for name, spread in spreads.items()}, "accuracy_std": spreads["accuracy"].std}
    return result


def _conditions(scores: Sequence[RoundScore]) -> dict[str, Condition]:
    result = {}
    for name in dict.fromkeys(name for score in scores for name in score.conditions):
        parts = groups(scores, name)
        if len(parts) < 2:
            continue
        weakest = worst(parts)
        result[name] = Condition(tuple(parts), None if weakest is None else weakest.name, _bayes(parts))
    return result


def _bayes(parts: Sequence[Group]) -> BayesFactor:
    levels = {part.name: part.accuracies for part in parts}
    try:
        return bayes_factor(levels)
    except MissingExtraError as missing:
        return BayesFactor(nan, missing.hint, 0, len(parts))


def _pooled(scores: Sequence[RoundScore]) -> tuple[np.typing.NDArray[np.bool_], np.typing.NDArray[np.float64]]:
    return np.concatenate([score.touch for score in scores]), np.concatenate([score.probability for score in scores])


def _roc(scores: Sequence[RoundScore]) -> Curve:
    """(FPR, TPR) of the model's own probability at thresholds spread over its quantiles."""
    touch, probability = _pooled(scores)
    if not touch.any() or touch.all():
        return ()
    thresholds = np.quantile(probability, np.linspace(1, 0, ROC_POINTS))
    return ((0.0, 0.0), *((float((probability[~touch] >= t).mean()), float((probability[touch] >= t).mean())) for t in thresholds))


def _reliability(scores: Sequence[RoundScore]) -> Curve:
    """(mean probability, share of touches) per tenth of probability that has frames."""
    touch, probability = _pooled(scores)
    index = np.minimum((probability * BINS).astype(int), BINS - 1)
    return tuple((float(probability[index == b].mean()), float(touch[index == b].mean())) for b in np.unique(index))


def _onset_delays(scores: Sequence[RoundScore]) -> Curve:
    delays = np.concatenate([score.onset_delay_ms for score in scores])
    bins = np.round(delays / DELAY_BIN_MS).astype(int)
    return tuple((float(b * DELAY_BIN_MS), float((bins == b).sum())) for b in range(bins.min(), bins.max() + 1)) if len(bins) else ()
