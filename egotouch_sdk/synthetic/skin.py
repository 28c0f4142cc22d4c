"""Skin of one synthetic person, baked per vertex of both hand rigs and kept in the cache folder."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.synthetic.assets import cache_dir
from egotouch_sdk.synthetic.creases import carve_finger_creases, carve_palm, carve_wrist
from egotouch_sdk.synthetic.hair import hair_cover, spots
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.nails import mark_nails
from egotouch_sdk.synthetic.noise import cell_borders, noise
from egotouch_sdk.synthetic.skin_colour import paint
from egotouch_sdk.synthetic.skin_side import Relief, SkinSide
from egotouch_sdk.synthetic.skin_traits import SkinTraits, draw_traits

#: Raise when the look of baked skin changes: cached identities of other versions are ignored.
SKIN_VERSION = 3
#: Share of the carved relief that is kept: at full strength renders showed twice the contrast of photographs.
_RELIEF_SHARE = 0.85


@dataclass(frozen=True, slots=True, eq=False)
class BakedSide:
    """One hand's skin: `vertices` (n, 3) float32 rest positions in metres, `albedo` (n, 3) linear RGB 0..1, `roughness` (n,) and masks.

    `nail` is the plate, `edge` its free end, `palmar` the palm side; each (n,) in 0..1.
    """

    vertices: npt.NDArray[np.float32]
    albedo: npt.NDArray[np.float32]
    roughness: npt.NDArray[np.float32]
    nail: npt.NDArray[np.float32]
    edge: npt.NDArray[np.float32]
    palmar: npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class SkinIdentity:
    """One synthetic person: traits and both baked hands, `sides["left"]` and `sides["right"]`, before `scale` is applied."""

    seed: int
    level: int
    traits: SkinTraits
    sides: Mapping[str, BakedSide]

    @property
    def scale(self) -> float:
        """Size of the person's hands relative to the asset's (0.88..1.1)."""
        return self.traits.scale

    @property
    def fatness_m(self) -> float:
        """Thickness added along the normals in metres, already in the vertices."""
        return self.traits.fatness_m

    @property
    def fitzpatrick(self) -> float:
        """Skin type 1..6."""
        return self.traits.fitzpatrick

    @property
    def polished(self) -> bool:
        """True when the nails are painted (they do not blanch)."""
        return self.traits.polish is not None


def identity_path(seed: int, traits: SkinTraits, level: int = 4) -> Path:
    """Where the baked skin of person `seed` with `traits` is cached."""
    folder = cache_dir() / "skin"
    folder.mkdir(exist_ok=True)
    digest = hashlib.sha256(repr(traits).encode()).hexdigest()[:10]
    return folder / f"v{SKIN_VERSION}-s{seed}-f{traits.fitzpatrick:.2f}-{digest}-l{level}.npz"


def bake_identity(seed: int, fitzpatrick: float, level: int = 4) -> SkinIdentity:
    """The skin of person `seed` with skin type `fitzpatrick` (1..6, fractions allowed) and traits drawn from both.

    See `bake_person`. Raises `ValueError` for a type outside 1..6.
    """
    return bake_person(seed, draw_traits(seed, fitzpatrick), level)


def bake_person(seed: int, traits: SkinTraits, level: int = 4) -> SkinIdentity:
    """The skin of person `seed` with `traits`, from the cache or baked now.

    Equal arguments give equal skin. `level` is the rig's number of subdivisions. Raises `SourceError` and `MissingExtraError` when
    the hand meshes cannot be had.
    """
    path = identity_path(seed, traits, level)
    if not path.is_file():
        _store(path, {side: bake_side(HandRig(side, level), seed, traits) for side in Handedness})
    return _load(path, seed, level, traits)


def bake_side(rig: HandRig, seed: int, traits: SkinTraits) -> BakedSide:
    """Carve and paint one hand."""
    side = SkinSide(rig, int(np.random.default_rng([seed, 2, int(rig.side is Handedness.RIGHT)]).integers(1 << 30)))
    relief = Relief(len(rig.vertices))
    nails = mark_nails(side, relief, traits.nail_length)
    carve_finger_creases(side, relief, traits.creases)
    carve_palm(side, relief, traits.creases)
    carve_wrist(side, relief, traits.creases)
    _carve_texture(side, relief, nails.nail)
    vein = _veins(side, traits.veins)
    relief.height_m += 0.00035 * vein * (1 - side.palmar)

    tree = cKDTree(side.points)
    pigment = spots(side, tree, traits.freckles, traits.moles)
    hair = hair_cover(side, tree, traits.hair, _vertex_area_mm2(rig)) * (1 - nails.nail)
    albedo = paint(side, traits, relief, nails, vein, pigment, hair)
    roughness = traits.roughness + 0.06 * side.noise(0.004, 420)
    roughness = roughness * (1 - nails.nail) + (0.2 if traits.polish is not None else 0.3) * nails.nail
    height = _RELIEF_SHARE * relief.height_m + traits.fatness_m + traits.finger_fatness_m * _phalanges(rig)
    return BakedSide(
        vertices=(rig.vertices + rig.normals * height[:, None]).astype(np.float32),
        albedo=albedo.astype(np.float32),
        roughness=np.clip(roughness + 0.15 * np.clip(relief.dark, 0, 1), 0.15, 0.9).astype(np.float32),
        nail=nails.nail.astype(np.float32),
        edge=nails.edge.astype(np.float32),
        palmar=side.palmar.astype(np.float32),
    )


def _carve_texture(side: SkinSide, relief: Relief, nail: Array) -> None:
    """Fine furrows (1.3 and 3.4 mm cells, shallower on the palm), ridges, and the soft unevenness of flesh."""
    furrow = 0.8 * np.exp(-((cell_borders(side.points, 0.0013, side.seed + 400) / 0.22) ** 2))
    furrow += 0.6 * np.exp(-((cell_borders(side.points, 0.0034, side.seed + 401) / 0.12) ** 2))
    relief.height_m -= furrow * (0.00006 - 0.00003 * side.palmar) * (1 - nail)
    relief.height_m += 0.00001 * side.noise(0.0011, 402)
    relief.height_m += (1 - nail) * (0.00045 * side.noise(0.011, 403) + 0.00006 * side.noise(0.004, 404))
    relief.dark += 0.05 * furrow * (1 - nail)


def _veins(side: SkinSide, strength: float) -> Array:
    """Mask (n,) of branching veins on the back of the hand and the forearm: ridges of stretched noise."""
    points = side.points
    stretched = noise(points * [1, 1, 0.45], 0.011, side.seed + 405)
    ridge = np.exp(-(((stretched + 0.25 * side.noise(0.006, 406)) / 0.28) ** 2)) * smoothstep(-0.2, 0.3, side.noise(0.03, 407))
    return np.asarray(strength * ridge * np.where(points[:, 2] > 0.02, 1.0, 1 - side.palmar) * (points[:, 2] > -0.085))


def _phalanges(rig: HandRig) -> Array:
    """How much each vertex belongs to a phalanx, (n,) in 0..1; metacarpals and the forearm count as 0."""
    joints = [joint for finger in Finger for joint in rig.finger_joint_ids(finger)[1:]]
    return np.asarray(rig.weights[:, joints].sum(axis=1), np.float64).ravel()


def _vertex_area_mm2(rig: HandRig) -> float:
    corners = rig.vertices[rig.faces]
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return float(doubled.sum() / 2 * 1e6 / len(rig.vertices))


def _store(path: Path, sides: Mapping[str, BakedSide]) -> None:
    arrays: dict[str, npt.NDArray[np.generic]] = {}
    for side, baked in sides.items():
        arrays[f"{side}_vertices"] = baked.vertices
        arrays[f"{side}_albedo"] = baked.albedo.astype(np.float16)
        arrays[f"{side}_roughness"] = baked.roughness.astype(np.float16)
        for mask in ("nail", "edge", "palmar"):
            arrays[f"{side}_{mask}"] = np.round(getattr(baked, mask) * 255).astype(np.uint8)
    scratch = path.with_suffix(f".{os.getpid()}.tmp.npz")
    np.savez(scratch, **arrays)  # type: ignore[arg-type]
    scratch.replace(path)


def _load(path: Path, seed: int, level: int, traits: SkinTraits) -> SkinIdentity:
    with np.load(path) as stored:
        sides: dict[str, BakedSide] = {
            side: BakedSide(
                vertices=stored[f"{side}_vertices"],
                albedo=stored[f"{side}_albedo"].astype(np.float32),
                roughness=stored[f"{side}_roughness"].astype(np.float32),
                **{mask: stored[f"{side}_{mask}"].astype(np.float32) / np.float32(255) for mask in ("nail", "edge", "palmar")},
            )
            for side in Handedness
        }
    return SkinIdentity(seed, level, traits, sides)
