"""`egotouch simulate`: touch events without a camera."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from egotouch_sdk.cli import serve
from egotouch_sdk.cli.options import Subparsers, add_command, add_config_option, engine_from, positive_float
from egotouch_sdk.cli.output import EventPrinter, Progress
from egotouch_sdk.cli.play import play
from egotouch_sdk.errors import ConfigError

EXAMPLES = """\
  egotouch simulate                      serve a page on which a mouse, pen or touch screen plays the finger, and open it
  egotouch simulate --lan                the same for a phone or headset in this network
  egotouch simulate --keypad             a phone's keys on the palm or forearm, dialled with the mouse
  egotouch simulate taps --serve         serve a script's events over and over, as a camera's
  egotouch simulate taps                 print them: a script that comes with the package, at its own speed
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
    parser = add_command(subparsers, "simulate", "touch events without a camera, played on a page or by a script", EXAMPLES)
    parser.add_argument("script", metavar="SCRIPT", nargs="?", help="a YAML file, or the name of a script that comes with the package")
    parser.add_argument("--fps", type=positive_float, help="pictures per second (default: 60 for the page, the script's own for a script)")
    parser.add_argument("--fast", action="store_true", help="do not wait between pictures; the events and their times are the same")
    parser.add_argument("--json", action="store_true", help="one JSON object per event on stdout")
    parser.add_argument("--serve", action="store_true", help="serve the script's events over and over instead of printing them")
    add_config_option(parser)
    served = parser.add_argument_group("the server, without SCRIPT or with --serve")
    serve.add_server_options(served)
    served.add_argument("--no-browser", dest="browser", action="store_false", help="do not open the page")
    parser.set_defaults(handler=simulate, mirrored=False, threads=None, size=None, once=False)


def simulate(options: argparse.Namespace) -> int:
    """Serve the page or the script, or play the script and print its events."""
    if options.script is not None and not options.serve:
        return _print_events(options)
    if options.fast or options.json:
        raise ConfigError("--fast and --json are for printing a script's events", hint="Give a script, without --serve")
    options.source = serve.SIMULATOR if options.script is None else str(_path(options.script))
    return serve.run(options)


def _print_events(options: argparse.Namespace) -> int:
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED
    from egotouch_sdk.simulator import ScriptSource

    with ScriptSource(_path(options.script), realtime=not options.fast, fps=options.fps) as source:
        outcome = play(source, engine_from(options, source), EventPrinter(options.json, Progress(None)))
    sys.stderr.write(f"{outcome.frames} observations in {outcome.wall_s:.1f} s{', interrupted' if outcome.interrupted else ''}\n")
    return EXIT_INTERRUPTED if outcome.interrupted else 0


def _path(script: str) -> Path:
    """The script's file, which may be one that comes with the package."""
    from egotouch_sdk.simulator import shipped_script

    path = Path(script)
    return path if path.suffix or path.exists() else shipped_script(script)
