"""`egotouch estimate`: touch and force for single finger-up pictures."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.cli.options import Subparsers, add_command, positive_float, positive_int
from egotouch_sdk.cli.output import print_json

if TYPE_CHECKING:
    from egotouch_sdk.observation import FingertipPatch

EXAMPLES = """\
  egotouch estimate crop.png --tip 64,64 --px-per-mm 3.2 --json
  egotouch estimate crops/*.png --tip 64,64 --px-per-mm 3.2        many pictures of the same kind

Every picture is judged alone, also by a model that remembers a finger's earlier frames; `egotouch run` and `egotouch evaluate` show it
films.
"""
#: Pictures per call of the network: enough to fill it, small enough for little memory.
BATCH = 32


def tip_px(text: str) -> tuple[float, float]:
    """`64,64.5` as a point, for argparse."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form X,Y") from None
    return x, y


def add_parser(subparsers: Subparsers) -> None:
    """Add `estimate` to the command line."""
    summary = "touch probability and force for pictures of a fingertip that points up, each judged alone"
    parser = add_command(subparsers, "estimate", summary, EXAMPLES)
    parser.add_argument("images", metavar="IMAGE", nargs="+", type=Path, help="pictures in which the finger points up")
    parser.add_argument("--tip", required=True, type=tip_px, metavar="X,Y", help="the fingertip in image pixels from the top left")
    parser.add_argument("--px-per-mm", required=True, type=positive_float, metavar="S", help="image pixels per millimetre at the fingertip")
    parser.add_argument("--left", action="store_true", help="the touching hand is a left hand")
    parser.add_argument("--model", type=Path, metavar="FILE.onnx", help="another touch model, its .json manifest beside it")
    parser.add_argument("--threads", type=positive_int, default=1, metavar="N", help="threads of the network (default 1)")
    parser.add_argument("--json", action="store_true", help="one JSON object per image on stdout")
    parser.set_defaults(handler=estimate)


def cut(path: Path, tip: tuple[float, float], px_per_mm: float, left: bool) -> FingertipPatch:
    """The model's patch of one picture; the place on the host is unknown."""
    from egotouch_sdk.errors import FrameError
    from egotouch_sdk.joints import Finger, Handedness
    from egotouch_sdk.observation import FingertipPatch
    from egotouch_sdk.patches import cut_patch
    from egotouch_sdk.sources import read_image

    image = read_image(path)
    height, width = image.shape[:2]
    if not (0 <= tip[0] < width and 0 <= tip[1] < height):
        raise FrameError(f"the tip {tip[0]:g},{tip[1]:g} is outside {path} ({width}x{height} px)", hint="Give --tip in its pixels")
    pixels = cut_patch(image, tip, (0.0, -1.0), px_per_mm, left)
    side = Handedness.LEFT if left else Handedness.RIGHT
    return FingertipPatch(hand_id=0, handedness=side, finger=Finger.INDEX, tip_px=tip, px_per_mm=px_per_mm, image=pixels)


def estimate(options: argparse.Namespace) -> int:
    """Run the touch model over the pictures and print its answers."""
    from egotouch_sdk.touch import TouchModel

    model = TouchModel(options.model, options.threads)
    for start in range(0, len(options.images), BATCH):
        files = options.images[start : start + BATCH]
        patches = [cut(file, options.tip, options.px_per_mm, options.left) for file in files]
        for file, answer in zip(files, model.estimate(patches), strict=True):
            probability, force_n = round(answer.touch_probability, 4), round(answer.force_n, 3)
            if options.json:
                print_json({"file": str(file), "touch_probability": probability, "force_n": force_n})
            else:
                print(f"{file}  touch {probability:.3f}  force {force_n:.2f} N")
    return 0
