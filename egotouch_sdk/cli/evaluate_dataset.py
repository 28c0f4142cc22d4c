"""`egotouch evaluate dataset`: labelled recordings of a public data set, or of one's own, through the whole pipeline."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.cli.evaluate_study import add_report_options, check_report, tell
from egotouch_sdk.cli.options import Subparsers, add_command, add_pipeline_options, config_from, positive_int
from egotouch_sdk.cli.output import Progress
from egotouch_sdk.errors import ConfigError

if TYPE_CHECKING:
    from egotouch_sdk.evaluation.datasets.recording import RecordingFile

KINDS = ("palmpad", "egopressure", "folder")
EXAMPLES = """\
  egotouch evaluate dataset palmpad /data/Palmpad --report out/palmpad.html      index finger on the palm, 32 people
  egotouch evaluate dataset egopressure /data/EgoPressure --participants p_001   index presses on a pad: touch and force
  egotouch evaluate dataset folder recordings --limit 2                          your own, laid out as below

the layout `folder`:
  <participant>/<recording>/
      video.mp4        or .avi, .mov, .mkv; or a folder `frames` of pictures in natural order
      labels.csv       frame,touch[,force_n][,hover_mm]     frames count from 0, touch is 0 or 1; frames without a row are not scored
      landmarks.csv    may be missing: frame,hand,joint,x_px,y_px,z_px,x_mm,y_mm,z_mm     then the hand tracker is not needed
      about.json       may be missing: {"fps": 30, "finger": "index", "touching_hand": "right", "task": "press|drag|hover",
                                        "conditions": {"skin tone": "III", "light": "lamp"}}
"""
#: Figures on the terminal; the report has all.
SHOWN = (
    "accuracy", "tpr", "fpr", "shifted_accuracy", "aligned_accuracy", "auroc", "auprc", "click_accuracy", "onset_f1_1", "onset_f1_2",
    "onset_f1_4", "force_mae_n", "force_spearman", "soft_hard_frames", "hover_rejection", "onset_delay_ms_median",
    "false_touches_per_minute",
)  # fmt: skip


def add_parser(kinds: Subparsers) -> None:
    """Add `dataset` to `egotouch evaluate`."""
    parser = add_command(kinds, "dataset", "run labelled recordings through the whole pipeline", EXAMPLES)
    parser.add_argument("kind", choices=KINDS, metavar="KIND", help=" | ".join(KINDS))
    parser.add_argument("folder", type=Path, metavar="DIR", help="the data set's folder")
    parser.add_argument("--model", type=Path, metavar="FILE", help="touch model .onnx with its .json (default: the shipped one)")
    parser.add_argument("--participants", metavar="A,B", help="only these")
    parser.add_argument("--limit", type=positive_int, metavar="N", help="at most N recordings of each participant")
    add_pipeline_options(parser)
    add_report_options(parser)
    parser.set_defaults(handler=evaluate_dataset)


def evaluate_dataset(options: argparse.Namespace) -> int:
    """Score recordings and tell it."""
    from egotouch_sdk.evaluation.datasets.run import score_recording
    from egotouch_sdk.evaluation.study_report import Heading
    from egotouch_sdk.evaluation.summary import summarise
    from egotouch_sdk.touch import TouchModel

    check_report(options.report)
    files = _chosen(_find(options.kind, options.folder), options.participants, options.limit)
    config, model = config_from(options), TouchModel(options.model, options.threads or 1)
    progress = Progress(None, always=True)
    scores = [score_recording(file.load(), model, config, done=lambda _: progress.step()) for file in files]
    progress.clear()
    own = model.manifest
    facts = (
        ("Data", f"{options.kind}, {options.folder}"),
        ("Model", f"{own.name} {own.version}, threshold {own.down_probability:.3f}, sha256 {own.sha256[:12]}"),
    )
    heading = Heading(f"Touch model on {options.kind}", (), facts, shows_paper=False)
    tell(options, heading, summarise(scores), {"dataset": options.kind, "folder": str(options.folder), "sha256": own.sha256}, SHOWN)
    return 0


def _find(kind: str, folder: Path) -> list[RecordingFile]:
    from egotouch_sdk.evaluation.datasets.egopressure import find_egopressure
    from egotouch_sdk.evaluation.datasets.palmpad import find_palmpad
    from egotouch_sdk.evaluation.datasets.plain_folder import find_folder

    return {"palmpad": find_palmpad, "egopressure": find_egopressure, "folder": find_folder}[kind](folder)


def _chosen(files: list[RecordingFile], participants: str | None, limit: int | None) -> list[RecordingFile]:
    known = list(dict.fromkeys(file.participant for file in files))
    wanted = known if participants is None else participants.split(",")
    if unknown := [name for name in wanted if name not in known]:
        raise ConfigError(f"there is no participant {unknown[0]}", hint=f"There are: {', '.join(known)}")
    return [file for name in wanted for file in [each for each in files if each.participant == name][:limit]]
