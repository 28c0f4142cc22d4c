"""`egotouch train`: trains the touch model on rendered shards and exports it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from egotouch_sdk.cli.options import Subparsers, add_command, positive_float, positive_int
from egotouch_sdk.errors import MissingExtraError

EXAMPLES = """\
  egotouch train --data data/patches --out out/touch
  egotouch train --data data/patches --out out/touch --resume      after an interruption
  egotouch train --data data/patches --out out/paper --recipe paper
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `train` to the command line."""
    parser = add_command(subparsers, "train", "train the touch model on rendered patches", EXAMPLES)
    parser.add_argument("--data", type=Path, required=True, metavar="DIR", help="folder of rendered .npz shards")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where checkpoint, model, manifest and model card go")
    parser.add_argument("--recipe", choices=("default", "paper"), default="default", help="our recipe, or the paper's without additions")
    parser.add_argument("--epochs", type=positive_int, metavar="N", help="passes over the renders, each with new cameras")
    parser.add_argument(
        "--picture-px", type=positive_int, metavar="N", help="size of the pictures, smaller = faster first stage (default 100)"
    )
    parser.add_argument("--learning-rate", type=positive_float, metavar="X", help="largest learning rate")
    parser.add_argument("--seed", type=int, metavar="N", help="seed of weights, order and cameras")
    parser.add_argument("--threads", type=positive_int, default=2, metavar="N", help="threads of the network (default 2)")
    parser.add_argument("--workers", type=positive_int, default=1, metavar="N", help="processes that make pictures (default 1)")
    parser.add_argument("--max-minutes", type=positive_float, metavar="X", help="stop after this time and export")
    begin = parser.add_mutually_exclusive_group()
    begin.add_argument("--resume", action="store_true", help="continue the run whose checkpoint is in --out")
    begin.add_argument("--start-from", type=Path, metavar="CKPT", help="start from the weights of another run's checkpoint")
    parser.set_defaults(handler=train)


def train(options: argparse.Namespace) -> int:
    """Train, export, print where the model is."""
    try:
        from egotouch_sdk.training.recipe import Recipe
        from egotouch_sdk.training.run import Machine
        from egotouch_sdk.training.run import train as run
    except ImportError as missing:
        raise MissingExtraError("training", "train") from missing
    from dataclasses import replace

    recipe = Recipe.paper() if options.recipe == "paper" else Recipe()
    chosen = {"epochs": options.epochs, "learning_rate": options.learning_rate, "picture_px": options.picture_px, "seed": options.seed}
    recipe = replace(recipe, **{name: value for name, value in chosen.items() if value is not None})
    machine = Machine(options.threads, options.workers, options.max_minutes)
    path = run(options.data, options.out, recipe, machine, resume=options.resume, start_from=options.start_from)
    sys.stdout.write(f"model written to {path}\n")
    return 0
