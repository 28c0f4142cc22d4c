"""A summary told as a report: tables and plots, the paper's figures beside ours where that makes sense."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isnan, nan

from egotouch_sdk.evaluation import wording
from egotouch_sdk.evaluation.bootstrap import interval_of_mean
from egotouch_sdk.evaluation.document import Block, Document, Facts, Plot, Section, Table, Text
from egotouch_sdk.evaluation.paper import GOALS, PAPER, PAPER_ACCURACY_STD, PAPER_BAYES, PAPER_GROUPS
from egotouch_sdk.evaluation.study_score import height_names
from egotouch_sdk.evaluation.summary import Condition, Summary
from egotouch_sdk.evaluation.svg import column_plot, curve_plot, interval_plot

SIMULATION = (
    "Simulation. Every person, skin and touch in this study is rendered; no real person was measured. "
    "The paper's figures are of 15 real people: they show the protocol's scale and are no comparison."
)
#: What each figure means, told with every report.
METHOD = """\
Only frames in which the proximity gate is open are scored. Calls come from the product's own chain: the touch model, the causal
three-frame median, and the touch state machine with its two thresholds, which were fixed before, without this data. Unless a row says
otherwise, frames are scored behind the state machine against the truth of the very same frame, so that the median's delay of one frame
counts as error. "Truth one frame later" takes that delay out, as the paper did; its frame figures stand beside these rows.

Aligned: dynamic time warping of calls against truth within a hard band of 4 frames, solved exactly; pairs on the path are counted.

A click is a true touch met by exactly one told touch that meets no other. Onsets and offsets are matched one to one within 0, 1, 2 or 4
frames. A touch that begins in the last 4 frames of a round counts in frames only; so do an onset before the round's first frame and an
offset in its last 4. Onset AP ranks the rises of the median's probability, without any threshold.

