"""`egotouch synth`: render training patches and look at them."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

from egotouch_sdk.cli.evaluate_real import MIN_CONFIDENCE, THUMB_PX_PER_MM, THUMB_TIP_PX
from egotouch_sdk.cli.options import add_runner_options, point_px, positive_float, positive_int, runner_from
from egotouch_sdk.errors import SourceError
from egotouch_sdk.joints import Finger
from egotouch_sdk.surface import Surface

_EXAMPLES = """examples:
  egotouch synth patches --out data/patches --series 1000   # 8,000 labelled patches; stop and restart as you like
  egotouch synth films --out data/films --scenes 2000       # 48,000 frames of moving fingers
  egotouch synth patches --out data/patches --ray auto     # the same on a Ray cluster
  egotouch synth demo --scratch data/demo --out data        # the clip that `egotouch demo` plays
  egotouch synth sheet data/patches sheet.png               # look at some of them
  egotouch synth study --out data/study                     # 15 simulated people, 36 rounds each; stop and restart as you like
  egotouch synth strip data/study strip.png                 # look at some rounds, frame by frame
  egotouch synth check data/patches thumb_patches --finger thumb --place palm   # do renders look like those photographs?
"""


def add_parser(subparsers: Any) -> None:
    """Register `synth` and its own commands."""
    synth = subparsers.add_parser(
        "synth", help="render synthetic touches with exact labels", epilog=_EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = synth.add_subparsers(dest="synth_command", required=True)
    patches = commands.add_parser("patches", help="render labelled fingertip patches (resumable)")
    patches.add_argument("--out", type=Path, required=True, help="folder for the shards")
    patches.add_argument("--series", type=int, default=1000, help="scenes of 8 patches each (default 1000)")
    patches.add_argument("--participants", type=positive_int, default=24, help="different people (default 24)")
    patches.add_argument("--first-participant", type=int, default=0, metavar="N", help="number of the first of them (default 0)")
    patches.add_argument("--samples", type=int, default=12, help="light paths per pixel (default 12)")
    patches.add_argument("--seed", type=int, default=0)
    add_runner_options(patches)
    patches.set_defaults(handler=_patches)
    films = commands.add_parser("films", help="render labelled films of a moving fingertip (resumable)")
    films.add_argument("--out", type=Path, required=True, help="folder for the shards")
    films.add_argument("--scenes", type=positive_int, default=2000, help="poses of two films of 12 frames, 2 MB each (default 2000)")
    films.add_argument("--participants", type=positive_int, default=40, help="different people (default 40)")
    films.add_argument("--first-participant", type=int, default=0, metavar="N", help="number of the first of them (default 0)")
    films.add_argument("--samples", type=positive_int, default=6, help="light paths per pixel (default 6)")
    films.add_argument("--seed", type=int, default=0)
    add_runner_options(films)
    films.set_defaults(handler=_films)
    demo = commands.add_parser("demo", help="render the demo clip and its ground truth (resumable, about 20 minutes on 2 cores)")
    demo.add_argument("--scratch", type=Path, required=True, help="folder for rendered frames (about 1 GB)")
    demo.add_argument("--out", type=Path, required=True, help="folder for demo.mp4 and demo_truth.json")
    add_runner_options(demo)
    demo.set_defaults(handler=_demo)
    sheet = commands.add_parser("sheet", help="contact sheet of a folder of patches or films")
    sheet.add_argument("folder", type=Path)
    sheet.add_argument("picture", type=Path)
    sheet.add_argument("--rows", type=int, default=10)
    sheet.add_argument("--seed", type=int, default=0)
    sheet.set_defaults(handler=_sheet)
    _add_study(commands)


def _add_study(commands: Any) -> None:
    study = commands.add_parser("study", help="render the simulated study, rounds of a finger that moves, at 30 fps (resumable)")
    study.add_argument("--out", type=Path, required=True, help="folder for study.json and the rounds (about 700 MB for all)")
    study.add_argument("--participants", type=positive_int, default=15, help="the first of the 15 participants (default 15)")
    study.add_argument("--rounds", type=positive_int, default=36, help="rounds of each, a balanced choice of the 36 (default 36)")
    study.add_argument("--seconds", type=positive_float, default=3.0, help="length of a round (default 3)")
    study.add_argument("--samples", type=positive_int, default=6, help="light paths per pixel (default 6)")
    study.add_argument("--seed", type=int, default=0)
    add_runner_options(study)
    study.set_defaults(handler=_study)
    strip = commands.add_parser("strip", help="film strip of some rounds of a study")
    strip.add_argument("folder", type=Path)
    strip.add_argument("picture", type=Path)
    strip.add_argument("--rows", type=positive_int, default=12)
    strip.add_argument("--every", type=positive_int, default=2, help="frames per picture (default 2)")
    strip.add_argument("--seed", type=int, default=0)
    strip.set_defaults(handler=_strip)
    check = commands.add_parser("check", help="compare renders with real patches: sharpness, contrast, creases, colour")
    check.add_argument("renders", type=Path, help="folder of shards, seen through the training camera, or of a study")
    check.add_argument("real", type=Path, help="folder with labels.csv and finger-up pictures")
    check.add_argument("--finger", choices=[str(finger) for finger in Finger], help="only renders of that finger")
    check.add_argument("--place", choices=[str(place) for place in Surface], help="only renders on that skin")
    check.add_argument("--count", type=positive_int, default=1500, help="most renders to look at (default 1500)")
    check.add_argument("--tip", type=point_px, default=THUMB_TIP_PX, metavar="X,Y", help="TIP landmark in the pictures (default 316,175)")
    check.add_argument("--px-per-mm", type=positive_float, default=THUMB_PX_PER_MM, metavar="S", help="their scale (default 7.3)")
    check.add_argument("--min-confidence", type=positive_float, default=MIN_CONFIDENCE, metavar="C", help="of labels (default 0.7)")
    check.add_argument("--seed", type=int, default=0)
    check.set_defaults(handler=_check)


def _report(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _patches(args: argparse.Namespace) -> int:
    from egotouch_sdk.synthetic.patches_job import PatchJob, run

    job = PatchJob(args.seed, args.series, args.participants, args.samples, args.first_participant)
    with closing(runner_from(args)) as runner:
        result = run(job, args.out, runner, _report)
    print(f"{result.counted} new patches in {args.out}")
    return result.exit_code


def _films(args: argparse.Namespace) -> int:
    from egotouch_sdk.synthetic.films_job import FilmsJob, run_films

    job = FilmsJob(args.seed, args.scenes, args.participants, args.samples, args.first_participant)
    with closing(runner_from(args)) as runner:
        result = run_films(job, args.out, runner, _report)
    print(f"{result.counted} new frames in {args.out}")
    return result.exit_code


def _demo(args: argparse.Namespace) -> int:
    from egotouch_sdk.synthetic.clip import assemble_demo, render_demo

    with closing(runner_from(args)) as runner:
        if exit_code := render_demo(args.scratch, runner, _report).exit_code:
            return exit_code
    args.out.mkdir(parents=True, exist_ok=True)
    frames = assemble_demo(args.scratch, args.out / "demo.mp4", args.out / "demo_truth.json")
    print(f"{frames} frames in {args.out / 'demo.mp4'}")
    return 0


def _sheet(args: argparse.Namespace) -> int:
    import cv2

    from egotouch_sdk.synthetic.film_shards import PATTERN
    from egotouch_sdk.synthetic.sheet import contact_sheet
    from egotouch_sdk.training.film_sheet import film_sheet

    draw = film_sheet if any(args.folder.glob(PATTERN)) else contact_sheet
    cv2.imwrite(str(args.picture), draw(args.folder, args.rows, args.seed))
    print(args.picture)
    return 0


def _study(args: argparse.Namespace) -> int:
    from egotouch_sdk.synthetic.study_job import StudyJob, run_study

    job = StudyJob(args.seed, args.participants, args.rounds, args.seconds, args.samples)
    with closing(runner_from(args)) as runner:
        result = run_study(job, args.out, runner, _report)
    print(f"{result.counted} new frames in {args.out}")
    return result.exit_code


def _strip(args: argparse.Namespace) -> int:
    import cv2

    from egotouch_sdk.synthetic.strip import film_strip

    cv2.imwrite(str(args.picture), film_strip(args.folder, args.rows, args.every, args.seed))
    print(args.picture)
    return 0


def _check(args: argparse.Namespace) -> int:
    import numpy as np

    from egotouch_sdk.evaluation.real_patches import read_real_patches
    from egotouch_sdk.study_data import RECIPE_FILE
    from egotouch_sdk.synthetic.check import compare, table

    real = read_real_patches(args.real, args.tip, args.px_per_mm, args.min_confidence)
    read = _study_patches if (args.renders / RECIPE_FILE).exists() else _shard_patches
    patches, touch = read(args)
    if not len(touch):
        raise SourceError(f"no renders of that finger and place in {args.renders}", hint="Leave out --finger or --place")
    print(f"{len(touch)} renders ({int(touch.sum())} touches) against {len(real)} real patches ({sum(one.touch for one in real)} touches)")
    print(table(compare(patches, touch, np.stack([one.image for one in real]), np.array([one.touch for one in real]))))
    return 0


def _wanted(args: argparse.Namespace, finger: str, place: str) -> bool:
    return args.finger in (None, finger) and args.place in (None, place)


def _shard_patches(args: argparse.Namespace) -> tuple[Any, Any]:
    """Patches (N, 100, 100, 3) of shards, or every third frame of films, as training sees them, and their labels (N,)."""
    import numpy as np

    from egotouch_sdk.synthetic.film_shards import PATTERN
    from egotouch_sdk.training.augment import view
    from egotouch_sdk.training.films import read_films, view_film
    from egotouch_sdk.training.shards import read_shard

    files = [*args.renders.glob("shard-*.npz"), *args.renders.glob(PATTERN)]
    if not files:
        raise SourceError(f"no shards and no study in {args.renders}", hint="Render some first: egotouch synth patches --out FOLDER")
    rng = np.random.default_rng(args.seed)
    patches: list[Any] = []
    touch: list[bool] = []
    for file in rng.permutation(np.array(sorted(files))):
        if file.match(PATTERN):
            shown = [(view_film(film, rng)[0][::3], film.labels[::3]) for film in read_films(file)]
        else:
            shown = [(view(one, rng)[0][None], one.labels) for one in read_shard(file)]
        for images, labels in shown:
            if _wanted(args, labels[0].finger, labels[0].place):
                patches += list(images)
                touch += [label.touch for label in labels]
        if len(touch) >= args.count:
            break
    return np.array(patches[: args.count]), np.array(touch[: args.count], bool)


def _study_patches(args: argparse.Namespace) -> tuple[Any, Any]:
    """Every eighth frame of a study's rounds and their labels."""
    import numpy as np

    from egotouch_sdk.study_data import open_study, read_round

    files = open_study(args.renders).files
    patches: list[Any] = []
    touch: list[bool] = []
    for k in np.random.default_rng(args.seed).permutation(len(files)):
        one = read_round(files[k])
        if _wanted(args, str(one.meta.finger), str(one.meta.place)):
            patches += list(one.patches[::8])
            touch += list(one.touch[::8])
        if len(touch) >= args.count:
            break
    return np.array(patches), np.array(touch, bool)
