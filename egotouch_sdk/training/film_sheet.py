"""A contact sheet of rendered films as training sees them, to look at before training on them."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import SourceError
from egotouch_sdk.synthetic.film_shards import PATTERN
from egotouch_sdk.training.films import RenderedFilm, read_films, view_film

_HOVER_BGR, _TOUCH_BGR = (255, 200, 60), (60, 230, 60)


def film_sheet(folder: Path, rows: int = 10, seed: int = 0) -> npt.NDArray[np.uint8]:
    """`rows` random films, one a row, each through one random camera: blue numbers are mm of hover, green ones newtons.

    Returns a BGR picture. Raises `SourceError` when there are no films.
    """
    files = sorted(folder.glob(PATTERN))
    if not files:
        raise SourceError(f"no films in {folder}", hint="Render some first: egotouch synth films --out FOLDER")
    rng = np.random.default_rng(seed)
    lines = []
    for _ in range(rows):
        films = read_films(files[rng.integers(len(files))])
        lines.append(_row(films[rng.integers(len(films))], rng))
    return np.vstack(lines)


def _row(film: RenderedFilm, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    cells = []
    for image, label in zip(view_film(film, rng)[0], film.labels, strict=True):
        text, colour = (f"{label.force_n:.1f}", _TOUCH_BGR) if label.touch else (f"{label.hover_mm:.0f}", _HOVER_BGR)
        cell = np.ascontiguousarray(image[..., ::-1])
        cells.append(cv2.putText(cell, text, (2, 11), cv2.FONT_HERSHEY_SIMPLEX, 0.36, colour, 1, cv2.LINE_AA))
    return np.hstack(cells).astype(np.uint8)
