"""`egotouch train`: trains the touch model on rendered shards and exports it."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.cli.options import Subparsers, add_command, add_ray_option, positive_float, positive_int
from egotouch_sdk.errors import ConfigError, MissingExtraError

if TYPE_CHECKING:
    from egotouch_sdk.training.recipe import Recipe
    from egotouch_sdk.training.run import Machine

EXAMPLES = """\
  egotouch train --data data/patches --out out/touch
  egotouch train --data data/patches --out out/touch --resume      after an interruption
  egotouch train --data data/films --out out/memory --start-from out/touch/last.ckpt --recipe films
  egotouch train --data data/patches --out out/paper --recipe paper
  egotouch train --data data/patches --out out/touch --trunk model.safetensors     ImageNet weights that you have fetched
  egotouch train --data data/others --out out/mean --average out/a/last.ckpt out/b/last.ckpt --fit-force data/patches
  egotouch train --data data/study --out out/folds --folds 5            leave participants out, 5 models
  egotouch train --data data/study --out out/folds --folds 15 --ray auto --gpus 1       on a Ray cluster
  egotouch train --data data/patches --out out/trials --trials trials.toml --jobs 2     compare recipes

--folds and --trials run again go on where they stopped. Each run's folder gets a train.log; of those at work: out/.*.part/train.log.
A file of trials holds [recipe] for all and one [trials.NAME] each, with fields of the recipe such as epochs = 8.
"""


def add_parser(subparsers: Subparsers) -> None:
    """Add `train` to the command line."""
    parser = add_command(subparsers, "train", "train the touch model on rendered patches or films", EXAMPLES)
    parser.add_argument("--data", type=Path, required=True, metavar="DIR", help="folder of rendered .npz shards, of patches or of films")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where checkpoint, model, manifest and model card go")
    parser.add_argument(
        "--recipe",
        choices=("default", "stills", "films", "paper"),
        default="default",
        help="ours for CPUs (default), the shipped model's for a GPU (stills: patches, films: films), or the paper's",
    )
    parser.add_argument("--remember", action="store_true", help="add a memory of each finger's earlier frames (needs films)")
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
    begin.add_argument(
        "--trunk",
        type=Path,
        metavar="FILE",
        help="start the trunk from a file of ImageNet weights: timm's fastvit_t8.apple_in1k or the authors'",
    )
    begin.add_argument(
        "--average",
        type=Path,
        nargs="+",
        metavar="CKPT",
        help="no training: the mean of these runs' weights, calibrated on all of --data; one named twice counts twice",
    )
    parser.add_argument(
        "--fit-force", type=Path, metavar="DIR", help="with --average: fit the force again on these renders, by absolute error"
    )
    begin.add_argument("--folds", type=positive_int, metavar="K", help="K runs that leave out groups of participants; writes folds.json")
    begin.add_argument("--trials", type=Path, metavar="FILE.toml", help="one run for each recipe in the file, and a table of scores")
    parser.add_argument("--jobs", type=positive_int, default=1, metavar="N", help="folds or trials at a time on this machine (default 1)")
    add_ray_option(parser)
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

    recipe = {"default": Recipe, "stills": Recipe.stills, "films": Recipe.films, "paper": Recipe.paper}[options.recipe]()
    chosen = {"epochs": options.epochs, "learning_rate": options.learning_rate, "picture_px": options.picture_px, "seed": options.seed}
    recipe = replace(recipe, **{name: value for name, value in chosen.items() if value is not None})
    recipe = replace(recipe, remembers=options.remember)
    if options.fit_force and not options.average:
        raise ConfigError("--fit-force is for --average", hint="Name the checkpoint alone to fit one run: --average out/touch/last.ckpt")
    machine = Machine(options.threads, options.workers, options.max_minutes)
    if options.folds or options.trials:
        return _train_many(options, recipe, machine)
    if options.ray or options.jobs > 1:
        raise ConfigError("--ray and --jobs are for --folds and --trials", hint="A single run uses one machine")
    if options.average:
        from egotouch_sdk.training.average import average

        path = average(options.average, options.data, options.out, recipe.seed, options.fit_force)
        sys.stdout.write(f"model written to {path}\n")
        return 0
    path = run(options.data, options.out, recipe, machine, resume=options.resume, start_from=options.start_from, trunk=options.trunk)
    sys.stdout.write(f"model written to {path}\n")
    return 0


def _train_many(options: argparse.Namespace, recipe: Recipe, machine: Machine) -> int:
    """Folds or trials as jobs, then their scores as a table on stdout."""
    from egotouch_sdk.jobs.choice import open_runner
    from egotouch_sdk.training.folds import fold_scores, train_folds
    from egotouch_sdk.training.table import score_table
    from egotouch_sdk.training.trials import read_trials, train_trials, trial_scores

    trials = read_trials(options.trials, recipe) if options.trials else {}
    with closing(open_runner(options.jobs, options.ray, options.threads, options.gpus)) as runner:
        if trials:
            result = train_trials(options.data, options.out, trials, machine, runner, _report)
        else:
            result = train_folds(options.data, options.out, options.folds, recipe, machine, runner, _report)
    scores = trial_scores(options.out, trials) if trials else fold_scores(options.out)
    sys.stdout.write(score_table(scores, mean=not trials))
    return result.exit_code


def _report(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
