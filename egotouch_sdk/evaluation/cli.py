"""`egotouch evaluate`: the touch model on real patches and on video without touches, the host frame on rendered touches."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from egotouch_sdk.cli import evaluate_dataset, evaluate_real, evaluate_study
from egotouch_sdk.cli.options import Subparsers, add_command
from egotouch_sdk.cli.output import print_json
from egotouch_sdk.errors import ConfigError

EXAMPLES = """\
  egotouch evaluate study data/study --report study.html   a simulated study by the paper's protocol
  egotouch evaluate dataset palmpad /data/Palmpad          labelled recordings through the whole pipeline
  egotouch evaluate real thumb_patches                     AUROC, accuracy and force on labelled real pictures
  egotouch evaluate false-touches clips/*.mp4              false touches per minute where nothing is touched
  egotouch evaluate host-frame                             place and angles of the demo clip's touches against the truth
"""
HOST_FRAME_EXAMPLES = """\
  egotouch evaluate host-frame                               the demo clip's touches
  egotouch evaluate host-frame --stills data/host_frame --render 400            rendered people, each scored by a fit to others
  egotouch evaluate host-frame --stills data/host_frame --fit tracker_fit.json  the fit to all of them, to use
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `evaluate` to the command line."""
    parser = add_command(subparsers, "evaluate", "measure the touch model: simulated study, labelled recordings, real pictures", EXAMPLES)
    kinds = parser.add_subparsers(title="what to measure", metavar="KIND", required=True)
    evaluate_study.add_parser(kinds)
    evaluate_real.add_parsers(kinds)
    evaluate_dataset.add_parser(kinds)
    host = add_command(kinds, "host-frame", "compare place and angles with the generator's truth", HOST_FRAME_EXAMPLES)
    host.add_argument("--stills", type=Path, metavar="DIR", help="rendered stills in DIR through the hand tracker, not the demo clip")
    host.add_argument("--render", type=int, metavar="N", help="with --stills: first render until N are there, 2 s each")
    host.add_argument("--fit", type=Path, metavar="FILE", help="with --stills: write the fit to all of them as JSON")
    host.add_argument("--json", action="store_true", help="one JSON object on stdout")
    host.set_defaults(handler=evaluate_host_frame)


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
