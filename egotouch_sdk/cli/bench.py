"""`egotouch bench`: milliseconds per stage and frames per second on this machine."""

from __future__ import annotations

import argparse
from itertools import islice
from pathlib import Path

from egotouch_sdk.cli.options import Subparsers, add_command, add_threads_option, positive_int, with_threads
from egotouch_sdk.cli.output import print_json
from egotouch_sdk.errors import SourceError

EXAMPLES = """\
  egotouch bench                    the demo clip at 1280x720
  egotouch bench --threads 1        on one core
  egotouch bench my_clip.mp4        a clip of your own, scaled to 1280x720
  egotouch bench --json             one JSON object
"""
#: Frames that are not counted: memory pools fill and the tracker starts in them.
WARM_UP = 10


def add_parser(subparsers: Subparsers) -> None:
    """Add `bench` to the command line."""
    parser = add_command(subparsers, "bench", "time the whole pipeline with two hands at 1280x720, stage by stage", EXAMPLES)
    parser.add_argument("source", metavar="VIDEO", nargs="?", help="a clip with two hands (default: the demo clip)")
    parser.add_argument("--frames", type=positive_int, default=300, metavar="N", help="frames to time at most (default 300)")
    add_threads_option(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object on stdout")
    parser.set_defaults(handler=bench)


def bench(options: argparse.Namespace) -> int:
    """Decode the clip into memory, run it, print the times."""
    from egotouch_sdk.benchmark import fit_720p, measure
    from egotouch_sdk.cli.demo import ASSETS
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.sources import VideoFileSource

    clip = Path(options.source) if options.source else ASSETS / "demo.mp4"
    with VideoFileSource(clip) as source:
        frames = [fit_720p(frame) for frame in islice(source, options.frames + WARM_UP)]
    if len(frames) <= WARM_UP:
        raise SourceError(f"{clip} has only {len(frames)} frames", hint=f"Give a clip of more than {WARM_UP} frames")
    config = TouchConfig(**with_threads({}, options.threads))
    report = measure(frames, config, warm_up=WARM_UP).to_dict()
    if options.json:
        print_json(report)
        return 0
    print(f"{report['machine']}")
    threads = ", ".join(f"{name} {count}" for name, count in report["threads"].items())
    print(f"{clip.name}, {report['frames']} frames at {report['width_px']}x{report['height_px']}; threads: {threads}")
    print(f"both hands in {report['two_hands_share']:.0%} of frames, {report['patches_per_frame']:.1f} fingertips looked at per frame\n")
    for stage, spent_ms in report["stage_ms"].items():
        print(f"  {stage:<10} {spent_ms:8.2f} ms")
    spread = f"median {report['frame_ms_median']:.2f}, p95 {report['frame_ms_p95']:.2f}"
    print(f"  {'whole':<10} {report['frame_ms_mean']:8.2f} ms  ({spread})\n")
    print(f"{report['fps']:.1f} frames per second")
    print(f"{report['networks_ms']:.2f} ms inside the networks, {report['outside_networks']:.1%} of the time outside them")
    return 0
