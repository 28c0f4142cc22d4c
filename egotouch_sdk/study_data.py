"""A study on disk: one folder, `study.json` with its recipe, and one `p03-r017.npz` per participant and round.

A round holds what the touch model would have been shown in each of its T frames, and the truth:

    patches       uint8 (T, 100, 100, 3)  RGB finger-up patches, cut as in live use; anything where the gate is closed
    polar         float32 (T, 2)          (R in palms, theta in rad) of the fingertip, (0, 0) where the host is unknown
    timestamp_ns  int64 (T,)              capture times, strictly rising
    touch         bool (T,)               True while skin is touched
    force_n       float32 (T,)            0 .. 3.5 N, 0 while hovering
    hover_mm      float32 (T,)            gap to the skin, 0 while touching
    gate          bool (T,)               False where the proximity gate was closed: nothing is shown to the model, nothing scored
    meta          JSON text               `RoundMeta`
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields
from enum import StrEnum
from math import isfinite
from pathlib import Path
from typing import Any, Self
from zipfile import BadZipFile

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import SourceError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FORCE_MAX_N, PATCH_PX
from egotouch_sdk.surface import Surface

RECIPE_FILE = "study.json"
_ROUND_NAME = re.compile(r"p\d+-r\d+\.npz")
#: A force may be above the range by this much, which is float32's rounding.
_FORCE_SLACK_N = 1e-6


class Hair(StrEnum):
    """Hair on the touched skin, the paper's four steps."""

    NIL = "nil"
    SPARSE = "sparse"
    MODERATE = "moderate"
    DENSE = "dense"


class TouchType(StrEnum):
    """What a participant was asked to do in a round; the paper's four, and drags."""

    TAP = "tap"
    LIGHT_PRESS = "light_press"
    HARD_PRESS = "hard_press"
    DRAG = "drag"
    HOVER = "hover"


@dataclass(frozen=True, slots=True, kw_only=True)
class RoundMeta:
    """Who did what where in one round.

    `participant` and `round` count from 0; `fitzpatrick` 1..6; `light` names the lighting, `lux` its illuminance or None;
    `fps` frames per second; `seed` re-creates the round; `acts` is the generator's own list of what the finger did.
    Raises `SourceError` naming a field that is out of range.
    """

    participant: int
    round: int
    fitzpatrick: int
    hair: Hair
    place: Surface
    finger: Finger
    touch_type: TouchType
    light: str
    outdoors: bool
    walking: bool
    touching_hand: Handedness
    seed: int
    fps: float
    lux: float | None = None
    acts: tuple[Mapping[str, Any], ...] = ()

    def __post_init__(self) -> None:
        ranges = {
            "participant": self.participant >= 0,
            "round": self.round >= 0,
            "fitzpatrick": 1 <= self.fitzpatrick <= 6,
            "light": bool(self.light),
            "fps": isfinite(self.fps) and self.fps > 0,
            "lux": self.lux is None or (isfinite(self.lux) and self.lux >= 0),
        }
        for name, fits in ranges.items():
            if not fits:
                raise SourceError(f"{name} of a round is {getattr(self, name)!r}", hint="Compare it with RoundMeta")

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """Read the JSON object of a round's `meta`, unknown keys ignored; raises `SourceError` naming what is missing or wrong."""
        try:
            return cls(
                participant=int(data["participant"]),
                round=int(data["round"]),
                fitzpatrick=int(data["fitzpatrick"]),
                hair=Hair(data["hair"]),
                place=Surface(data["place"]),
                finger=Finger(data["finger"]),
                touch_type=TouchType(data["touch_type"]),
                light=str(data["light"]),
                outdoors=bool(data["outdoors"]),
                walking=bool(data["walking"]),
                touching_hand=Handedness(data["touching_hand"]),
                seed=int(data["seed"]),
                fps=float(data["fps"]),
                lux=None if data.get("lux") is None else float(data["lux"]),
                acts=tuple(data.get("acts", ())),
            )
        except KeyError as missing:
            raise SourceError(f"meta of a round lacks {missing}", hint="Render the round again with this version") from missing
        except (TypeError, ValueError) as wrong:
            raise SourceError(f"meta of a round is wrong ({wrong})", hint="Compare it with RoundMeta") from wrong


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyRound:
    """One round: `meta` and arrays over its T frames, as the module describes them; read-only, T at least 1.

    Raises `SourceError` naming the array that has another shape, type or range, or contradicts `touch`.
    """

    meta: RoundMeta
    patches: npt.NDArray[np.uint8] = field(repr=False)
    polar: npt.NDArray[np.float32] = field(repr=False)
    timestamp_ns: npt.NDArray[np.int64] = field(repr=False)
    touch: npt.NDArray[np.bool_] = field(repr=False)
    force_n: npt.NDArray[np.float32] = field(repr=False)
    hover_mm: npt.NDArray[np.float32] = field(repr=False)
    gate: npt.NDArray[np.bool_] = field(repr=False)

    def __post_init__(self) -> None:
        frames = len(self.timestamp_ns)
        for name, (kind, shape) in _ARRAYS.items():
            array = np.asarray(getattr(self, name))
            if array.shape != (frames, *shape) or array.dtype != kind or not frames:
                needed = f"{np.dtype(kind)} {('T', *shape)}".replace("'", "")
                raise SourceError(f"{name} of a round is {array.dtype} {array.shape}, need {needed} with T = {frames or 'at least 1'}")
            view = array.view()
            view.flags.writeable = False
            object.__setattr__(self, name, view)
        contradictions = {
            "polar": not np.isfinite(self.polar).all(),
            "timestamp_ns": bool((np.diff(self.timestamp_ns) <= 0).any()),
            "force_n": not ((self.force_n >= 0) & (self.force_n <= FORCE_MAX_N + _FORCE_SLACK_N)).all() or self.force_n[~self.touch].any(),
            "hover_mm": not ((self.hover_mm >= 0) & np.isfinite(self.hover_mm)).all() or self.hover_mm[self.touch].any(),
        }
        if wrong := next((name for name, is_wrong in contradictions.items() if is_wrong), None):
            raise SourceError(f"{wrong} of a round is not finite, out of range or at odds with touch", hint=f"See {__name__}")

    @property
    def name(self) -> str:
        """Name of its file."""
        return round_name(self.meta.participant, self.meta.round)


