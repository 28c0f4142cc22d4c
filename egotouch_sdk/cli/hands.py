"""`egotouch hands`: hand landmarks of every frame, without touch."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import (
    Subparsers,
    add_command,
    add_pipeline_options,
    add_source_options,
    config_from,
    open_frames_from,
)
from egotouch_sdk.cli.output import Progress, print_json

if TYPE_CHECKING:
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.observation import HandObservation

EXAMPLES = """\
  egotouch hands photo.jpg --json        21 landmarks per hand, x and y in pixels
  egotouch hands clip.mp4                one line per frame
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `hands` to the command line."""
    parser = add_command(subparsers, "hands", "hands and their 21 landmarks in every frame", EXAMPLES)
    add_source_options(parser)
    add_pipeline_options(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object per frame on stdout")
    parser.add_argument("--progress", action="store_true", help="report progress on stderr even when that is not a terminal")
    parser.set_defaults(handler=hands)


def frame_record(frame: Frame, hands: tuple[HandObservation, ...]) -> dict[str, Any]:
    """What `--json` prints for one frame; x, y in image pixels, z in the same scale relative to the wrist."""
    return {
        "frame": frame.index,
        "timestamp_ns": frame.timestamp_ns,
        "hands": [
            {
                "hand_id": hand.hand_id,
                "handedness": hand.handedness.value,
                "score": round(float(hand.score), 4),
                "landmarks": [[round(float(value), 3) for value in joint] for joint in hand.landmarks_px],
            }
            for hand in hands
        ],
    }


def hands(options: argparse.Namespace) -> int:
    """Track hands through the source and print them."""
    from egotouch_sdk.hands.tracker import HandTracker

    config = config_from(options).hands
    with open_frames_from(options) as source:
        tracker = HandTracker(**config.model_dump())
        progress = Progress(source.frame_count, always=options.progress)
        frames = seen = 0
        for frame in source:
            found = tracker.track(frame)
            frames += 1
            seen += bool(found)
            progress.step()
            progress.clear()
            if options.json:
                print_json(frame_record(frame, found))
            else:
                words = ", ".join(f"{hand.handedness.value} #{hand.hand_id} ({hand.score:.2f})" for hand in found) or "no hands"
                print(f"frame {frame.index:>5}  {frame.timestamp_ns / 1e9:9.3f} s  {words}")
        progress.clear()
    sys.stderr.write(f"hands in {seen} of {frames} frames\n")
    return 0
