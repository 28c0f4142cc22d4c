"""Whatever a finger does and a model says: counts add up, and no figure leaves its range."""

from __future__ import annotations

from math import isnan

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.config import StateConfig
from egotouch_sdk.evaluation.round_score import SHIFTS, SIDES, RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import follow
from egotouch_sdk.evaluation.study_score import figures, frame_figures
from egotouch_sdk.evaluation.summary import summarise
from egotouch_sdk.evaluation.touches import TOLERANCES
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate
from egotouch_sdk.state import Thresholds
from tests.support.study import study_round

DOWN = 0.6
frames = st.lists(st.tuples(st.sampled_from("..##x"), st.floats(0, 1), st.floats(0, 3.5)), min_size=1, max_size=50)


def scored(told: list[tuple[str, float, float]], participant: int = 0) -> RoundScore:
    study = study_round("".join(letter for letter, _, _ in told), participant=participant)
    estimates = {n: TouchEstimate(1, Finger.INDEX, p, force_n) for n, (_, p, force_n) in enumerate(told) if study.gate[n]}
    answers = follow(study.timestamp_ns.tolist(), estimates, Thresholds(DOWN, 0.4), StateConfig())
    return score_round(Truth.of(study), answers, DOWN)


@given(frames)
@settings(max_examples=150)
def test_counts_add_up(told: list[tuple[str, float, float]]) -> None:
    score = scored(told)
    letters = [letter for letter, _, _ in told]
    shown, touching = sum(letter != "x" for letter in letters), letters.count("#")
    for side in SIDES:
        counts = score.frames[side, 0]
        assert (counts.total, counts.tp + counts.fn) == (shown, touching)
        assert score.aligned[side].total >= shown and score.aligned[side].tp + score.aligned[side].fn >= touching
        assert score.aligned[side].fn + score.aligned[side].fp <= counts.fn + counts.fp
    assert score.touches + score.unseen + score.cut == sum(a == "#" != b for a, b in zip(letters, [".", *letters], strict=False))
    assert score.clicks >= len(score.onset_delay_ms) and score.clicks <= score.touches == len(score.peaks_n)
    for shift in SHIFTS:
        onsets = [score.onsets[tolerance, shift] for tolerance in TOLERANCES]
        found, true = [matches.found for matches in onsets], {matches.found + matches.missed for matches in onsets}
        assert found == sorted(found) and len(true) == 1 and true <= {score.touches, score.touches - (letters[0] == "#")}
    for tolerance in TOLERANCES:
        assert score.candidates.hit[tolerance].sum() <= score.candidates.true_onsets <= score.touches


@given(st.lists(frames, min_size=1, max_size=3))
@settings(max_examples=40)
def test_no_figure_leaves_its_range(rounds: list[list[tuple[str, float, float]]]) -> None:
    scores = [scored(told, number) for number, told in enumerate(rounds)]
    told = figures(scores)
    shares = [name for name in told if not any(word in name for word in ("delay", "jitter", "force", "per_", "spearman"))]
    assert all(isnan(told[name]) or 0 <= told[name] <= 1 for name in shares) and len(shares) > 30
    for row in frame_figures(scores).values():
        assert all(isnan(value) or 0 <= value <= 1 for value in row.values())
    if any(len(score.touch) for score in scores):
        summary = summarise(scores)
        assert summary.counts["frames"] == sum(len(score.touch) for score in scores)


@given(frames)
@settings(max_examples=50)
def test_a_model_that_says_the_truth_is_never_wrong(told: list[tuple[str, float, float]]) -> None:
    score = scored([(letter, float(letter == "#"), 1.5 * (letter == "#")) for letter, _, _ in told])
    assert score.frames["raw", 0].fn == score.frames["raw", 0].fp == 0
    assert np.array_equal(score.probability >= DOWN, score.touch)
