"""`egotouch evaluate`: the touch model on real patches and on video without touches, the host frame on rendered touches."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from egotouch_sdk.cli import evaluate_study
from egotouch_sdk.cli.options import Subparsers, add_command, add_pipeline_options, config_from, positive_float
from egotouch_sdk.cli.output import print_json
from egotouch_sdk.errors import ConfigError

EXAMPLES = """\
  egotouch evaluate study data/study --report study.html      a simulated study by the paper's protocol
  egotouch evaluate real thumb_patches                 AUROC, accuracy and force on labelled real pictures
  egotouch evaluate false-touches clips/*.mp4          false touches per minute where nothing is touched
  egotouch evaluate host-frame                         place and angles of the demo clip's touches against the truth
"""
HOST_FRAME_EXAMPLES = """\
  egotouch evaluate host-frame                               the demo clip's touches
  egotouch evaluate host-frame --stills data/host_frame --render 400            rendered people, each scored by a fit to others
  egotouch evaluate host-frame --stills data/host_frame --fit tracker_fit.json  the fit to all of them, to use
"""
#: Where the TIP landmark lies in the finger-up pictures of the thumb study, and their scale (measured on them).
THUMB_TIP_PX = (316.0, 175.0)
THUMB_PX_PER_MM = 7.3
#: Least confidence of an eye label that counts.
MIN_CONFIDENCE = 0.7


def add_parser(subparsers: Subparsers) -> None:
    """Add `evaluate` to the command line."""
    parser = add_command(subparsers, "evaluate", "measure the touch model on real pictures or on video without touches", EXAMPLES)
    kinds = parser.add_subparsers(title="what to measure", metavar="KIND", required=True)
    evaluate_study.add_parser(kinds)
    real = add_command(kinds, "real", "score labelled real finger-up pictures", "  egotouch evaluate real thumb_patches --json\n")
    real.add_argument("folder", type=Path, metavar="DIR", help="folder with labels.csv and the pictures")
    real.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    real.add_argument("--tip", type=_point, default=THUMB_TIP_PX, metavar="X,Y", help="TIP landmark in pixels (default 316,175)")
    real.add_argument("--px-per-mm", type=positive_float, default=THUMB_PX_PER_MM, metavar="S", help="scale of the pictures (default 7.3)")
    real.add_argument("--min-confidence", type=positive_float, default=MIN_CONFIDENCE, metavar="C", help="default 0.7")
    real.add_argument("--json", action="store_true", help="one JSON object on stdout")
    real.set_defaults(handler=evaluate_real)
    false = add_command(kinds, "false-touches", "count touches in video without any", "  egotouch evaluate false-touches clips/*.mp4\n")
    false.add_argument("videos", nargs="+", metavar="VIDEO", help="video files, image folders or cameras")
    false.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    add_pipeline_options(false)
    false.add_argument("--json", action="store_true", help="one JSON object per video and one for all on stdout")
    false.set_defaults(handler=evaluate_false_touches)
    host = add_command(kinds, "host-frame", "compare place and angles with the generator's truth", HOST_FRAME_EXAMPLES)
    host.add_argument("--stills", type=Path, metavar="DIR", help="rendered stills in DIR through the hand tracker, not the demo clip")
    host.add_argument("--render", type=int, metavar="N", help="with --stills: first render until N are there, 2 s each")
    host.add_argument("--fit", type=Path, metavar="FILE", help="with --stills: write the fit to all of them as JSON")
    host.add_argument("--json", action="store_true", help="one JSON object on stdout")
    host.set_defaults(handler=evaluate_host_frame)


def evaluate_real(options: argparse.Namespace) -> int:
    """Score real patches and print the report."""
    from egotouch_sdk.evaluation.real_patches import estimate_all, read_real_patches, real_report
    from egotouch_sdk.touch import TouchModel

    patches = read_real_patches(options.folder, options.tip, options.px_per_mm, options.min_confidence)
    model = TouchModel(options.model)
    report = real_report(patches, estimate_all(patches, model), model.manifest.down_probability)
    report = {"model": f"{model.manifest.name} {model.manifest.version}", "sha256": model.manifest.sha256, **report}
    if options.json:
        print_json(report)
        return 0
    print(f"{report['model']}, threshold {report['threshold']:.3f}, chosen on rendered pictures")
    print(f"{'':<12}{'touches':>8}{'hovers':>8}{'AUROC':>8}{'darkness':>10}{'accuracy':>10}{'TPR':>7}{'FPR':>7}{'force rho':>11}")
    for name, scores in {**report["recordings"], "pooled": report["pooled"]}.items():
        print(_row(name, scores))
    return 0


def evaluate_false_touches(options: argparse.Namespace) -> int:
    """Run clips through the whole pipeline and print false touches per minute."""
    from egotouch_sdk.evaluation.false_touches import FalseTouches, count_false_touches
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.sources import open_frames
    from egotouch_sdk.touch import TouchModel

    config, model = config_from(options), TouchModel(options.model, options.threads or 1)
    total = FalseTouches(0, 0.0, 0, 0, 0, 0)
    for spec in options.videos:
        with open_frames(spec) as source:
            counted = count_false_touches(source, TouchPipeline(config, touch=model))
        total = total + counted
        _print_false_touches(spec, counted, options.json)
    _print_false_touches("all", total, options.json)
    return 0


def evaluate_host_frame(options: argparse.Namespace) -> int:
    """Print errors of place and angles per surface."""
    from egotouch_sdk.cli.host_frame_cases import demo_cases, still_cases
    from egotouch_sdk.evaluation.host_frame import format_report, host_report
    from egotouch_sdk.evaluation.host_frame_fit import fit_tracker, fits_of_others, to_dict

    if options.stills is None:
        if options.render is not None or options.fit is not None:
            raise ConfigError("--render and --fit need --stills DIR")
        report = host_report(demo_cases())
    else:
        cases = list(still_cases(options.stills, options.render or 0, lambda line: print(line, file=sys.stderr)))
        report = host_report(cases, fits_of_others(cases))
        if options.fit is not None:
            options.fit.write_text(json.dumps(to_dict(fit_tracker(cases)), separators=(",", ":")) + "\n", encoding="utf-8")
    if options.json:
        print_json(report)
    else:
        print(format_report(report))
    return 0


def _print_false_touches(name: str, counted: Any, as_json: bool) -> None:
    if as_json:
        print_json({"video": name, **asdict(counted), "downs_per_minute": round(counted.downs_per_minute, 4)})
        return
    gate = f"gate open in {counted.frames_with_open_gate} of {counted.frames} frames"
    rate = f"{counted.downs:>3} DOWN  {counted.downs_per_minute:6.2f} per minute"
    sys.stdout.write(f"{Path(name).name:<28} {counted.duration_s:7.1f} s  {rate}  {gate}\n")
    sys.stdout.flush()


def _row(name: str, scores: dict[str, Any]) -> str:
    cells = [f"{name:<12}{scores['touches']:>8}{scores['hovers']:>8}"]
    widths = {"auroc": 8, "darkness_auroc": 10, "accuracy": 10, "true_positive_rate": 7, "false_positive_rate": 7, "force_spearman": 11}
    for key, width in widths.items():
        value = scores.get(key)
        cells.append(f"{'-' if value is None else f'{value:.3f}':>{width}}")
    return "".join(cells)


def _point(text: str) -> tuple[float, float]:
    """`316,175` as (316.0, 175.0), for argparse."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form X,Y") from error
    return x, y
