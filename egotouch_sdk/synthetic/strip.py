"""A film strip of study rounds, to look at before believing them."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.study_data import StudyRound, open_study, read_round

_HOVER_BGR, _TOUCH_BGR, _TEXT_BGR = (255, 200, 60), (60, 230, 60), (235, 235, 235)
_LINE_PX = 16


def film_strip(folder: Path, rows: int = 12, every: int = 2, seed: int = 0) -> npt.NDArray[np.uint8]:
    """`rows` random rounds of a study, one a row, every `every`-th frame: blue numbers are mm of hover, green ones newtons.

    Returns a BGR picture. Raises `SourceError` when there is no study or no round.
    """
    files = open_study(folder).files
    chosen = np.random.default_rng(seed).permutation(len(files))[:rows]
    strips = [round_strip(read_round(files[k]), every) for k in sorted(chosen)]
    width = max(strip.shape[1] for strip in strips)
    return np.vstack([cv2.copyMakeBorder(strip, 0, 0, 0, width - strip.shape[1], cv2.BORDER_CONSTANT) for strip in strips])


def round_strip(one: StudyRound, every: int) -> npt.NDArray[np.uint8]:
    """One round as a row of frames under a line that says what it is; BGR."""
    cells = []
    for k in range(0, len(one.touch), every):
        cell = np.ascontiguousarray(one.patches[k][..., ::-1])
        text = f"{one.force_n[k]:.1f}" if one.touch[k] else f"{one.hover_mm[k]:.0f}"
        cv2.putText(cell, text, (2, 11), cv2.FONT_HERSHEY_SIMPLEX, 0.36, _TOUCH_BGR if one.touch[k] else _HOVER_BGR, 1, cv2.LINE_AA)
        cells.append(cell)
    row = np.hstack(cells)
    meta = one.meta
    title = np.zeros((_LINE_PX, row.shape[1], 3), np.uint8)
    facts = (
        f"p{meta.participant} r{meta.round}",
        f"skin {meta.fitzpatrick}",
        f"hair {meta.hair}",
        meta.finger,
        meta.place,
        meta.touch_type,
        meta.light,
        "walking" if meta.walking else "still",
    )
    cv2.putText(title, "  ".join(facts), (2, 12), cv2.FONT_HERSHEY_SIMPLEX, 0.4, _TEXT_BGR, 1, cv2.LINE_AA)
    return np.vstack([title, row]).astype(np.uint8)
