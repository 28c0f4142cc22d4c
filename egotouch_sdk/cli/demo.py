"""`egotouch demo`: the packaged clip through the whole pipeline, scored against its ground truth."""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import Subparsers, add_command, add_threads_option, add_view_options, with_threads
from egotouch_sdk.cli.output import EventPrinter, Progress, print_json
from egotouch_sdk.cli.play import play
from egotouch_sdk.cli.views import Views
from egotouch_sdk.errors import SourceError
from egotouch_sdk.touch_event import TouchEvent

if TYPE_CHECKING:
    from egotouch_sdk.evaluation.truth import ClipTruth

ASSETS = Path(__file__).parent.parent / "assets"
#: A demo that takes longer than its clip by this factor was not real time (our choice, room for start and end).
SLOW_FACTOR = 1.2
EXAMPLES = """\
  egotouch demo                          live view in the browser, one line per event
  egotouch demo --headless               the terminal only
  egotouch demo --headless --fast        as quick as this machine can
  egotouch demo --json --headless        one JSON object per event, the scoreboard last
  egotouch demo --save annotated.mp4     keep the annotated view as a video
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `demo` to the command line."""
    parser = add_command(subparsers, "demo", "play a clip of touches on skin through the whole pipeline, without a camera", EXAMPLES)
    parser.add_argument("--headless", action="store_true", help="no view: print events only")
    parser.add_argument("--fast", action="store_true", help="do not hold frames back to real time")
    parser.add_argument("--json", action="store_true", help="one JSON object per event on stdout, the scoreboard last")
    add_view_options(parser)
    add_threads_option(parser)
    parser.set_defaults(handler=demo)


def demo(options: argparse.Namespace) -> int:
    """Play the clip, print its events and the scoreboard."""
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.evaluation.scoreboard import score
    from egotouch_sdk.evaluation.truth import ClipTruth
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.sources import VideoFileSource

    clip, truth_file = ASSETS / "demo.mp4", ASSETS / "demo_truth.json"
    if not (clip.is_file() and truth_file.is_file()):
        raise SourceError(f"this install lacks the demo clip {clip}", hint="Install the package again, or use: egotouch run SOURCE")
    truth = ClipTruth.from_dict(json.loads(truth_file.read_text(encoding="utf-8")))
    pipeline = TouchPipeline(TouchConfig(**with_threads({}, options.threads)))
    events: list[TouchEvent] = []
    printer = EventPrinter(options.json, Progress(None))

    def on_event(event: TouchEvent) -> None:
        events.append(event)
        printer(event)

    with VideoFileSource(clip) as source:
        saved, views = _open_views(options, source.fps, truth)
        with views:
            outcome = play(source, pipeline, on_event, views, paced=not options.fast)
    board = score(truth.until(outcome.last_timestamp_ns) if outcome.interrupted else truth, events, pipeline.config.gestures)
    if options.json:
        print_json({"scoreboard": board.to_dict()})
    else:
        _print_scoreboard(board.to_dict())
    sys.stderr.write(f"{outcome.frames} frames in {outcome.wall_s:.1f} s ({outcome.fps:.1f} per second)\n")
    if not options.fast and outcome.wall_s * 1e9 > SLOW_FACTOR * outcome.last_timestamp_ns:
        sys.stderr.write("this machine did not keep up with the clip, so events came late; their times are capture times all the same\n")
    if saved:
        sys.stderr.write(f"annotated video: {saved}\n")
    return EXIT_INTERRUPTED if outcome.interrupted else 0


def _open_views(options: argparse.Namespace, fps: float | None, truth: ClipTruth) -> tuple[Path | None, Views]:
    """The view in the browser; where there is no desktop, a video file in its place."""

    def open_views(save: Path | None) -> Views:
        show = not options.headless
        return Views("egotouch demo", show=show, save=save, fps=fps, port=options.port, true_force_n=truth.force_at_n)

    views = open_views(options.save)
    if options.headless or views.show_in_browser() or options.save:
        return options.save, views
    views.close()
    saved = Path(tempfile.gettempdir()) / "egotouch-demo.mp4"
    sys.stderr.write(f"no browser here: the annotated view goes to {saved}\n")
    return saved, open_views(saved)


def _print_scoreboard(board: dict[str, Any]) -> None:
    print(f"\n{'':<14}{'true':>6}{'found':>7}{'missed':>8}{'false':>7}")
    for name, count in board["counts"].items():
        print(f"{name.replace('_', ' '):<14}{count['true']:>6}{count['found']:>7}{count['missed']:>8}{count['false']:>7}")
    onset, p95, force = board["onset_error_ms_median"], board["onset_error_ms_p95"], board["force_mae_n"]
    print(f"onset error   {'-' if onset is None else f'{onset:.0f} ms median, {p95:.0f} ms p95'}")
    print(f"force error   {'-' if force is None else f'{force:.2f} N mean'}")
