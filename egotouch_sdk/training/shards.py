"""Reads rendered shards and splits them so that no person and no scene is on both sides."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError, SourceError
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.synthetic.camera import LightLayers

#: Hover height that stands for "far" in the hover head, in millimetres (upper end of the rendered hovers).
HOVER_MAX_MM = 30.0


@dataclass(frozen=True, slots=True)
class PatchLabel:
    """What a rendered patch shows. `hover_mm` is the gap to the skin, 0 while touching; `force_n` is 0 while hovering."""

    touch: bool
    force_n: float
    hover_mm: float
    finger: str
    place: str
    participant: int
    fitzpatrick: int
    scene: str
    r_palms: float
    theta_rad: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.force_n <= FORCE_MAX_N or self.hover_mm < 0.0 or (self.touch and self.hover_mm > 0.0):
            values = f"touch={self.touch}, force_n={self.force_n}, hover_mm={self.hover_mm}"
            raise SourceError(f"label has {values}", hint="Render the shard again")

    @classmethod
    def from_meta(cls, meta: dict[str, Any]) -> PatchLabel:
        """Read one entry of a shard's `meta`; raises `SourceError` naming a missing field."""
        try:
            touch = bool(meta["touch"])
            return cls(
                touch=touch,
                force_n=min(float(meta["force_n"]), FORCE_MAX_N) if touch else 0.0,
                hover_mm=0.0 if touch else float(meta["hover_mm"]),
                finger=str(meta["finger"]),
                place=str(meta["place"]),
                participant=int(meta["participant"]),
                fitzpatrick=int(meta["fitzpatrick"]),
                scene=str(meta["scene"]),
                r_palms=float(meta["r_palms"]),
                theta_rad=float(meta["theta_rad"]),
            )
        except KeyError as missing:
            raise SourceError(f"shard entry lacks {missing}", hint="Render the shard again with this version") from missing


@dataclass(frozen=True, slots=True)
class RenderedPatch:
    """Light layers with their label."""

    layers: LightLayers
    label: PatchLabel

    @property
    def labels(self) -> tuple[PatchLabel, ...]:
        """Of its frames: one."""
        return (self.label,)


def read_pictures(path: Path) -> tuple[list[LightLayers], list[dict[str, Any]]]:
    """The pictures of a `.npz` shard and its entries; raises `SourceError` when it is not a readable shard."""
    try:
        with path.open("rb") as file, np.load(file) as arrays:
            columns = [arrays[name] for name in ("light", "albedo", "segment", "depth_mm")]
            return [LightLayers(*parts) for parts in zip(*columns, strict=True)], json.loads(str(arrays["meta"]))
    except (OSError, ValueError, KeyError, EOFError, BadZipFile, FrameError) as problem:
        raise SourceError(f"{path.name} is not a readable shard ({problem})", hint="Delete it and render it again") from problem


def read_shard(path: Path) -> list[RenderedPatch]:
    """All patches of one shard; raises `SourceError` when it is not a readable shard."""
    pictures, metas = read_pictures(path)
    if len(pictures) != len(metas):
        raise SourceError(f"{path.name} holds {len(pictures)} pictures and {len(metas)} labels", hint="Delete it and render it again")
    return [
        RenderedPatch(layers, PatchLabel.from_meta(meta))
        for layers, meta in zip(pictures, metas, strict=True)
        if np.isfinite(layers.light).all()
    ]


def held_out(labels: Sequence[PatchLabel], share: float) -> npt.NDArray[np.bool_]:
    """Mark (N,) the patches of whole participants held out until at least `share` of all patches is reached.

    The participants with the highest numbers are taken, so that renders added between two stages of training, which bring new
    participants, never move one from training to the held-out side. With fewer than three participants whole scenes are taken instead.
    """
    participants = [label.participant for label in labels]
    _, scenes = np.unique([label.scene for label in labels], return_inverse=True)
    groups = np.array(participants) if len(set(participants)) >= 3 else scenes
    marked = np.zeros(len(labels), bool)
    for group in np.unique(groups)[:0:-1]:
        if marked.sum() >= share * len(labels):
            break
        marked |= groups == group
    return marked
