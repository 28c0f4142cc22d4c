"""Touch events against the ground truth of a clip. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median
from typing import Any

from egotouch_sdk.errors import SourceError
from egotouch_sdk.touch_event import EventType, TouchEvent

#: A predicted touch may miss a true one in time by this much and still count as the same touch (our choice, 3 frames at 30 fps).
MATCH_SLACK_NS = 100_000_000

Tip = tuple[str, str]


@dataclass(frozen=True, slots=True)
class TrueTouch:
    """One touch of the ground truth: which fingertip (hand, finger), first and last touching frame's time."""

    tip: Tip
    start_ns: int
    end_ns: int


@dataclass(frozen=True, slots=True)
class ClipTruth:
    """Ground truth of a clip: its touches, and the force in newtons of every fingertip that touches, per frame number."""

    fps: float
    touches: tuple[TrueTouch, ...]
    force_n: Mapping[tuple[Tip, int], float]

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> ClipTruth:
        """Read the truth format of the demo clip: `fps`, `frames` (one object per frame) and `touches`.

        Raises `SourceError` naming what is missing.
        """
        try:
            fps = float(data["fps"])
            frames = {int(frame["frame"]): frame for frame in data["frames"]}

            def tip(frame: int) -> Tip:
                return str(frames[frame]["hand"]), str(frames[frame]["finger"])

            def time_ns(frame: int) -> int:
                return round(frame * 1e9 / fps)

            touches = [
                TrueTouch(tip(int(touch["start_frame"])), time_ns(int(touch["start_frame"])), time_ns(int(touch["end_frame"])))
                for touch in data["touches"]
            ]
            force_n = {(tip(index), index): float(frame["force_n"]) for index, frame in frames.items() if frame["touching"]}
        except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
            raise SourceError(f"the ground truth has another form ({error!r})", hint="Compare it with assets/demo_truth.json") from error
        return cls(fps, tuple(sorted(touches, key=lambda touch: touch.start_ns)), force_n)

    def force_at_n(self, frame: int) -> float:
        """The largest true force of any fingertip in a frame, 0 where nothing touches."""
        return max((force_n for (_, touched), force_n in self.force_n.items() if touched == frame), default=0.0)

    def until(self, end_ns: int) -> ClipTruth:
        """The truth of a clip that was left at `end_ns`: touches that began by then."""
        return ClipTruth(self.fps, tuple(touch for touch in self.touches if touch.start_ns <= end_ns), self.force_n)


@dataclass(frozen=True, slots=True)
class Scoreboard:
    """How well the touches of a clip were found.

    `found` true touches met by a predicted touch of the same fingertip, `missed` the others, `false` predicted touches without
    a true one (a second prediction within one true touch counts here). `onset_error_ms_median` is the median absolute
    difference of touch-down times of found touches, `force_mae_n` the mean absolute force error over frames in which both
    truth and prediction touch; None where there is nothing to average.
    """

    touches: int
    found: int
    missed: int
    false: int
    onset_error_ms_median: float | None
    force_mae_n: float | None

    def to_dict(self) -> dict[str, Any]:
        """The fields by name, errors rounded to 0.1 ms and 1 mN."""
        onset, force = self.onset_error_ms_median, self.force_mae_n
        return {
            "touches": self.touches,
            "found": self.found,
            "missed": self.missed,
            "false": self.false,
            "onset_error_ms_median": None if onset is None else round(onset, 1),
            "force_mae_n": None if force is None else round(force, 3),
        }


@dataclass(slots=True)
class _Predicted:
    tip: Tip
    start_ns: int
    end_ns: int


def score(truth: ClipTruth, events: Sequence[TouchEvent]) -> Scoreboard:
    """Compare all events of one run, in order, with the truth of the clip; both start at time 0."""
    predicted, forces = _predictions(events, truth.fps)
    free = list(predicted)
    onset_errors_ms: list[float] = []
    for touch in truth.touches:
        match = next((candidate for candidate in free if _meet(touch, candidate)), None)
        if match is not None:
            free.remove(match)
            onset_errors_ms.append(abs(match.start_ns - touch.start_ns) / 1e6)
    force_errors_n = [abs(truth.force_n[key] - force_n) for key, force_n in forces.items() if key in truth.force_n]
    found = len(onset_errors_ms)
    return Scoreboard(
        touches=len(truth.touches),
        found=found,
        missed=len(truth.touches) - found,
        false=len(free),
        onset_error_ms_median=median(onset_errors_ms) if onset_errors_ms else None,
        force_mae_n=fmean(force_errors_n) if force_errors_n else None,
    )


def _predictions(events: Iterable[TouchEvent], fps: float) -> tuple[list[_Predicted], dict[tuple[Tip, int], float]]:
    touches: list[_Predicted] = []
    down: dict[int, _Predicted] = {}
    forces: dict[tuple[Tip, int], float] = {}
    for event in events:
        tip = (event.hand.value, event.finger.value)
        if event.type is EventType.DOWN:
            down[event.pointer_id] = _Predicted(tip, event.timestamp_ns, event.timestamp_ns)
            touches.append(down[event.pointer_id])
        if event.type in (EventType.DOWN, EventType.MOVE):
            forces[tip, round(event.timestamp_ns * fps / 1e9)] = event.force_n
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