_ARRAYS: dict[str, tuple[type[Any], tuple[int, ...]]] = {
    "patches": (np.uint8, (PATCH_PX, PATCH_PX, 3)),
    "polar": (np.float32, (2,)),
    "timestamp_ns": (np.int64, ()),
    "touch": (np.bool_, ()),
    "force_n": (np.float32, ()),
    "hover_mm": (np.float32, ()),
    "gate": (np.bool_, ()),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyRecipe:
    """What `study.json` says: all that is needed to make the study again.

    `participants` and `rounds` (per participant) are counts, `seconds_per_round` the length of one; `sizes` has sizes in pixels by
    name, for example {"frame_px": [960, 720]}; `details` whatever else the generator wants to tell.
    """

    seed: int
    fps: float
    participants: int
    rounds: int
    seconds_per_round: float
    sizes: Mapping[str, Any] = field(default_factory=dict)
    details: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("fps", "participants", "rounds", "seconds_per_round"):
            if not getattr(self, name) > 0:
                raise SourceError(f"{RECIPE_FILE}: {name} is {getattr(self, name)!r}, need more than 0")


@dataclass(frozen=True, slots=True)
class Study:
    """A study's folder: its recipe and the files of the rounds that are there, in the order of their names."""

    folder: Path
    recipe: StudyRecipe
    files: tuple[Path, ...]

    @property
    def expected(self) -> int:
        """Number of rounds the recipe promises."""
        return self.recipe.participants * self.recipe.rounds

    def files_of(self) -> dict[int, tuple[Path, ...]]:
        """The files by participant."""
        by_number: dict[int, tuple[Path, ...]] = {}
        for file in self.files:
            number = int(file.name[1:].partition("-")[0])
            by_number[number] = (*by_number.get(number, ()), file)
        return by_number

    def rounds(self) -> Iterator[StudyRound]:
        """Read one round after another."""
        return map(read_round, self.files)


def round_name(participant: int, number: int) -> str:
    """File name of a round, for example `p03-r017.npz`."""
    return f"p{participant:02d}-r{number:03d}.npz"


def write_recipe(folder: Path, recipe: StudyRecipe) -> Path:
    """Write `study.json` into a folder, which is made if need be."""
    folder.mkdir(parents=True, exist_ok=True)
    content = json.dumps(asdict(recipe), indent=2, allow_nan=False) + "\n"
    return _put(folder / RECIPE_FILE, lambda path: path.write_text(content, encoding="utf-8"))


def write_round(folder: Path, study_round: StudyRound) -> Path:
    """Write one round into a study's folder under its own name; a reader never sees it half done."""
    arrays = {name: getattr(study_round, name) for name in _ARRAYS}
    meta = json.dumps({**asdict(study_round.meta), "acts": list(study_round.meta.acts)}, allow_nan=False)

    def save(path: Path) -> None:
        with path.open("wb") as file:
            np.savez_compressed(file, meta=np.array(meta), **arrays)

    return _put(folder / study_round.name, save)


def read_round(path: Path) -> StudyRound:
    """Read one round; raises `SourceError` naming the file when it is not one."""
    hint = "Delete it and render it again"
    try:
        with path.open("rb") as file, np.load(file) as arrays:
            content = {name: arrays[name] for name in _ARRAYS}
            meta = json.loads(str(arrays["meta"]))
    except (OSError, ValueError, KeyError, EOFError, BadZipFile) as problem:
        raise SourceError(f"{path} is not a readable round of a study ({problem})", hint=hint) from problem
    try:
        study_round = StudyRound(meta=RoundMeta.from_dict(meta), **content)
    except SourceError as problem:
        raise SourceError(f"{path}: {problem.message}", hint=problem.hint or hint) from problem
    if study_round.name != path.name:
        raise SourceError(f"{path} holds the round {study_round.name}", hint="Give it that name, or delete it")
    return study_round


def open_study(folder: Path) -> Study:
    """Find a study's recipe and rounds; raises `SourceError` when there is none, or no round yet."""
    path = folder / RECIPE_FILE
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        known = {item.name for item in fields(StudyRecipe)}
        recipe = StudyRecipe(**{name: value for name, value in content.items() if name in known})
    except OSError as problem:
        raise SourceError(f"there is no readable {RECIPE_FILE} in {folder}", hint="Give the folder of a study") from problem
    except (ValueError, TypeError, AttributeError) as problem:
        raise SourceError(f"{path} is not the recipe of a study ({problem})", hint="Compare it with StudyRecipe") from problem
    files = tuple(sorted(file for file in folder.iterdir() if _ROUND_NAME.fullmatch(file.name)))
    if not files:
        raise SourceError(f"there is no round in {folder}", hint="Rounds are called p00-r000.npz and so on")
    return Study(folder, recipe, files)


def _put(path: Path, write: Callable[[Path], object]) -> Path:
    scratch = path.with_suffix(f".{os.getpid()}.tmp")
    try:
        write(scratch)
        scratch.replace(path)
    finally:
        scratch.unlink(missing_ok=True)
    return path
