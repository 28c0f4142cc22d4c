"""`egotouch simulate`: touch events without a camera."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from egotouch_sdk.cli.options import Subparsers, add_command, add_config_option, engine_from, positive_float
from egotouch_sdk.cli.output import EventPrinter, Progress
from egotouch_sdk.cli.play import play

EXAMPLES = """\
  egotouch simulate taps                 a script that comes with the package, at its own speed
  egotouch simulate mine.yaml --fast     a script of your own, as fast as it goes
  egotouch simulate faults --json        one JSON object per event
  egotouch debug-events mine.yaml        the same events, as a live trace

a script (all keys: python -m pydoc egotouch_sdk.simulator.script):
  surface: palm
  acts:
    - tap: {at: [0, 50]}
    - press: {at: [20, 40], duration_ms: 800, force_n: 2.5, finger: thumb}
    - drag: {at: [0, 20], to: [0, 70], pitch_deg: 60, yaw_deg: -20}
    - vanish: {with_ms: 200}
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `simulate` to the command line."""
    parser = add_command(subparsers, "simulate", "touch events from a script, without a camera", EXAMPLES)
    parser.add_argument("script", metavar="SCRIPT", help="a YAML file, or the name of a script that comes with the package")
    parser.add_argument("--fps", type=positive_float, help="pictures per second, in place of the script's own")
    parser.add_argument("--fast", action="store_true", help="do not wait between pictures; the events and their times are the same")
    parser.add_argument("--json", action="store_true", help="one JSON object per event on stdout")
    add_config_option(parser)
    parser.set_defaults(handler=simulate, mirrored=False, threads=None)


def simulate(options: argparse.Namespace) -> int:
    """Play the script and print its events."""
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED
    from egotouch_sdk.simulator import ScriptSource, shipped_script

    path = Path(options.script)
    if not path.suffix and not path.exists():
        path = shipped_script(options.script)
    with ScriptSource(path, realtime=not options.fast, fps=options.fps) as source:
        outcome = play(source, engine_from(options, source), EventPrinter(options.json, Progress(None)))
    sys.stderr.write(f"{outcome.frames} observations in {outcome.wall_s:.1f} s{', interrupted' if outcome.interrupted else ''}\n")
    return EXIT_INTERRUPTED if outcome.interrupted else 0
