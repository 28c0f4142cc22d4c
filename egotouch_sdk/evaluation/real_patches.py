"""Real finger-up pictures with eye labels: reading them, and scores of a touch model's answers to them."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.bootstrap import DRAWS, Indices, interval_of_recordings
from egotouch_sdk.evaluation.darkness import darkness
from egotouch_sdk.evaluation.metrics import Floats, auroc, spearman, touch_scores
from egotouch_sdk.observation import TouchEstimate
from egotouch_sdk.patches import cut_patch

LABELS_FILE = "labels.csv"
COLUMNS = ("file", "recording", "frame", "label", "label_confidence", "force_sensor_counts")
#: Least sensor reading that is a force, not the sensor's floor (our measurement: from 10 counts it agrees with the eye in 90 %).
FLOOR_COUNTS = 10.0


@dataclass(frozen=True, slots=True)
class RealPatch:
    """One labelled picture.

    `frame` is its number in the film of its recording, None where it has no whole number. `sensor_counts` is the raw force sensor
    reading, nan where there is none. `scored` is False for a picture that only comes before others in a film.
    """

    file: str
    recording: str
    frame: int | None
    touch: bool
    sensor_counts: float
    image: npt.NDArray[np.uint8]
    scored: bool = True


def read_real_patches(
    folder: Path,
    tip_px: tuple[float, float],
    px_per_mm: float,
    min_confidence: float,
    finger_up: tuple[float, float] = (0.0, -1.0),
    *,
    history: bool = False,
) -> list[RealPatch]:
    """Pictures of a folder with `labels.csv`, labelled touch or hover with at least the given confidence, cut around the tip.

    With `history` the other pictures come too, in their places and not to be scored. The pictures lie in the folder itself or in its
    `image` folder. `tip_px` is the TIP landmark in every picture, `px_per_mm` its scale.
    Raises `SourceError` for a missing file or column, an unreadable picture, or when nothing is left.
    """
    table = folder / LABELS_FILE
    if not table.is_file():
        raise SourceError(f"there is no {LABELS_FILE} in {folder}", hint=f"It needs the columns {', '.join(COLUMNS)}")
    with table.open(newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        missing = sorted(set(COLUMNS) - set(reader.fieldnames or ()))
        if missing:
            raise SourceError(f"{table} lacks the columns {', '.join(missing)}")
        every = [(row, row["label"] in ("touch", "hover") and _number(row["label_confidence"]) >= min_confidence) for row in reader]
    if not any(scored for _, scored in every):
        raise SourceError(f"{table} has no touch or hover labelled with confidence {min_confidence} or more")
    return [
        RealPatch(
            row["file"],
            row["recording"],
            _whole(row["frame"]),
            row["label"] == "touch",
            _number(row["force_sensor_counts"]),
            cut_patch(_read(folder, row["file"]), tip_px, finger_up, px_per_mm, False),
            scored,
        )
        for row, scored in every
        if scored or history
    ]


def real_report(patches: Sequence[RealPatch], estimates: Sequence[TouchEstimate], threshold: float, draws: int = DRAWS) -> dict[str, Any]:
    """Scores of the pictures to be scored, pooled and per recording, the trivial darkness rule beside the model.

    Shares are 0..1, None where undefined.

    `*_interval` are 95 % bootstraps: within a recording by stretches of frames, pooled by recordings and stretches within them.
    `force_spearman` is over all touches with a sensor reading, `force_spearman_above_floor` over those that the sensor felt.
    """
    scored = [pair for pair in zip(patches, estimates, strict=True) if pair[0].scored]
    recordings = sorted({patch.recording for patch, _ in scored})
    parts = {name: [pair for pair in scored if pair[0].recording == name] for name in recordings}
    return {
        "threshold": threshold,
        "pooled": _scores(list(parts.values()), threshold, draws),
        "recordings": {name: _scores([part], threshold, draws) for name, part in parts.items()},
    }


def _scores(parts: Sequence[Sequence[tuple[RealPatch, TouchEstimate]]], threshold: float, draws: int) -> dict[str, Any]:
    pairs = [pair for part in parts for pair in part]
    touch = np.array([patch.touch for patch, _ in pairs])
    counts = np.array([patch.sensor_counts for patch, _ in pairs])
    probability = np.array([estimate.touch_probability for _, estimate in pairs])
    force_n = np.array([estimate.force_n for _, estimate in pairs])
    rule = darkness(np.stack([patch.image for patch, _ in pairs]))
    called = probability >= threshold

    def interval(figure: Callable[[Indices], float]) -> list[float] | None:
        low, high = interval_of_recordings([len(part) for part in parts], figure, draws=draws)
        return None if math.isnan(low) else [round(low, 4), round(high, 4)]

    def rank(score: Floats, rows: Indices) -> float:
        return auroc(touch[rows], score[rows]) if touch[rows].any() and not touch[rows].all() else math.nan

    def force_rank(least: float, rows: Indices) -> float:
        rows = rows[touch[rows] & (counts[rows] >= least)]
        return spearman(force_n[rows], counts[rows])

    everything = np.arange(len(pairs))
    scores: dict[str, Any] = {"touches": int(touch.sum()), "hovers": int((~touch).sum())}
    if touch.any() and not touch.all():
        model = touch_scores(touch, probability, threshold)
        scores["auroc"], scores["auroc_interval"] = round(model.auroc, 4), interval(partial(rank, probability))
        scores["darkness_auroc"], scores["darkness_auroc_interval"] = round(auroc(touch, rule), 4), interval(partial(rank, rule))
        scores["true_positive_rate"] = round(model.true_positive_rate, 4)
        scores["false_positive_rate"] = round(model.false_positive_rate, 4)
    scores["accuracy"] = round(float((called == touch).mean()), 4)
    scores["accuracy_interval"] = interval(lambda rows: float((called[rows] == touch[rows]).mean()))
    for name, least in (("force_spearman", -math.inf), ("force_spearman_above_floor", FLOOR_COUNTS)):
        correlation = force_rank(least, everything)
        scores[name] = None if math.isnan(correlation) else round(correlation, 4)
        scores[f"{name}_interval"] = None if math.isnan(correlation) else interval(partial(force_rank, least))
    return scores


def _number(text: str | None) -> float:
    try:
        return float(text or "nan")
    except ValueError:
        return float("nan")


def _whole(text: str | None) -> int | None:
    try:
        return int(text or "")
    except ValueError:
        return None


def _read(folder: Path, name: str) -> npt.NDArray[np.uint8]:
    for path in (folder / name, folder / "image" / name):
        if path.is_file():
            image = cv2.imread(str(path), cv2.IMREAD_COLOR)
            if image is None:
                raise SourceError(f"{path} is not a readable picture", hint="Delete its row or replace the file")
            return np.asarray(image, np.uint8)
    raise SourceError(f"{name} is in {LABELS_FILE} but not in {folder} or its image folder")