Force is told in newtons, in % of the 3.5 N range (the paper's figure is compared with this one) and relative to the true force.

Intervals are 95 % percentile bootstraps over participants, never over frames. Bayes factors compare the accuracies of participants: of
two values by JZS t-test, of more by BIC approximation; above 1 speaks for a difference, below 1 for none.
"""


@dataclass(frozen=True, slots=True)
class Heading:
    """What stands above the figures: the title, warnings in order, plain facts as (what, value), and whether the paper is shown."""

    title: str
    warnings: tuple[str, ...]
    facts: tuple[tuple[str, str], ...]
    shows_paper: bool


def build_report(heading: Heading, summary: Summary) -> Document:
    """The whole report."""
    counts = summary.counts
    scored = f"{counts['participants']} participants, {counts['rounds']} rounds, {counts['frames']} frames, {counts['minutes']:.1f} min"
    touching = wording.number(counts["touching_frames"] / counts["frames"], "%")
    touches = f"{counts['touches']}, and {counts['unseen_touches']} that the gate never let through; {touching} of the frames touch"
    facts = (*heading.facts, ("Scored", scored), ("Touches", touches))
    lead: list[Block] = [Text(warning, is_warning=True) for warning in heading.warnings]
    lead.append(Facts(facts))
    sections = [Section(title, tuple(_figures(title, summary, heading.shows_paper))) for title in wording.FIGURES]
    sections.insert(1, Section("Which side is scored", (_sides(summary),)))
    for name, condition in summary.conditions.items():
        sections.append(Section(f"By {name}", tuple(_condition(name, condition, heading.shows_paper))))
    if summary.conditions:
        sections.append(Section("Bayes factors", (_bayes(summary.conditions, heading.shows_paper),)))
    sections.append(Section("By participant", (_participants(summary),)))
    sections.append(Section("How it was scored", tuple(Text(" ".join(text.split())) for text in METHOD.split("\n\n"))))
    return Document(heading.title, tuple(lead), tuple(sections))


def _figures(title: str, summary: Summary, shows_paper: bool) -> list[Block]:
    rows = []
    for name, words, unit in wording.FIGURES[title]:
        figure = summary.overall[name]
        row = [words, wording.with_spread(figure.spread.mean, figure.spread.std, unit)]
        if shows_paper:
            std = PAPER_ACCURACY_STD if name == "shifted_accuracy" else nan
            row += [wording.with_spread(PAPER.get(name, nan), std, unit), wording.number(GOALS.get(name, nan), unit)]
        rows.append((*row, wording.interval(*figure.interval, unit), wording.number(figure.pooled, unit)))
    paper = ("paper", "goal") if shows_paper else ()
    head = ("", "mean ± std over participants", *paper, "95 % interval", "all pooled")
    blocks: list[Block] = [Table(head, tuple(rows))]
    plots = _plots(title, summary)
    return [*blocks, plots] if plots else blocks


def _plots(title: str, summary: Summary) -> list[Plot]:
    if title == "Frames" and summary.roc:
        return [
            Plot(
                curve_plot(summary.roc, "false positive rate", "true positive rate", diagonal=True), "ROC of the model's own probability."
            ),
            Plot(curve_plot(summary.reliability, "probability told", "share that touches", diagonal=True), "Reliability; dashed: perfect."),
        ]
    if title == "Time" and summary.onset_delays:
        columns = [(f"{ms:.0f}", count) for ms, count in summary.onset_delays]
        return [
            Plot(column_plot(columns, unit="", digits=0), "Onset delay of clicks in ms, told minus true; a column per frame at 30 fps.")
        ]
    if title == "Hover":
        columns = [(_height(name), summary.overall[name].pooled * 100) for name in height_names()]
        return [Plot(column_plot(columns, top=100), "Hovering frames told as hover, by height of the fingertip in mm.")]
    return []


def _height(name: str) -> str:
    parts = name.removeprefix("hover_").removesuffix("_mm").split("_")
    return f"> {parts[1]}" if parts[0] == "over" else f"{parts[0]}–{parts[1]}"


def _sides(summary: Summary) -> Table:
    names = {"raw": "Model alone", "median": "Three-frame median", "live": "State machine (live)"}
    kinds = {"": "", " +1": ", truth one frame later", " aligned": ", aligned within 4 frames"}
    rows = []
    for key, row in summary.frames.items():
        side, _, kind = key.partition(" ")
        told = wording.with_spread(row["accuracy"], row["accuracy_std"], "%")
        label = names[side] + kinds[f" {kind}" if kind else ""]
        rows.append((label, told, wording.number(row["tpr"], "%"), wording.number(row["fpr"], "%")))
    return Table(("mean over participants", "accuracy", "true positive rate", "false positive rate"), tuple(rows))


def _condition(name: str, condition: Condition, shows_paper: bool) -> list[Block]:
    head = ["", "people", "rounds", "accuracy", "aligned", "TPR", "FPR", "clicks", "hover", "force error"]
    columns = ("aligned_accuracy", "tpr", "fpr", "click_accuracy", "hover_rejection", "force_mae_range_percent")
    paper = {part.name: PAPER_GROUPS.get((name, part.name), nan) for part in condition.groups}
    tells_paper = shows_paper and not all(map(isnan, paper.values()))
    rows = []
    for part in condition.groups:
        row = [wording.words(part.name), str(len(part.accuracies)), str(part.rounds)]
        row.append(wording.with_spread(part.accuracy.mean, part.accuracy.std, "%"))
        row += [wording.number(part.figures[column], wording.UNITS[column]) for column in columns]
        rows.append(tuple(row + ([wording.number(paper[part.name], "%")] if tells_paper else [])))
    marked = frozenset(index for index, part in enumerate(condition.groups) if part.name == condition.worst)
    dots = [
        (wording.words(part.name), part.accuracy.mean * 100, _percent(interval_of_mean(list(part.accuracies.values()))))
        for part in condition.groups
    ]
    text = f"Weakest: {wording.words(condition.worst)}. " if condition.worst else ""
    return [
        Text(f"{text}Bayes factor {_factor(condition.bayes.factor)} ({condition.bayes.method})."),
        Table(tuple(head + (["paper"] if tells_paper else [])), tuple(rows), marked),
        [Plot(interval_plot(dots), "Frame accuracy: mean over participants and its 95 % interval.")],
    ]


def _percent(bounds: tuple[float, float]) -> tuple[float, float]:
    return bounds[0] * 100, bounds[1] * 100


def _bayes(conditions: Mapping[str, Condition], shows_paper: bool) -> Table:
    rows = []
    for name, condition in conditions.items():
        row = [name, _factor(condition.bayes.factor), condition.bayes.method, str(condition.bayes.participants)]
        rows.append(tuple(row + ([_factor(PAPER_BAYES.get(name, nan))] if shows_paper else [])))
    return Table(("condition", "factor", "method", "participants", *(("paper",) if shows_paper else ())), tuple(rows))


def _factor(value: float) -> str:
    return wording.NOTHING if isnan(value) else f"{value:.3f}" if value < 1000 else f"{value:.1e}"


def _participants(summary: Summary) -> Table:
    columns: Sequence[tuple[str, str]] = (
        ("accuracy", "accuracy"),
        ("aligned_accuracy", "aligned"),
        ("tpr", "TPR"),
        ("fpr", "FPR"),
        ("auroc", "AUROC"),
        ("click_accuracy", "clicks"),
        ("hover_rejection", "hover"),
        ("force_mae_n", "force error"),
        ("onset_delay_ms_median", "onset delay"),
    )
    rows = tuple(
        (name, *(wording.number(told[column], wording.UNITS[column]) for column, _ in columns))
        for name, told in summary.participants.items()
    )
    known = [told["accuracy"] for told in summary.participants.values()]
    marked = frozenset({known.index(min(known))}) if len(known) > 1 else frozenset()
    return Table(("", *(words for _, words in columns)), rows, marked)
