"""`egotouch replay`: the events of a recording again, compared with those that were recorded."""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, field
from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.cli.options import Subparsers, add_command
from egotouch_sdk.cli.output import event_line, print_json

if TYPE_CHECKING:
    from egotouch_sdk.recording import Header
    from egotouch_sdk.replay import ReplayedFrame
    from egotouch_sdk.touch_event import TouchEvent

EXAMPLES = """\
  egotouch replay session.mcap                       run the event engine again; exit code 1 if any event differs
  egotouch replay session.mcap --json                the events of now, one JSON object each
  egotouch replay session.mcap --config mine.json    what other settings would have made of it, as a diff
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `replay` to the command line."""
    parser = add_command(subparsers, "replay", "run the event engine over a recording again and compare the events", EXAMPLES)
    parser.add_argument("file", type=Path, metavar="FILE.mcap", help="a recording")
    parser.add_argument("--json", action="store_true", help="one JSON object per event of the replay on stdout")
    parser.add_argument("--config", type=Path, metavar="FILE", help="settings that replace recorded ones; the differences are shown")
    parser.set_defaults(handler=replay)


def replay(options: argparse.Namespace) -> int:
    """Replay the file; 0 when every event is the same or other settings were asked for."""
    from egotouch_sdk.recording import RecordingSource
    from egotouch_sdk.replay import replay as replayed_frames

    recording = RecordingSource(options.file)
    config = recording.config.changed_by(options.config) if options.config else None
    tally = _Tally()
    for frame in replayed_frames(recording, config):
        tally.add(frame, with_lines=config is not None)
        if options.json:
            for event in frame.replayed:
                print_json(event.to_dict())
    if not options.json:
        for line in unified_diff(tally.recorded_lines, tally.replayed_lines, "recorded", "replayed", n=0, lineterm=""):
            print(line)
    different = tally.first_difference
    verdict = "identical" if different is None else tally.verdict
    sys.stderr.write(f"{tally.replayed} events, {verdict}\n")
    if different is None or config:
        return 0
    sys.stderr.write("".join(f"  {line}\n" for line in [*_difference(different), *_circumstances(recording.header)]))
    return 1


@dataclass
class _Tally:
    """Counts of events then and now, the first frame in which they differ and, where asked for, a line for each edge."""

    recorded: int = 0
    replayed: int = 0
    first_difference: ReplayedFrame | None = None
    rounding: float | None = 0.0
    recorded_lines: list[str] = field(default_factory=list)
    replayed_lines: list[str] = field(default_factory=list)

    @property
    def verdict(self) -> str:
        """How the events differ."""
        if self.rounding is None:
            return f"different from the {self.recorded} recorded"
        return f"the same as recorded but for numbers, which differ by up to {self.rounding:.1g}"

    def add(self, frame: ReplayedFrame, *, with_lines: bool) -> None:
        self.recorded += len(frame.recorded)
        self.replayed += len(frame.replayed)
        if not frame.is_identical:
            self.first_difference = self.first_difference or frame
            rounding = frame.rounding
            self.rounding = None if self.rounding is None or rounding is None else max(self.rounding, rounding)
        if with_lines:
            self.recorded_lines += _lines(frame.recorded)
            self.replayed_lines += _lines(frame.replayed)


def _lines(events: tuple[TouchEvent, ...]) -> list[str]:
    return [event_line(event) for event in events if event.type.is_edge]


def _difference(frame: ReplayedFrame) -> list[str]:
    where = "at the end of the recording" if frame.index is None else f"in frame {frame.index}"
    changes = list(unified_diff(_details(frame.recorded), _details(frame.replayed), n=0, lineterm=""))[2:]
    return [f"first difference {where}, {frame.timestamp_ns / 1e9:.3f} s:", *(line for line in changes if not line.startswith("@@"))]


def _details(events: tuple[TouchEvent, ...]) -> list[str]:
    return [" ".join(f"{name}={value}" for name, value in event.to_dict().items()) for event in events]


def _circumstances(header: Header) -> list[str]:
    """What could explain a difference: version, settings and models, then and now."""
    from egotouch_sdk import __version__
    from egotouch_sdk.errors import ModelError
    from egotouch_sdk.recording import model_sha256

    lines = [f"recorded by egotouch {header.sdk_version}, replayed by egotouch {__version__}, with the recorded settings"]
    try:
        installed = model_sha256(header.config)
    except ModelError:
        installed = {}
    lines += [
        f"recorded with another {name}: {digest[:12]}, installed is {installed.get(name, 'none')[:12]} (a replay does not use it)"
        for name, digest in header.model_sha256.items()
        if installed.get(name) != digest
    ]
    return lines
