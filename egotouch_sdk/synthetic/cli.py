"""`egotouch synth`: render training patches and look at them."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

from egotouch_sdk.cli.options import add_runner_options, positive_float, positive_int, runner_from

_EXAMPLES = """examples:
  egotouch synth patches --out data/patches --series 1000   # 8,000 labelled patches; stop and restart as you like
  egotouch synth patches --out data/patches --ray auto     # the same on a Ray cluster
  egotouch synth demo --scratch data/demo --out data        # the clip that `egotouch demo` plays
  egotouch synth sheet data/patches sheet.png               # look at some of them
  egotouch synth study --out data/study                     # 15 simulated people, 36 rounds each; stop and restart as you like
  egotouch synth strip data/study strip.png                 # look at some rounds, frame by frame
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
    patches.add_argument("--participants", type=int, default=24, help="different skins (default 24)")
    patches.add_argument("--samples", type=int, default=12, help="light paths per pixel (default 12)")
    patches.add_argument("--seed", type=int, default=0)
    add_runner_options(patches)
    patches.set_defaults(handler=_patches)
    demo = commands.add_parser("demo", help="render the demo clip and its ground truth (resumable, about 20 minutes on 2 cores)")
    demo.add_argument("--scratch", type=Path, required=True, help="folder for rendered frames (about 1 GB)")
    demo.add_argument("--out", type=Path, required=True, help="folder for demo.mp4 and demo_truth.json")
    add_runner_options(demo)
    demo.set_defaults(handler=_demo)
    sheet = commands.add_parser("sheet", help="contact sheet of a folder of patches")
    sheet.add_argument("folder", type=Path)
    sheet.add_argument("picture", type=Path)
    sheet.add_argument("--rows", type=int, default=10)
    sheet.add_argument("--seed", type=int, default=0)
    sheet.set_defaults(handler=_sheet)
    _add_study(commands)


def _add_study(commands: Any) -> None:
    study = commands.add_parser("study", help="render the simulated study, rounds of a finger that moves, at 30 fps (resumable)")
    study.add_argument("--out", type=Path, required=True, help="folder for study.json and the rounds (about 500 MB for all)")
    study.add_argument("--participants", type=positive_int, default=15, help="the first of the 15 participants (default 15)")
    study.add_argument("--rounds", type=positive_int, default=36, help="rounds of each, a balanced choice of the 36 (default 36)")
    study.add_argument("--seconds", type=positive_float, default=1.2, help="length of a round (default 1.2)")
    study.add_argument("--samples", type=positive_int, default=8, help="light paths per pixel (default 8)")
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


def _report(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _patches(args: argparse.Namespace) -> int:
    from egotouch_sdk.synthetic.patches_job import PatchJob, run

    job = PatchJob(args.seed, args.series, args.participants, args.samples)
    with closing(runner_from(args)) as runner:
        result = run(job, args.out, runner, _report)
    print(f"{result.counted} new patches in {args.out}")
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

    from egotouch_sdk.synthetic.sheet import contact_sheet

    cv2.imwrite(str(args.picture), contact_sheet(args.folder, args.rows, args.seed))
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
