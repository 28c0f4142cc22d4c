"""`egotouch evaluate study`: a simulated study, scored by the paper's protocol."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import Subparsers, add_command, add_ray_option, positive_int
from egotouch_sdk.cli.output import Progress, print_json
from egotouch_sdk.errors import ConfigError

if TYPE_CHECKING:
    from egotouch_sdk.evaluation.folds import Folds
    from egotouch_sdk.evaluation.round_score import RoundScore
    from egotouch_sdk.evaluation.study import ParticipantTask
    from egotouch_sdk.evaluation.study_report import Heading
    from egotouch_sdk.evaluation.summary import Summary
    from egotouch_sdk.study_data import Study

EXAMPLES = """\
  egotouch evaluate study data/study                                     the shipped model, the main figures on the terminal
  egotouch evaluate study data/study --report out/study.html             everything, with plots, in one file
  egotouch evaluate study data/study --folds folds.json --report out/study.md     each participant by a model that never saw it
  egotouch evaluate study data/study --jobs 8                            eight participants at a time; or --ray ADDRESS
"""
#: Figures on the terminal; the report has all.
SHOWN = (
    "accuracy", "tpr", "fpr", "shifted_accuracy", "shifted_tpr", "shifted_fpr", "aligned_accuracy", "aligned_tpr", "aligned_fpr", "auroc",
    "click_accuracy", "onset_f1_1", "onset_f1_2", "force_mae_n", "force_mae_range_percent", "soft_hard_frames", "hover_rejection",
    "hover_round_rejection", "onset_delay_ms_median", "false_touches_per_minute",
)  # fmt: skip


def add_parser(kinds: Subparsers) -> None:
    """Add `study` to `egotouch evaluate`."""
    parser = add_command(kinds, "study", "score a simulated study by the paper's protocol", EXAMPLES)
    parser.add_argument("folder", type=Path, metavar="DIR", help="folder with study.json and its rounds, from `egotouch synth study`")
    parser.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    parser.add_argument("--folds", type=Path, metavar="FILE", help="JSON: which model scores which participants, one that never saw them")
    parser.add_argument("--threads", type=positive_int, default=1, metavar="N", help="threads for the touch network (default 1)")
    parser.add_argument("--jobs", type=positive_int, default=1, metavar="N", help="participants at a time on this machine (default 1)")
    add_ray_option(parser)
    add_report_options(parser)
    parser.set_defaults(handler=evaluate_study)


def add_report_options(parser: argparse.ArgumentParser) -> None:
    """--report and --json."""
    parser.add_argument("--report", type=Path, metavar="FILE", help="write everything into one .html or .md file")
    parser.add_argument("--json", action="store_true", help="one JSON object with everything on stdout")


def evaluate_study(options: argparse.Namespace) -> int:
    """Score a study and tell it."""
    from egotouch_sdk.evaluation.folds import Folds, read_folds
    from egotouch_sdk.evaluation.study import score_study, tasks
    from egotouch_sdk.evaluation.summary import summarise
    from egotouch_sdk.study_data import open_study

    if options.model and options.folds:
        raise ConfigError("--model and --folds exclude each other", hint="--folds names the models itself")
    check_report(options.report)
    study = open_study(options.folder)
    folds = read_folds(options.folds) if options.folds else Folds({}, options.model)
    work = tasks(study, folds, options.threads)
    if options.ray or options.jobs > 1:
        scores = _score_on_workers(work, options)
    else:
        progress = Progress(len(study.files), always=True, unit="rounds")
        scores = score_study(work, done=lambda _: progress.step())
        progress.clear()
    heading, models = _heading(study, folds)
    summary = summarise(scores)
    tell(options, heading, summary, {"study": str(options.folder), "models": models, "held_out_by_folds": folds.are_held_out})
    return 0


def _score_on_workers(work: Sequence[ParticipantTask], options: argparse.Namespace) -> list[RoundScore]:
    from egotouch_sdk.evaluation.study_jobs import score_study_on
    from egotouch_sdk.jobs.choice import open_runner

    runner = open_runner(options.jobs, options.ray, options.threads)
    return score_study_on(runner, work, lambda line: print(line, file=sys.stderr, flush=True))


def _heading(study: Study, folds: Folds) -> tuple[Heading, list[Mapping[str, Any]]]:
    from egotouch_sdk.evaluation.study_report import SIMULATION, Heading

    models = _models(study, folds)
    recipe, warnings = study.recipe, [SIMULATION]
    if len(study.files) < study.expected:
        warnings.append(f"Unfinished: {len(study.files)} of {study.expected} rounds are there.")
    how = "all participants by one model, which must know none of them"
    if folds.are_held_out:
        how = "each participant by a model of a fold that never saw it"
    facts = (
        ("Study", f"{recipe.participants} simulated participants, {recipe.rounds} rounds each of {recipe.seconds_per_round:g} s"),
        ("Made with", f"seed {recipe.seed}, {recipe.fps:g} frames per second"),
        *(("Model", f"{each['model']}, threshold {each['down']:.3f}, sha256 {each['sha256'][:12]}") for each in models),
        ("Held out", how),
    )
    return Heading("Touch study in simulation", tuple(warnings), facts, shows_paper=True), models


def _models(study: Study, folds: Folds) -> list[Mapping[str, Any]]:
    from egotouch_sdk.touch import SHIPPED_MODEL, TouchManifest

    used: dict[Path, list[int]] = {}
    for number in study.files_of():
        used.setdefault(folds.model_of(number) or SHIPPED_MODEL, []).append(number)
    manifests = {file: TouchManifest.read(file.with_suffix(".json")) for file in used}
    return [
        {"model": f"{own.name} {own.version}", "sha256": own.sha256, "down": own.down_probability, "up": own.up_probability,
         "participants": used[file]}
        for file, own in manifests.items()
    ]  # fmt: skip


def check_report(path: Path | None) -> None:
    """Raise `ConfigError` for a report that could not be written, before any work is done."""
    if path is not None and path.suffix not in (".html", ".md"):
        raise ConfigError(f"{path} is neither .html nor .md", hint="Choose one of these endings for --report")


def tell(options: argparse.Namespace, heading: Heading, summary: Summary, about: Mapping[str, Any], shown: Sequence[str] = SHOWN) -> None:
    """Write the report where one is asked for, and print JSON or the main figures."""
    from egotouch_sdk.evaluation.document import write_document
    from egotouch_sdk.evaluation.study_report import build_report

    if options.report:
        write_document(options.report, build_report(heading, summary))
    if options.json:
        print_json({**about, **summary.to_dict()})
        return
    for warning in heading.warnings:
        print(warning)
    for line in _lines(summary, shown, heading.shows_paper):
        print(line)
    if options.report:
        print(f"report: {options.report}")


def _lines(summary: Summary, shown: Sequence[str], shows_paper: bool) -> list[str]:
    from egotouch_sdk.evaluation import wording
    from egotouch_sdk.evaluation.paper import GOALS, PAPER

    words = {name: text for rows in wording.FIGURES.values() for name, text, _ in rows}
    lines = [f"{'':<44}{'pooled':>10}{'mean':>20}{'95 % interval':>22}" + (f"{'paper':>10}{'goal':>10}" if shows_paper else "")]
    for name in shown:
        figure, unit = summary.overall[name], wording.UNITS[name]
        line = f"{words[name]:<44}{wording.number(figure.pooled, unit):>10}"
        line += f"{wording.with_spread(figure.spread.mean, figure.spread.std, unit):>20}{wording.interval(*figure.interval, unit):>22}"
        nan = float("nan")
        ends = (wording.number(table.get(name, nan), unit) for table in (PAPER, GOALS))
        lines.append(line + ("".join(f"{end:>10}" for end in ends) if shows_paper else ""))
    return lines
