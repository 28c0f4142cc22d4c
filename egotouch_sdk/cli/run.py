"""`egotouch run`: touch events from any source."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.cli.options import (
    Subparsers,
    add_command,
    add_pipeline_options,
    add_source_options,
    add_view_options,
    engine_from,
    open_frames_from,
    open_from,
)
from egotouch_sdk.cli.output import EventPrinter, Progress
from egotouch_sdk.cli.play import Run, play
from egotouch_sdk.cli.views import Views

if TYPE_CHECKING:
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.frame_result import FrameResult

EXAMPLES = """\
  egotouch run 0 --show                          the first camera, with a live view in the browser
  egotouch run clip.mp4                          one line per event
  egotouch run clip.mp4 --json > events.jsonl    one JSON object per event
  egotouch run clip.mp4 --save annotated.mp4     a video with hands, touch state and force
  egotouch run taps.yaml                         a simulator script, without a camera
  egotouch run http://192.168.1.7:8080/video     a phone or headset that streams its camera
"""
#: What fits into the view's headline.
TITLE_CHARACTERS = 20


def add_parser(subparsers: Subparsers) -> None:
    """Add `run` to the command line."""
    parser = add_command(subparsers, "run", "touch events from a camera, video, folder of images or script", EXAMPLES)
    add_source_options(parser)
    add_pipeline_options(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object per event on stdout")
    parser.add_argument("--show", action="store_true", help="open an annotated live view in the browser")
    add_view_options(parser)
    parser.add_argument("--progress", action="store_true", help="report progress on stderr even when that is not a terminal")
    parser.set_defaults(handler=run)


def run(options: argparse.Namespace) -> int:
    """Play the source and print its events."""
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED

    outcome = _run_with_views(options) if options.show or options.save else _run(options)
    summary = f"{outcome.frames} frames in {outcome.wall_s:.1f} s ({outcome.fps:.1f} per second)"
    sys.stderr.write(f"{summary}{', interrupted' if outcome.interrupted else ''}\n")
    if options.save:
        sys.stderr.write(f"saved {options.save}\n")
    return EXIT_INTERRUPTED if outcome.interrupted else 0


def _run(options: argparse.Namespace) -> Run:
    """Any source, as fast as it goes."""
    with open_from(options) as source:
        progress = Progress(source.frame_count, always=options.progress)
        outcome = play(source, engine_from(options, source), EventPrinter(options.json, progress), lambda *_: progress.step())
        progress.clear()
    return outcome


def _run_with_views(options: argparse.Namespace) -> Run:
    """A source with pictures, seen in the browser or saved as a video."""
    with open_frames_from(options) as source:
        engine = engine_from(options, source)
        progress = Progress(source.frame_count, always=options.progress)
        title = f"egotouch {Path(options.source).name}"[:TITLE_CHARACTERS]
        with Views(title, show=options.show, save=options.save, fps=source.fps, port=options.port) as views:
            views.show_in_browser()

            def on_frame(frame: Frame, result: FrameResult) -> None:
                views(frame, result)
                progress.step()

            printer = EventPrinter(options.json, progress)
            outcome = play(source, engine, printer, on_frame, paced=options.show and not source.is_live)
        progress.clear()
    return outcome
