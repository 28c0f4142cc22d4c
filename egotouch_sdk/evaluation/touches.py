"""Touches as runs of frames: which were met, how often, and when they began and ended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.evaluation.alignment import runs
from egotouch_sdk.evaluation.confusion import Bools, Matches

Floats = npt.NDArray[np.floating]
Run = tuple[int, int]
#: Frames by which an onset or offset may be off: 0, 33, 67 and 133 ms at 30 fps (the E2E-Spot convention, as in HiCE).
TOLERANCES = (0, 1, 2, 4)
#: Of rises of the touch probability closer than this only the steepest is an onset (our choice: the reach of the 3-frame median).
SUPPRESSION_FRAMES = 2


@dataclass(frozen=True, slots=True)
class Meeting:
    """A true touch, and the told touches that share at least one frame with it; runs are (first frame, first frame after)."""

    true: Run
    told: tuple[Run, ...]
    is_click: bool


def meetings(touch: Bools, told: Bools, gate: Bools) -> tuple[list[Meeting], list[Run]]:
    """Every true touch that was to be seen in at least one frame, with what met it; then the told touches that met none.

    A click is a true touch met by exactly one told touch that meets no other true touch: two touches told as one are no click.
    """
    seen = [run for run in runs(touch) if gate[slice(*run)].any()]
    claims = runs(told)
    met = [tuple(claim for claim in claims if claim[0] < run[1] and run[0] < claim[1]) for run in seen]
    shared = [claim for claim in claims if sum(claim in claimed for claimed in met) > 1]
    pairs = [Meeting(run, claimed, len(claimed) == 1 and claimed[0] not in shared) for run, claimed in zip(seen, met, strict=True)]
    return pairs, [claim for claim in claims if not touch[slice(*claim)].any()]


def match_times(true: Sequence[int], told: Sequence[int], tolerance: int) -> Matches:
    """Match frame numbers one to one, at most `tolerance` apart, the earliest with the earliest; both rise."""
    found = i = j = 0
    while i < len(true) and j < len(told):
        if abs(told[j] - true[i]) <= tolerance:
            found, i, j = found + 1, i + 1, j + 1
        elif told[j] < true[i]:
            j += 1
        else:
            i += 1
    return Matches(found, len(true) - found, len(told) - found)


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """Onsets that the model proposes: how sure it is (N,), and for each tolerance whether a true onset was won (N,)."""

    score: npt.NDArray[np.float64]
    hit: Mapping[int, Bools]
    true_onsets: int

    @staticmethod
    def join(parts: Sequence[Candidates]) -> Candidates:
        """The candidates of all rounds."""
        return Candidates(
            np.concatenate([part.score for part in parts]),
            {tolerance: np.concatenate([part.hit[tolerance] for part in parts]) for tolerance in TOLERANCES},
            sum(part.true_onsets for part in parts),
        )

    def average_precision(self, tolerance: int) -> float:
        """Area under precision over recall, candidates of one score taken together; nan without true onsets."""
        return average_precision(self.hit[tolerance], self.score, self.true_onsets)


def candidates(onsets: Sequence[int], probability: Floats, ignored: Sequence[int] = ()) -> Candidates:
    """Propose an onset wherever the touch probability (T,) rises most within 2 frames; nan where nothing was to be seen.

    The surest candidate takes the nearest true onset within the tolerance that is still free; none is won twice. Candidates within
    4 frames of an `ignored` onset, one that cannot be judged, are dropped.
    """
    before = np.concatenate([[0.0], np.where(np.isnan(probability[:-1]), 0.0, probability[:-1])])
    rise = np.where(np.isnan(probability), 0.0, probability - before)
    order = [int(frame) for frame in np.argsort(-rise, kind="stable") if rise[frame] > 0]
    kept: list[int] = []
    for frame in order:
        if all(abs(frame - other) > SUPPRESSION_FRAMES for other in kept):
            kept.append(frame)
    kept = [frame for frame in kept if all(abs(frame - other) > TOLERANCES[-1] for other in ignored)]
    hit = {tolerance: _won(onsets, kept, tolerance) for tolerance in TOLERANCES}
    return Candidates(np.array([rise[frame] for frame in kept], np.float64), hit, len(onsets))


def _won(onsets: Sequence[int], proposed: Sequence[int], tolerance: int) -> Bools:
    free, won = set(onsets), []
    for frame in proposed:
        near = min(
            (onset for onset in free if abs(onset - frame) <= tolerance), key=lambda onset: (abs(onset - frame), onset), default=None
        )
        won.append(near is not None)
        free.discard(-1 if near is None else near)
    return np.array(won, bool)


def average_precision(hit: Bools, score: Floats, positives: int) -> float:
    """Area under precision over recall, 0..1: the sum of precision times gain in recall, equal scores taken together.

    `hit` (N,) says which of the answers with `score` (N,) are right, `positives` how many right answers there are; nan for none.
    """
    if not positives:
        return float("nan")
    order = np.argsort(-score, kind="stable")
    ends = np.flatnonzero(np.append(np.diff(score[order]) != 0, True)) if len(order) else np.array([], int)
    right = np.cumsum(hit[order])[ends]
    gains = np.diff(np.concatenate([[0], right])) / positives
    return float(np.sum(gains * right / (ends + 1)))
