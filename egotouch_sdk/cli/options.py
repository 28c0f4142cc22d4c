"""Options that several commands share, and what they build."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.config_presets import PRESET_NAMES

if TYPE_CHECKING:
    from egotouch_sdk.cli.play import Engine
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.jobs import Runner
    from egotouch_sdk.sources import FrameSource, ObservationSource

Subparsers = Any  # argparse's own type for it is private


def add_command(subparsers: Subparsers, name: str, summary: str, examples: str) -> argparse.ArgumentParser:
    """A subcommand whose help ends with examples."""
    parser: argparse.ArgumentParser = subparsers.add_parser(
        name,
        help=summary,
        description=summary[0].upper() + summary[1:] + ".",
        epilog=f"examples:\n{examples}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    return parser


SOURCE_HELP = "camera index (0), URL, video, image, folder of images, recording or script"


def add_source_options(parser: argparse.ArgumentParser) -> None:
    """SOURCE, --fps and --size."""
    parser.add_argument("source", metavar="SOURCE", help=SOURCE_HELP)
    add_picture_options(parser)


def add_named_source_options(parser: argparse.ArgumentParser) -> None:
    """SOURCE or --source SOURCE, --fps and --size; the handler has to refuse a missing source."""
    parser.add_argument("source", metavar="SOURCE", nargs="?", default=argparse.SUPPRESS, help=SOURCE_HELP)
    parser.add_argument("--source", metavar="SOURCE", help="the same")
    add_picture_options(parser)


def add_picture_options(parser: argparse.ArgumentParser) -> None:
    """--fps and --size."""
    parser.add_argument("--fps", type=positive_float, help="rate of a folder (default 30), in place of a video's own, or asked of a camera")
    parser.add_argument("--size", type=size_px, metavar="WxH", help="image size to ask of a camera, for example 1280x720")


def add_pipeline_options(parser: argparse.ArgumentParser) -> None:
    """--mirrored, --threads, --config and --preset."""
    parser.add_argument("--mirrored", action="store_true", help="the picture is a mirror image, as from a selfie camera")
    add_threads_option(parser)
    add_config_option(parser)


def add_config_option(parser: argparse.ArgumentParser) -> None:
    """--config and --preset."""
    parser.add_argument("--config", type=Path, metavar="FILE", help="settings as .toml or .json; `egotouch config` prints them all")
    parser.add_argument("--preset", choices=PRESET_NAMES, help="a set of settings to begin with")


def add_threads_option(parser: argparse.ArgumentParser) -> None:
    """--threads."""
    parser.add_argument("--threads", type=positive_int, metavar="N", help="threads for the hand networks and for the touch network")


def add_runner_options(parser: argparse.ArgumentParser) -> None:
    """--workers, --ray and --gpus."""
    parser.add_argument("--workers", type=positive_int, default=os.cpu_count() or 1, metavar="N", help="processes (default: all cores)")
    add_ray_option(parser)


def add_ray_option(parser: argparse.ArgumentParser) -> None:
    """--ray and --gpus."""
    parser.add_argument("--ray", metavar="ADDRESS", help="work on a Ray cluster: HOST:PORT, auto, or local to start one on this machine")
    parser.add_argument("--gpus", type=positive_float, default=0.0, metavar="X", help="with --ray: GPUs per task, 0.5 = two share one")


def runner_from(options: argparse.Namespace) -> Runner:
    """What carries out the tasks of a batch: processes of this machine, or a Ray cluster where one was named."""
    from egotouch_sdk.jobs.choice import open_runner

    return open_runner(options.workers, options.ray, gpus=options.gpus)


def positive_int(text: str) -> int:
    """A whole number above zero, for argparse."""
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number above 0")
    return int(text)


def port_number(text: str) -> int:
    """A TCP port, 0 for any free one, for argparse."""
    if not text.isdigit() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port (0 to 65535)")
    return int(text)


def add_view_options(parser: argparse.ArgumentParser) -> None:
    """--save and --port."""
    parser.add_argument("--save", type=Path, metavar="FILE.mp4", help="write the annotated view to a video file")
    parser.add_argument("--port", type=port_number, default=0, help="port of the live view on 127.0.0.1 (default: a free one)")


def positive_float(text: str) -> float:
    """A number above zero, for argparse."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return value


def size_px(text: str) -> tuple[int, int]:
    """`1280x720` as (1280, 720), for argparse."""
    width, separator, height = text.lower().partition("x")
    if not separator:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form WIDTHxHEIGHT")
    return positive_int(width), positive_int(height)


def point_px(text: str) -> tuple[float, float]:
    """`316,175` as (316.0, 175.0), for argparse."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form X,Y") from error
    return x, y


def open_from(options: argparse.Namespace) -> FrameSource | ObservationSource:
    """The source that the command line names."""
    from egotouch_sdk.sources import open_source

    return open_source(options.source, **_asked_of_source(options))


def open_frames_from(options: argparse.Namespace) -> FrameSource:
    """The source of camera frames that the command line names; `SourceError` for one without pictures."""
    from egotouch_sdk.sources import open_frames

    return open_frames(options.source, **_asked_of_source(options))


def _asked_of_source(options: argparse.Namespace) -> dict[str, Any]:
    width_px, height_px = options.size or (None, None)
    return {"fps": options.fps, "width_px": width_px, "height_px": height_px}


def engine_from(options: argparse.Namespace, source: FrameSource | ObservationSource) -> Engine[Any]:
    """What turns the items of `source` into events: a whole pipeline for pictures, the event engine for observations.

    Observations that carry their own settings are replayed with them unless the command line names others.
    """
    from egotouch_sdk.sources import ObservationSource

    if isinstance(source, ObservationSource):
        from egotouch_sdk.engine import THRESHOLDS, EventEngine

        own = None if options.config or options.preset else source.config
        return EventEngine(own or config_from(options), source.thresholds or THRESHOLDS)
    from egotouch_sdk.pipeline import TouchPipeline

    return TouchPipeline(config_from(options))


def config_from(options: argparse.Namespace) -> TouchConfig:
    """Settings of the preset, then the config file, then the environment, then the command line; the last one counts."""
    from egotouch_sdk.config import TouchConfig

    flags: dict[str, Any] = {"hands": {"mirrored": True}} if options.mirrored else {}
    overrides = with_threads(flags, options.threads)
    return TouchConfig.load(options.config, preset=options.preset, environ=os.environ, overrides=overrides)


def with_threads(settings: dict[str, Any], threads: int | None) -> dict[str, Any]:
    """Settings in which every network has `threads` threads; None leaves them as they are."""
    if threads is None:
        return settings
    return settings | {section: {**settings.get(section, {}), "threads": threads} for section in ("hands", "touch")}
