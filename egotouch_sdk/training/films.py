"""Reads shards of rendered films, and shows a film through one random camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import SourceError
from egotouch_sdk.patches import HOST_UNKNOWN, PATCH_PX_PER_MM
from egotouch_sdk.synthetic.air import in_the_air
from egotouch_sdk.synthetic.camera import LightLayers, photograph_film
from egotouch_sdk.synthetic.camera_settings import MAX_SHIFT_PX, MAX_TURN_RAD, SCALE_RANGE, CameraSettings
from egotouch_sdk.synthetic.head_motion import HeadMotion
from egotouch_sdk.synthetic.study_round import MAX_CAMERA_PX, MAX_FINGER_PX, bounded
from egotouch_sdk.synthetic.tracker_error import draw_tracker_error
from egotouch_sdk.training.augment import FLIP_SHARE, HOST_UNKNOWN_SHARE, POLAR_JITTER, draw_camera
from egotouch_sdk.training.shards import HOVER_MAX_MM, PatchLabel, read_pictures

#: Exposure times in seconds, each factor equally likely: from sun to a dim room (our choice).
_EXPOSURE_S = (1 / 1000, 1 / 35)
_WALKING_SHARE = 0.25
#: What a tracker misses by for the whole of a film, beside what changes in it: tip in mm, direction in rad, log scale (our choice).
_LASTING_MM, _LASTING_RAD, _LASTING_SCALE = 1.0, 0.05, (0.02, 0.10)


@dataclass(frozen=True, slots=True, eq=False)
class RenderedFilm:
    """A rendered film of T frames: `layers` of the pictures that differ, `shown` (T,) which of them each frame shows.

    `labels` (T) say what is true of each frame, `velocity_px` (T, 2) is the tip's, in px per second at 2.5 px/mm, right and down.
    """

    layers: tuple[LightLayers, ...]
    shown: tuple[int, ...]
    labels: tuple[PatchLabel, ...]
    velocity_px: npt.NDArray[np.float64]
    fps: float

    def __post_init__(self) -> None:
        frames = len(self.shown)
        if not frames or len(self.labels) != frames or self.velocity_px.shape != (frames, 2) or not self.fps > 0:
            raise SourceError(f"a film has {frames} frames, {len(self.labels)} labels, {self.fps} fps", hint="Render the shard again")
        if min(self.shown) < 0 or max(self.shown) >= len(self.layers):
            raise SourceError(f"a film shows picture {max(self.shown)} of {len(self.layers)}", hint="Render the shard again")

    @property
    def label(self) -> PatchLabel:
        """The first frame's label: who touches where holds for all."""
        return self.labels[0]


def read_films(path: Path) -> list[RenderedFilm]:
    """All films of one `.npz` shard; raises `SourceError` when it is not a readable shard of films."""
    pictures, metas = read_pictures(path)
    try:
        return [_film(pictures, meta) for meta in metas]
    except (KeyError, ValueError) as problem:
        raise SourceError(f"{path.name} is not a readable shard of films ({problem})", hint="Delete it and render it again") from problem


def _film(pictures: list[LightLayers], meta: dict[str, Any]) -> RenderedFilm:
    frames = zip(meta["touch"], meta["force_n"], meta["hover_mm"], meta["polar"], strict=True)
    labels = [
        PatchLabel.from_meta({**meta, "touch": touch, "force_n": force_n, "hover_mm": hover_mm, "r_palms": r, "theta_rad": theta})
        for touch, force_n, hover_mm, (r, theta) in frames
    ]
    first = int(meta["first"])
    layers = tuple(pictures[first : first + int(meta["pictures"])])
    return RenderedFilm(layers, tuple(meta["shown"]), tuple(labels), np.array(meta["velocity_px"], np.float64), float(meta["fps"]))


def before_clutter(film: RenderedFilm, rng: np.random.Generator) -> RenderedFilm:
    """The film with clutter in the host's place; only for films without a touch."""
    seed = int(rng.integers(1 << 62))
    layers = tuple(in_the_air(picture, np.random.default_rng(seed)) for picture in film.layers)
    return replace(film, layers=layers, labels=tuple(replace(label, hover_mm=HOVER_MAX_MM) for label in film.labels))


def view_film(
    film: RenderedFilm, rng: np.random.Generator, ordinary: bool = False, chosen: Sequence[int] | None = None
) -> tuple[npt.NDArray[np.uint8], npt.NDArray[np.float32]]:
    """Frames of the film through one random camera: patches uint8 (T, 100, 100, 3) RGB and (r_palms, theta_rad) float32 (T, 2).

    `ordinary` as in `draw_camera`; `chosen` are the numbers of the frames, in order, None for all.
    Camera, light and skin tone are drawn once, the tracker's error and the noise for each frame; smears follow the true motion.
    """
    frames = _frames(film, draw_camera(rng, ordinary), rng)
    chosen = range(len(frames)) if chosen is None else chosen
    images = np.stack(photograph_film([film.layers[film.shown[k]] for k in chosen], [_settings_at(*frames[k]) for k in chosen], rng))
    polar = np.array([(film.labels[k].r_palms, film.labels[k].theta_rad) for k in chosen])
    polar = polar * [np.exp(rng.normal(0, POLAR_JITTER[0])), 1.0] + [0.0, rng.normal(0, POLAR_JITTER[1])]
    if rng.random() < FLIP_SHARE:
        images, polar = np.ascontiguousarray(images[:, :, ::-1]), polar * [1.0, -1.0]
    if rng.random() < HOST_UNKNOWN_SHARE:
        polar = np.tile(HOST_UNKNOWN, (len(polar), 1))
    polar[:, 1] = (polar[:, 1] + pi) % (2 * pi) - pi
    return images, polar.astype(np.float32)


def _frames(film: RenderedFilm, drawn: CameraSettings, rng: np.random.Generator) -> list[tuple[CameraSettings, npt.NDArray[np.float64]]]:
    """The camera and the values that change, (T, 8): shift x and y, turn, scale, smear of the finger, smear of the picture."""
    count, scale_mean, scale_spread = len(film.shown), *_LASTING_SCALE
    error = draw_tracker_error(rng, count, film.fps)
    shift = (error.tip_mm + rng.normal(0, _LASTING_MM, 2)) * PATCH_PX_PER_MM
    turn = error.turn_rad + rng.normal(0, _LASTING_RAD)
    scale = np.clip(error.scale * np.exp(rng.normal(scale_mean, scale_spread)), *SCALE_RANGE)[:, None]
    exposure_s = float(np.exp(rng.uniform(*np.log(_EXPOSURE_S))))
    times_s = np.arange(count) / film.fps
    head = HeadMotion(rng, bool(rng.random() < _WALKING_SHARE))
    head_px = (head.at(times_s + exposure_s / 2) - head.at(times_s - exposure_s / 2)) * [1, -1] * PATCH_PX_PER_MM
    changing = np.column_stack([shift * scale, turn, scale, film.velocity_px * exposure_s * scale, head_px * scale])
    return [(drawn, row) for row in changing]


def _settings_at(drawn: CameraSettings, row: npt.NDArray[np.float64]) -> CameraSettings:
    x, y = np.clip(row[:2], -MAX_SHIFT_PX, MAX_SHIFT_PX)
    return replace(
        drawn,
        shift_px=(float(x), float(y)),
        turn_rad=float(np.clip(row[2], -MAX_TURN_RAD, MAX_TURN_RAD)),
        scale=float(row[3]),
        finger_motion_px=bounded(row[4:6], MAX_FINGER_PX),
        camera_motion_px=bounded(row[6:8], MAX_CAMERA_PX),
    )
