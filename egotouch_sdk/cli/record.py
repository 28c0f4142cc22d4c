"""`egotouch record`: what perception finds in any source, and the events of it, in a file that can be replayed."""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from egotouch_sdk.cli.options import (
    Subparsers,
    add_command,
    add_pipeline_options,
    add_source_options,
    engine_from,
    open_frames_from,
    open_from,
)
from egotouch_sdk.cli.output import Progress
from egotouch_sdk.cli.play import play

if TYPE_CHECKING:
    from egotouch_sdk.recording import Header
    from egotouch_sdk.sources import FrameSource, ObservationSource

EXAMPLES = """\
  egotouch record 0 -o session.mcap                  the first camera until Ctrl-C; landmarks and events, no pictures
  egotouch record clip.mp4 -o clip.mcap --video      with the pictures as JPEG, to look at in Foxglove
  egotouch record taps.yaml -o taps.mcap             a simulator script
  egotouch replay session.mcap                       the same events again, byte for byte
"""

T = TypeVar("T")


def add_parser(subparsers: Subparsers) -> None:
    """Add `record` to the command line."""
    parser = add_command(subparsers, "record", "record landmarks, touch estimates and events into an MCAP file", EXAMPLES)
    add_source_options(parser)
    parser.add_argument("-o", "--output", type=_mcap_path, required=True, metavar="FILE.mcap", help="the file to write")
    parser.add_argument("--video", action="store_true", help="record the pictures too; without it no picture leaves the program")
    parser.add_argument("--force", action="store_true", help="overwrite the file if it exists")
    parser.add_argument("--progress", action="store_true", help="report progress on stderr even when that is not a terminal")
    add_pipeline_options(parser)
    parser.set_defaults(handler=record)


def record(options: argparse.Namespace) -> int:
    """Play the source until its end or Ctrl-C, and record everything."""
    from egotouch_sdk.cli.main import EXIT_INTERRUPTED
    from egotouch_sdk.recording import RecordedEngine, Recorder

    with open_frames_from(options) if options.video else open_from(options) as source:
        engine = engine_from(options, source)
        with Recorder(options.output, _header(options, engine, source), overwrite=options.force) as recorder, _Interrupt() as interrupt:
            progress = Progress(source.frame_count, always=options.progress)
            recorded = RecordedEngine(engine, recorder, with_video=options.video)
            outcome = play(interrupt.until(source), recorded, lambda _: None, lambda *_: progress.step())
            progress.clear()
    interrupted = outcome.interrupted or interrupt.came
    if recorder.frames == 0:
        options.output.unlink()
        sys.stderr.write("no frames, nothing recorded\n")
    else:
        size = f"{recorder.size_bytes / 1000:,.0f} kB"
        sys.stderr.write(f"recorded {recorder.frames} frames and {recorder.events} events in {options.output} ({size})\n")
    return EXIT_INTERRUPTED if interrupted else 0


def _mcap_path(text: str) -> Path:
    path = Path(text)
    if path.suffix != ".mcap":
        raise argparse.ArgumentTypeError(f"{text!r} does not end in .mcap")
    return path


def _header(options: argparse.Namespace, engine: Any, source: FrameSource | ObservationSource) -> Header:
    from egotouch_sdk import clock
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.recording import Header, RecordingSource, model_sha256

    inner = engine.engine if isinstance(engine, TouchPipeline) else engine
    if isinstance(source, RecordingSource):
        models = source.header.model_sha256
    else:
        models = model_sha256(inner.config) if isinstance(engine, TouchPipeline) else {}
    name = Path(options.source).name
    return Header(inner.config, inner.thresholds, models, source=name, fps=source.fps, created_unix_ms=clock.unix_ms())


class _Interrupt:
    """Makes the first Ctrl-C end an iteration between two frames, so that none is half written; a second one acts at once."""

    came = False

    def until(self, items: Iterable[T]) -> Iterator[T]:
        """The items, up to the first Ctrl-C."""
        for item in items:
            yield item
            if self.came:
                return

    def _note(self, *_: object) -> None:
        self.came = True
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def __enter__(self) -> _Interrupt:
        self._is_main = threading.current_thread() is threading.main_thread()
        if self._is_main:
            self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_main:
            signal.signal(signal.SIGINT, self._before)
