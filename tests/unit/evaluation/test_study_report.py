from __future__ import annotations

import json
from math import isnan, nan

import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation import wording
from egotouch_sdk.evaluation.document import to_html, to_markdown
from egotouch_sdk.evaluation.round_score import RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_report import Heading, build_report
from egotouch_sdk.evaluation.study_run import answer
from egotouch_sdk.evaluation.study_score import figures
from egotouch_sdk.evaluation.summary import Summary, plain, summarise
from egotouch_sdk.study_data import TouchType
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch import TouchModel
from tests.support.study import signal_model, study_round

GOOD = "....########....######...."
MISSED = "....########.............."


@pytest.fixture(scope="module")
def scores(tmp_path_factory: pytest.TempPathFactory) -> list[RoundScore]:
    model = TouchModel(signal_model(tmp_path_factory.mktemp("model")))
    rounds = []
    for participant in range(4):
        for number, place in enumerate(Surface):
            told = MISSED if (participant, place) == (3, Surface.OUTER_FOREARM) else None
            kind = [TouchType.TAP, TouchType.HARD_PRESS][number % 2]
            study = study_round(
                GOOD, told, participant=participant, round=number, place=place, touch_type=kind, fitzpatrick=2 + participant // 2
            )
            rounds.append(score_round(Truth.of(study), answer(study, model), 0.6))
    return rounds


@pytest.fixture(scope="module")
def summary(scores: list[RoundScore]) -> Summary:
    pytest.importorskip("pingouin")
    return summarise(scores)


def test_a_summary_counts_and_spreads_over_participants(scores: list[RoundScore], summary: Summary) -> None:
    assert summary.counts == {
        "participants": 4, "rounds": 16, "frames": 16 * 26, "touching_frames": 16 * 14, "touches": 32, "unseen_touches": 0,
        "minutes": pytest.approx(16 * 26 / 30 / 60),
    }  # fmt: skip
    clicks = summary.overall["click_accuracy"]
    assert clicks.pooled == pytest.approx(31 / 32) and clicks.spread.mean == pytest.approx((1 + 1 + 1 + 7 / 8) / 4)
    assert clicks.interval[0] < clicks.spread.mean < clicks.interval[1] and clicks.spread.count == 4
    assert summary.participants["p03"]["click_accuracy"] == figures(scores[12:])["click_accuracy"] == 7 / 8


def test_conditions_of_one_value_are_left_out_and_the_weakest_group_is_named(summary: Summary) -> None:
    assert list(summary.conditions) == ["skin tone", "place", "touch type"]
    assert summary.conditions["place"].worst == "outer_forearm"
    assert summary.conditions["place"].bayes.method == "BIC, within participants"
    assert summary.conditions["touch type"].bayes.method == "JZS, paired"
    assert summary.conditions["skin tone"].bayes.method == "JZS, two groups"


def test_curves_begin_and_end_where_they_must(summary: Summary) -> None:
    assert summary.roc[0] == (0.0, 0.0) and summary.roc[-1] == (1.0, 1.0)
    assert all(0 <= a <= 1 and 0 <= b <= 1 for a, b in (*summary.roc, *summary.reliability))
    assert summary.onset_delays == ((pytest.approx(1000 / 30), 31.0),)


def test_the_summary_is_json_without_nan(summary: Summary) -> None:
    told = json.loads(json.dumps(summary.to_dict(), allow_nan=False))
    assert told["overall"]["click_accuracy"]["pooled"] == 0.96875
    assert told["overall"]["hover_0_1_mm"]["pooled"] is None
    assert told["conditions"]["place"]["groups"]["palm"]["click_accuracy"] == 1.0
    assert plain({"a": (nan, 1, 0.123456789)}) == {"a": [None, 1, 0.12346]}


def test_every_figure_has_words_but_onsets_that_are_shifted_and_tolerated(scores: list[RoundScore]) -> None:
    wordless = {f"{edge}_f1_{tolerance}_shifted" for edge in ("onset", "offset") for tolerance in (1, 2, 4)}
    assert set(wording.UNITS) | wordless == set(figures(scores))


def test_the_report_tells_simulation_paper_and_goals(summary: Summary) -> None:
    heading = Heading("Study", ("Simulation. Nobody was measured.",), (("Model", "signal 1"),), shows_paper=True)
    text = to_markdown(build_report(heading, summary))
    assert "> **Simulation. Nobody was measured.**" in text and "- Model: signal 1" in text
    assert "| Click accuracy | 96.9 ± 6.2 % | 95.6 % | 97.0 % |" in text
    assert "| **outer forearm** | 4 | 4 |" in text
    assert "| place | " in text and " 1.023 |" in text and "| tap | 4 | 8 |" in text and " 94.5 % |" in text
    page = to_html(build_report(heading, summary))
    assert page.count("<svg") == 4 + 3 and "nan" not in page


def test_the_paper_is_left_out_where_it_has_no_place(summary: Summary) -> None:
    text = to_markdown(build_report(Heading("Data set", (), (), shows_paper=False), summary))
    assert "paper" not in text.partition("## How it was scored")[0] and "goal" not in text


def test_without_the_extra_the_factor_says_so(scores: list[RoundScore], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pingouin", None)
    factor = summarise(scores).conditions["touch type"].bayes
    assert isnan(factor.factor) and "egotouch-sdk[evaluation]" in factor.method


def test_nothing_to_score_is_an_error(tmp_path_factory: pytest.TempPathFactory) -> None:
    study = study_round("xxxx")
    model = TouchModel(signal_model(tmp_path_factory.mktemp("model")))
    with pytest.raises(SourceError, match="not one frame has an open gate"):
        summarise([score_round(Truth.of(study), answer(study, model), 0.6)])


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(0.9731, "%", "97.3 %"), (6.81, "pct", "6.8 %"), (33.3, "ms", "33 ms"), (0.238, "N", "0.24 N"), (0.5, "", "0.500"), (nan, "%", "–")],
)
def test_numbers_carry_their_unit(value: float, unit: str, text: str) -> None:
    assert wording.number(value, unit) == text


def test_spreads_and_intervals_name_the_unit_once() -> None:
    assert wording.with_spread(0.949, 0.035, "%") == "94.9 ± 3.5 %"
    assert wording.with_spread(0.949, nan, "%") == "94.9 %"
    assert wording.interval(0.1, 0.2, "N") == "0.10 to 0.20 N" and wording.interval(nan, nan, "N") == "–"
