"""What one round adds to a study's scores: counts and samples that can be pooled. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.evaluation.alignment import RADIUS, aligned_confusion, runs
from egotouch_sdk.evaluation.confusion import Bools, Confusion, Matches
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import Answers
from egotouch_sdk.evaluation.touches import TOLERANCES, Candidates, Run, candidates, match_times, meetings

#: Sides that are scored: the model's own frames, behind the median, and between DOWN and UP of the state machine.
SIDES = ("raw", "median", "live")
#: Frames by which the truth is moved to later before scoring: as it is, and by one as in the paper, which takes out the median's delay.
SHIFTS = (0, 1)
#: A press of at least this much is hard (EgoTouch, UIST'24).
HARD_N = 1.0

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class RoundScore:
    """Scores of one round; every frame with a closed gate is left out of what is counted in frames.

    `participant`, `name`, `conditions`, `is_hover` and `is_drag` are those of its `Truth`. `frames` by (side, shift); `aligned` by
    side; `onsets`, `offsets` (matched events of the state machine) by (tolerance, shift).
    `touch`, `probability`, `median_probability`, `live`, `true_n`, `told_n`, `hover_mm` are (N,) over the open frames; `told_n` is
    the median's force. `onset_delay_ms` and `offset_delay_ms` (K,) are told minus true, of clicks; `peaks_n` (M, 2) are the true and
    told peak force of every true touch that was seen. `extra` counts told touches beyond the first that meet the same true touch,
    `false_touches` those that meet none, `merged` true touches that share their told touch with another.
    `unseen` true touches had a closed gate throughout, `cut` ones began in the last 4 frames, too late to be told; both count in no
    other number of touches. Nor do onsets of touches that go on from before the round, and offsets in its last 4 frames.
    `contact_s` is the time of true touches seen, `seconds` that of open frames.
    """

    participant: str
    name: str
    conditions: Mapping[str, str]
    is_hover: bool
    is_drag: bool
    frames: Mapping[tuple[str, int], Confusion]
    aligned: Mapping[str, Confusion]
    touches: int
    clicks: int
    extra: int
    merged: int
    false_touches: int
    unseen: int
    cut: int
    contact_s: float
    seconds: float
    onsets: Mapping[tuple[int, int], Matches]
    offsets: Mapping[tuple[int, int], Matches]
    candidates: Candidates
    onset_delay_ms: Floats
    offset_delay_ms: Floats
    peaks_n: Floats
    touch: Bools
    probability: Floats
    median_probability: Floats
    live: Bools
    true_n: Floats
    told_n: Floats
    hover_mm: Floats


def score_round(truth: Truth, answers: Answers, down_probability: float) -> RoundScore:
    """Compare what was told with the truth; `down_probability` is where the raw and the median side call a touch."""
    touch, gate, times_ns = truth.touch, truth.gate, truth.timestamp_ns
    called = {
        "raw": np.nan_to_num(answers.probability) >= down_probability,
        "median": np.nan_to_num(answers.median_probability) >= down_probability,
        "live": answers.live,
    }
    late = len(touch) - RADIUS
    cut = [run for run in runs(touch) if run[0] > late and gate[slice(*run)].any()]
    all_pairs, false = meetings(touch, answers.live, gate)
    pairs = [pair for pair in all_pairs if pair.true not in cut]
    clicks = [(pair.true, pair.told[0]) for pair in pairs if pair.is_click]
    seen, told = [pair.true for pair in pairs], runs(answers.live)
    begun, ended = [run for run in seen if run[0] > 0], [run for run in seen if run[1] <= late]
    told_begun, told_ended = _answering(told, begun, [*cut, *seen]), _answering(told, ended, [*cut, *seen])
    frame_s = 1 / truth.fps
    return RoundScore(
        participant=truth.participant,
        name=truth.name,
        conditions=truth.conditions,
        is_hover=truth.is_hover,
        is_drag=truth.is_drag,
        frames={(side, shift): _shifted(touch, called[side], gate, shift) for side in SIDES for shift in SHIFTS},
        aligned={side: aligned_confusion(touch, called[side], gate) for side in SIDES},
        touches=len(pairs),
        clicks=len(clicks),
        extra=sum(max(len(pair.told) - 1, 0) for pair in pairs),
        merged=sum(len(pair.told) == 1 and not pair.is_click for pair in pairs),
        false_touches=len(false),
        unseen=len(runs(touch)) - len(all_pairs),
        cut=len(cut),
        contact_s=frame_s * sum(stop - start for start, stop in seen),
        seconds=frame_s * int(gate.sum()),
        onsets=_matches([run[0] for run in begun], [run[0] for run in told_begun]),
        offsets=_matches([run[1] for run in ended], [run[1] for run in told_ended]),
        candidates=candidates([run[0] for run in begun], answers.median_probability, [run[0] for run in [*cut, *seen] if run not in begun]),
        onset_delay_ms=np.array([(times_ns[b[0]] - times_ns[a[0]]) / 1e6 for a, b in clicks if a in begun], np.float64),
        offset_delay_ms=np.array(
            [(times_ns[b[1]] - times_ns[a[1]]) / 1e6 for a, b in clicks if a in ended and b[1] < len(touch)], np.float64
        ),
        peaks_n=_peaks(truth, answers, seen),
        touch=touch[gate],
        probability=answers.probability[gate],
        median_probability=answers.median_probability[gate],
        live=answers.live[gate],
        true_n=truth.force_n[gate].astype(np.float64),
        told_n=answers.median_force_n[gate],
        hover_mm=truth.hover_mm[gate].astype(np.float64),
    )


def _shifted(touch: Bools, called: Bools, gate: Bools, shift: int) -> Confusion:
    """Calls against the truth of `shift` frames before; frames that have none are left out."""
    open_frames = gate[shift:]
    return Confusion.of(touch[: len(touch) - shift][open_frames], called[shift:][open_frames])


def _matches(true: Sequence[int], told: Sequence[int]) -> dict[tuple[int, int], Matches]:
    moved = {shift: [frame + shift for frame in true] for shift in SHIFTS}
    return {(tolerance, shift): match_times(moved[shift], told, tolerance) for tolerance in TOLERANCES for shift in SHIFTS}


def _answering(told: Sequence[Run], kept: Sequence[Run], true: Sequence[Run]) -> list[Run]:
    """Told touches without those that meet true ones, but none of those whose edge is `kept`."""

    def meets(run: Run, others: Sequence[Run]) -> bool:
        return any(run[0] < other[1] and other[0] < run[1] for other in others)

    return [run for run in told if meets(run, kept) or not meets(run, true)]


def _peaks(truth: Truth, answers: Answers, seen: Sequence[tuple[int, int]]) -> Floats:
    """Largest true and told force within each true touch, the told one up to one frame later: the median's delay."""
    rows = []
    for start, stop in seen:
        told = answers.median_force_n[start : stop + 1]
        rows.append((float(truth.force_n[start:stop].max()), float(np.nanmax(told))))
    return np.array(rows, np.float64).reshape(-1, 2)
