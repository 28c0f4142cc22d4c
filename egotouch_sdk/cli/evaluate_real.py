"""`egotouch evaluate real` and `egotouch evaluate false-touches`: real skin, none of it trained on."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.evaluate_study import add_report_options, check_report
from egotouch_sdk.cli.options import Subparsers, add_command, add_pipeline_options, config_from, point_px, positive_float
from egotouch_sdk.cli.output import print_json

if TYPE_CHECKING:
    from egotouch_sdk.evaluation.document import Table
    from egotouch_sdk.evaluation.false_touches import FalseTouches

REAL_EXAMPLES = """\
  egotouch evaluate real thumb_patches                          per recording and pooled, the darkness rule beside the model
  egotouch evaluate real thumb_patches --report out/real.html   the same as a report
  egotouch evaluate real thumb_patches --stills                 every picture alone, whatever came before it

A model that remembers judges the pictures of a recording as a film at 30 frames per second, numbered by the column `frame` of
labels.csv; pictures labelled otherwise than touch or hover, or not surely, are shown to it and not scored.
"""
FALSE_EXAMPLES = """\
  egotouch evaluate false-touches clips/*.mp4                   false touches per minute, of each clip and of all
  egotouch evaluate false-touches clips/*.mp4 --without-gate    as if a hand to touch were always near
  egotouch evaluate false-touches clips/*.mp4 --json            one JSON object per clip and one for all
"""
#: Columns of the tables, by figure.
TOUCH_COLUMNS = {
    "touches": "touches",
    "hovers": "hovers",
    "auroc": "AUROC",
    "darkness_auroc": "darkness",
    "accuracy": "accuracy",
    "true_positive_rate": "TPR",
    "false_positive_rate": "FPR",
}
FORCE_COLUMNS = {"force_spearman": "force rank", "force_spearman_above_floor": "above floor"}
#: Where the TIP landmark lies in the finger-up pictures of the thumb study, and their scale (measured on them).
THUMB_TIP_PX = (316.0, 175.0)
THUMB_PX_PER_MM = 7.3
#: Least confidence of an eye label that counts.
MIN_CONFIDENCE = 0.7


def add_parsers(kinds: Subparsers) -> None:
    """Add `real` and `false-touches` to `egotouch evaluate`."""
    real = add_command(kinds, "real", "score labelled real finger-up pictures", REAL_EXAMPLES)
    real.add_argument("folder", type=Path, metavar="DIR", help="folder with labels.csv and the pictures")
    real.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    real.add_argument("--tip", type=point_px, default=THUMB_TIP_PX, metavar="X,Y", help="TIP landmark in pixels (default 316,175)")
    real.add_argument("--px-per-mm", type=positive_float, default=THUMB_PX_PER_MM, metavar="S", help="scale of the pictures (default 7.3)")
    real.add_argument("--min-confidence", type=positive_float, default=MIN_CONFIDENCE, metavar="C", help="default 0.7")
    real.add_argument("--stills", action="store_true", help="judge every picture alone, not as the frames of a film")
    add_report_options(real)
    real.set_defaults(handler=evaluate_real)
    false = add_command(kinds, "false-touches", "count touches in video without any", FALSE_EXAMPLES)
    false.add_argument("videos", nargs="+", metavar="VIDEO", help="video files, image folders or cameras")
    false.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    false.add_argument(
        "--without-gate", action="store_true", help="show every outstretched finger to the model"
    )
    add_pipeline_options(false)
    add_report_options(false)
    false.set_defaults(handler=evaluate_false_touches)


def evaluate_real(options: argparse.Namespace) -> int:
    """Score real patches and print the report."""
    from egotouch_sdk.evaluation.document import Document, Facts, Section, Text, write_document
    from egotouch_sdk.evaluation.real_estimates import estimate_film, estimate_stills
    from egotouch_sdk.evaluation.real_patches import FLOOR_COUNTS, read_real_patches, real_report
    from egotouch_sdk.touch import TouchModel

    check_report(options.report)
    model = TouchModel(options.model)
    as_film = model.memory_size > 0 and not options.stills
    patches = read_real_patches(options.folder, options.tip, options.px_per_mm, options.min_confidence, history=as_film)
    report = real_report(patches, (estimate_film if as_film else estimate_stills)(patches, model), model.manifest.down_probability)
    about = {"model": f"{model.manifest.name} {model.manifest.version}", "sha256": model.manifest.sha256}
    report = {**about, "judged": "film" if as_film else "stills", **report}
    judged = "as films at 30 frames per second, each picture with what the model remembers of those before it"
    if not as_film:
        judged = "every picture alone" if model.memory_size else "every picture alone, since the model has no memory"
    threshold = f"{report['threshold']:.3f}, the model's own, chosen before without these pictures"
    rows = {**report["recordings"], "pooled": report["pooled"]}
    if options.report:
        facts = (
            ("Model", f"{report['model']}, sha256 {report['sha256'][:12]}"),
            ("Threshold", threshold),
            ("Judged", judged),
            ("Pictures", str(options.folder)),
        )
        text = (
            "Intervals are 95 % bootstraps: of a recording by stretches of frames, pooled by whole recordings and stretches within them. "
            f"Force is the rank correlation with the raw sensor over touches with a reading; the floor is {FLOOR_COUNTS:g} counts. "
            "Darkness is the trivial rule that the darker patch is the touch."
        )
        touch, force = _real_table(rows, TOUCH_COLUMNS), _real_table(rows, FORCE_COLUMNS)
        sections = (
            Section("Touch by recording", (touch,)),
            Section("Force by recording", (force,)),
            Section("How it was scored", (Text(text),)),
        )
        write_document(options.report, Document("Touch model on real skin", (Facts(facts),), sections))
    if options.json:
        print_json(report)
        return 0
    print(f"{report['model']}, threshold {threshold}\njudged {judged}")
    _print_table(_real_table(rows, {**TOUCH_COLUMNS, **FORCE_COLUMNS}))
    return 0


def _real_table(rows: Mapping[str, Mapping[str, Any]], columns: Mapping[str, str]) -> Table:
    from egotouch_sdk.evaluation.document import Table

    cells = ((name, *(_cell(row, column) for column in columns)) for name, row in rows.items())
    return Table(("", *columns.values()), tuple(cells))


def _cell(scores: Mapping[str, Any], column: str) -> str:
    value, interval = scores.get(column), scores.get(f"{column}_interval")
    if value is None:
        return "–"
    if isinstance(value, int):
        return str(value)
    return f"{value:.3f}" + (f" [{interval[0]:.2f}, {interval[1]:.2f}]" if interval else "")


def evaluate_false_touches(options: argparse.Namespace) -> int:
    """Run clips through the whole pipeline and print false touches per minute."""
    from egotouch_sdk.evaluation.document import Document, Facts, Section, Table, write_document
    from egotouch_sdk.evaluation.false_touches import FalseTouches, count_false_touches, count_without_gate
    from egotouch_sdk.hands.tracker import HandTracker
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.sources import open_frames
    from egotouch_sdk.touch import TouchModel

    check_report(options.report)
    config, model = config_from(options), TouchModel(options.model, options.threads or 1)
    clips: list[tuple[str, FalseTouches]] = []
    for spec in options.videos:
        with open_frames(spec) as source:
            if options.without_gate:
                counted = count_without_gate(source, HandTracker(**config.hands.model_dump()), model, config)
            else:
                counted = count_false_touches(source, TouchPipeline(config, touch=model))
        clips.append((spec, counted))
        _print_false_touches(*clips[-1], options.json)
    clips.append(("all", sum((counted for _, counted in clips), FalseTouches(0, 0.0, 0, 0, 0, 0))))
    _print_false_touches(*clips[-1], options.json)
    gate = "No gate: every outstretched finger is shown to the model." if options.without_gate else "The gate decides, as in live use."
    if not clips[-1][1].frames_with_open_gate:
        gate += " It never opened, so the touch model was never asked: see --without-gate."
    if not options.json:
        print(gate)
    if options.report:
        head = ("", "seconds", "gate open, s", "false touches", "per minute", "95 % interval")
        rows = tuple((Path(name).name, *_false_cells(counted)) for name, counted in clips)
        own = f"{model.manifest.name} {model.manifest.version}, sha256 {model.manifest.sha256[:12]}"
        facts = Facts((("Model", own), ("Gate", gate)))
        table = Table(head, rows, frozenset({len(rows) - 1}))
        write_document(options.report, Document("False touches where nothing is touched", (facts,), (Section("By clip", (table,)),)))
    return 0


def _false_cells(counted: FalseTouches) -> tuple[str, ...]:
    low, high = counted.interval_per_minute
    rates = f"{counted.downs_per_minute:.2f}", f"{low:.2f} to {high:.2f}"
    return f"{counted.duration_s:.1f}", f"{counted.open_gate_s:.1f}", str(counted.downs), *rates


def _print_false_touches(name: str, counted: FalseTouches, as_json: bool) -> None:
    low, high = counted.interval_per_minute
    if as_json:
        bounds = [round(low, 4), round(high, 4) if isfinite(high) else None]
        print_json(
            {"video": name, **asdict(counted), "downs_per_minute": round(counted.downs_per_minute, 4), "interval_per_minute": bounds}
        )
        return
    gate = f"gate open in {counted.frames_with_open_gate} of {counted.frames} frames"
    rate = f"{counted.downs:>3} DOWN  {counted.downs_per_minute:6.2f} per minute [{low:.2f}, {high:.2f}]"
    sys.stdout.write(f"{Path(name).name:<28} {counted.duration_s:7.1f} s  {rate}  {gate}\n")
    sys.stdout.flush()


def _print_table(table: Table) -> None:
    rows = [table.head, *table.rows]
    widths = [max(len(row[column]) for row in rows) for column in range(len(table.head))]
    for name, *cells in rows:
        print("  ".join([name.ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(cells, widths[1:], strict=True))]))
