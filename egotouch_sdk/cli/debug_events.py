"""`egotouch debug-events`: a live trace of pointers and events in the terminal."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import (
    Subparsers,
    add_command,
    add_pipeline_options,
    add_source_options,
    engine_from,
    open_from,
    positive_float,
    size_px,
)
from egotouch_sdk.cli.play import Engine, play
from egotouch_sdk.errors import MissingExtraError

if TYPE_CHECKING:
    from egotouch_sdk.engine import EventEngine
    from egotouch_sdk.sources import FrameSource, ObservationSource
    from egotouch_sdk.touch_event import TouchEvent

EXAMPLES = """\
  egotouch debug-events 0                              the first camera
  egotouch debug-events taps.yaml                      a simulator script, at its own speed
  egotouch debug-events clip.mp4 --no-tui              plain lines: state -> EVENT -> state
  egotouch debug-events taps.yaml --screenshot t.svg   the screen at the end, as a picture

keys: space pause, f show moves, s save the log, q quit
"""
#: Characters of a screenshot: wide enough for every column.
SCREENSHOT_SIZE = (140, 40)


def add_parser(subparsers: Subparsers) -> None:
    """Add `debug-events` to the command line."""
    parser = add_command(subparsers, "debug-events", "live trace of pointer states and events in the terminal", EXAMPLES)
    add_source_options(parser)
    add_pipeline_options(parser)
    parser.add_argument("--no-tui", action="store_true", help="plain lines on stdout, as fast as the source goes")
    parser.add_argument("--moves", action="store_true", help="with --no-tui: also the events that come with every frame")
    parser.add_argument("--log", type=Path, metavar="FILE", default=Path("debug-events.txt"), help="where the key s saves the log")
    parser.add_argument("--screenshot", type=Path, metavar="FILE.svg", help="play without a terminal and save its last screen")
    parser.add_argument("--at", type=positive_float, metavar="S", help="with --screenshot: the screen this long after the first frame")
    parser.add_argument("--screen", type=size_px, metavar="WxH", default=SCREENSHOT_SIZE, help="characters of a screenshot")
    parser.set_defaults(handler=debug_events)


def debug_events(options: argparse.Namespace) -> int:
    """Trace the source on the screen or line by line."""
    with open_from(options) as source:
        engine: Engine[Any] = engine_from(options, source)
        if options.no_tui:
            return _print_lines(options, source, engine)
        return _show(options, source, engine)


def _print_lines(options: argparse.Namespace, source: FrameSource | ObservationSource, engine: Engine[Any]) -> int:
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED
    from egotouch_sdk.cli.trace.entries import Trace
    from egotouch_sdk.cli.trace.lines import HEADER, plain_line

    core = _core(engine)
    trace = Trace(core.thresholds, core.config.gestures)
    start_ns: list[int] = []

    def on_event(event: TouchEvent) -> None:
        entry = trace.note(event, start_ns[0])
        if options.moves or event.type.is_edge:
            print(plain_line(entry), flush=True)

    def items() -> Any:
        for item in source:
            start_ns[:] = start_ns or [item.timestamp_ns]
            yield item

    print(HEADER, flush=True)
    outcome = play(items(), engine, on_event)
    sys.stderr.write(f"{outcome.frames} frames, {sum(trace.counts.values())} events\n")
    return EXIT_INTERRUPTED if outcome.interrupted else 0


def _show(options: argparse.Namespace, source: FrameSource | ObservationSource, engine: Engine[Any]) -> int:
    try:
        from egotouch_sdk.cli.trace.app import TraceApp
    except ModuleNotFoundError as error:
        raise MissingExtraError("the live trace (--no-tui needs none)", "debug") from error
    from egotouch_sdk.cli.trace.entries import Trace
    from egotouch_sdk.cli.trace.player import Player

    core = _core(engine)
    until_ns = round(options.at * 1e9) if options.screenshot and options.at else None
    player = Player(source, engine, core, paced=not options.screenshot, until_ns=until_ns)
    app = TraceApp(
        Path(options.source).name,
        player,
        Trace(core.thresholds, core.config.gestures),
        frame_count=source.frame_count,
        log_file=options.log,
        screenshot_file=options.screenshot,
    )
    code = app.run(headless=bool(options.screenshot), size=options.screen if options.screenshot else None)
    if player.error:
        raise player.error
    if options.screenshot and code == 0:
        sys.stderr.write(f"saved {options.screenshot}\n")
    return code or 0


def _core(engine: Any) -> EventEngine:
    """The event engine of a pipeline, or the engine itself."""
    core: EventEngine = getattr(engine, "engine", engine)
    return core
