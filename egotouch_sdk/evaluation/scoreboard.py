"""Events against the ground truth of a clip. No I/O, no clock."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import ceil
from statistics import fmean, median
from typing import Any

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.evaluation.truth import ClipTruth, Tip, TrueTouch
from egotouch_sdk.touch_event import EventType, TouchEvent

#: A predicted touch may miss a true one in time by this much and still meet it (our choice, 3 frames at 30 fps).
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
    settings; found are those that the predicted touch which meets the true one gave as well, all others are false.
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
    """One predicted contact, with how often it gave each kind of event."""

    tip: Tip
    start_ns: int
    end_ns: int
    kinds: Counter[EventType]

    def meets(self, touch: TrueTouch) -> bool:
        """True when it is the same fingertip at about the same time."""
        is_near = self.start_ns <= touch.end_ns + MATCH_SLACK_NS and self.end_ns >= touch.start_ns - MATCH_SLACK_NS
        return self.tip == touch.tip and is_near


def score(truth: ClipTruth, events: Sequence[TouchEvent], config: GestureConfig | None = None) -> Scoreboard:
    """Compare all events of one run, in order, with the truth of the clip; both start at time 0. `config` is that of the run."""
    free = _contacts(events)
    pairs: list[tuple[TrueTouch, _Predicted | None]] = []
    for touch in truth.touches:
        match = next((contact for contact in free if contact.meets(touch)), None)
        pairs.append((touch, match))
        if match is not None:
            free.remove(match)
    onset_errors_ms = sorted(abs(match.start_ns - touch.start_ns) / 1e6 for touch, match in pairs if match is not None)
    forces = {(_tip(e), round(e.timestamp_ns * truth.fps / 1e9)): e.force_n for e in events if e.type in (EventType.DOWN, EventType.MOVE)}
    force_errors_n = [abs(truth.force_n[key] - force_n) for key, force_n in forces.items() if key in truth.force_n]
    found = len(onset_errors_ms)
    kinds = [(_kinds(truth.events(touch, config or GestureConfig())), match.kinds if match else Counter()) for touch, match in pairs]
    kinds += [(Counter(), contact.kinds) for contact in free]
    return Scoreboard(
        touches=Count(len(pairs), found, len(pairs) - found, len(free)),
        gestures={name: _count([(true[kind], told[kind]) for true, told in kinds]) for name, kind in GESTURES.items()},
        onset_error_ms_median=median(onset_errors_ms) if onset_errors_ms else None,
        onset_error_ms_p95=onset_errors_ms[ceil(0.95 * found) - 1] if onset_errors_ms else None,
        force_mae_n=fmean(force_errors_n) if force_errors_n else None,
    )


def _count(pairs: Sequence[tuple[int, int]]) -> Count:
    """Sum up how often each contact truly gave an event and how often it was told."""
    true, found = sum(true for true, _ in pairs), sum(min(pair) for pair in pairs)
    return Count(true, found, true - found, sum(told for _, told in pairs) - found)


def _contacts(events: Iterable[TouchEvent]) -> list[_Predicted]:
    contacts: dict[tuple[int, int], _Predicted] = {}
    for event in events:
        key = event.pointer_id, event.contact_id
        if event.type is EventType.DOWN:
            contacts[key] = _Predicted(_tip(event), event.timestamp_ns, event.timestamp_ns, Counter())
        if key in contacts and not event.type.is_hover:
            contacts[key].end_ns = event.timestamp_ns
            contacts[key].kinds[event.type] += 1
    return list(contacts.values())


def _kinds(events: Iterable[TouchEvent]) -> Counter[EventType]:
    return Counter(event.type for event in events)


def _tip(event: TouchEvent) -> Tip:
    return event.hand.value, event.finger.value


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)
