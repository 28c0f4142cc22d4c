"""Events against the ground truth of a clip. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import ceil
from statistics import fmean, median
from typing import Any

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.evaluation.truth import ClipTruth, Tip, TrueTouch
from egotouch_sdk.touch_event import EventType, TouchEvent

#: What is predicted may miss a true touch in time by this much and still belong to it (our choice, 3 frames at 30 fps).
MATCH_SLACK_NS = 100_000_000
#: The gestures that are counted, and the event that stands for each.
GESTURES: Mapping[str, EventType] = {
    "click": EventType.CLICK,
    "long_click": EventType.LONG_CLICK,
    "drag": EventType.DRAG_START,
    "force_press": EventType.FORCE_ENTER,
}


@dataclass(frozen=True, slots=True)
class Count:
    """How often something truly happened, was found, was missed, and was reported without having happened."""

    true: int
    found: int
    missed: int
    false: int


@dataclass(frozen=True, slots=True)
class Scoreboard:
    """How well the touches of a clip were found.

    `touches` counts a true touch as found when a predicted touch of the same fingertip meets it; a second one within it is false.
    `gestures` counts each of `GESTURES`: true ones are what the recogniser makes of the true places and forces with the same
    settings, found ones come within the true touch or up to 100 ms around it.
    `onset_error_ms_median` and `_p95` are of the absolute difference of touch-down times of found touches; `force_mae_n` the mean
    absolute force error over frames in which both truth and prediction touch; None where there is nothing to average.
    """

    touches: Count
    gestures: Mapping[str, Count]
    onset_error_ms_median: float | None
    onset_error_ms_p95: float | None
    force_mae_n: float | None

    def to_dict(self) -> dict[str, Any]:
        """The counts by name, then the errors, rounded to 0.1 ms and 1 mN."""
        return {
            "counts": {name: asdict(count) for name, count in {"touch": self.touches, **self.gestures}.items()},
            "onset_error_ms_median": _rounded(self.onset_error_ms_median, 1),
            "onset_error_ms_p95": _rounded(self.onset_error_ms_p95, 1),
            "force_mae_n": _rounded(self.force_mae_n, 3),
        }


@dataclass(slots=True)
class _Predicted:
    tip: Tip
    start_ns: int
    end_ns: int


def score(truth: ClipTruth, events: Sequence[TouchEvent], config: GestureConfig | None = None) -> Scoreboard:
    """Compare all events of one run, in order, with the truth of the clip; both start at time 0. `config` is that of the run."""
    predicted, forces = _predictions(events, truth.fps)
    free = list(predicted)
    onset_errors_ms: list[float] = []
    for touch in truth.touches:
        match = next((candidate for candidate in free if _meet(touch, candidate)), None)
        if match is not None:
            free.remove(match)
            onset_errors_ms.append(abs(match.start_ns - touch.start_ns) / 1e6)
    force_errors_n = [abs(truth.force_n[key] - force_n) for key, force_n in forces.items() if key in truth.force_n]
    found, total = len(onset_errors_ms), len(truth.touches)
    return Scoreboard(
        touches=Count(total, found, total - found, len(free)),
        gestures={name: _count(truth, events, kind, config or GestureConfig()) for name, kind in GESTURES.items()},
        onset_error_ms_median=median(onset_errors_ms) if onset_errors_ms else None,
        onset_error_ms_p95=sorted(onset_errors_ms)[ceil(0.95 * found) - 1] if onset_errors_ms else None,
        force_mae_n=fmean(force_errors_n) if force_errors_n else None,
    )


def _count(truth: ClipTruth, events: Iterable[TouchEvent], kind: EventType, config: GestureConfig) -> Count:
    free = [event for event in events if event.type is kind]
    true = found = 0
    for touch in truth.touches:
        for true_event in truth.events(touch, config):
            if true_event.type is kind:
                true += 1
                near = [event for event in free if _meet(touch, _Predicted(_tip(event), event.timestamp_ns, event.timestamp_ns))]
                if near:
                    found += 1
                    free.remove(min(near, key=lambda event: abs(event.timestamp_ns - true_event.timestamp_ns)))
    return Count(true, found, true - found, len(free))


def _predictions(events: Iterable[TouchEvent], fps: float) -> tuple[list[_Predicted], dict[tuple[Tip, int], float]]:
    touches: list[_Predicted] = []
    down: dict[int, _Predicted] = {}
    forces: dict[tuple[Tip, int], float] = {}
    for event in events:
        if event.type is EventType.DOWN:
            down[event.pointer_id] = _Predicted(_tip(event), event.timestamp_ns, event.timestamp_ns)
            touches.append(down[event.pointer_id])
        if event.type in (EventType.DOWN, EventType.MOVE):
            forces[_tip(event), round(event.timestamp_ns * fps / 1e9)] = event.force_n
        if event.pointer_id in down:
            down[event.pointer_id].end_ns = event.timestamp_ns
        if event.type in (EventType.UP, EventType.CANCEL):
            down.pop(event.pointer_id, None)
    return touches, forces


def _meet(touch: TrueTouch, predicted: _Predicted) -> bool:
    return (
        touch.tip == predicted.tip
        and predicted.start_ns <= touch.end_ns + MATCH_SLACK_NS
        and predicted.end_ns >= touch.start_ns - MATCH_SLACK_NS
    )


def _tip(event: TouchEvent) -> Tip:
    return event.hand.value, event.finger.value


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)
