"""Rings, watches, bands and sleeves: painted on baked skin and raised along its normals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Array, Mask, smoothstep
from egotouch_sdk.synthetic.skin import BakedSide
from egotouch_sdk.synthetic.skin_side import SkinSide
from egotouch_sdk.synthetic.srgb import srgb_to_linear

Srgb = tuple[int, int, int]
#: Centre of a watch or band on the forearm: distance from the wrist joint towards the elbow.
WATCH_AT_M = 0.022
_BAND_HALF_M, _BAND_HEIGHT_M, _CASE_HEIGHT_M = 0.010, 0.0024, 0.0075
_RING_HEIGHT_M = 0.0013
_CLOTH_M, _HEM_M = 0.003, 0.0012
_EDGE_M = 0.0005


@dataclass(frozen=True, slots=True)
class Ring:
    """A ring on the first bone of a finger, `width_mm` wide."""

    hand: Handedness
    finger: Finger
    width_mm: float
    colour: Srgb


@dataclass(frozen=True, slots=True)
class Watch:
    """A band round the receiving wrist; with a round `dial` of `diameter_mm` on the back of the wrist unless `dial` is None."""

    band: Srgb
    dial: Srgb | None
    diameter_mm: float

    @property
    def reach_m(self) -> float:
        """How far from `WATCH_AT_M` it covers the arm."""
        return max(_BAND_HALF_M, self.diameter_mm / 2000)


@dataclass(frozen=True, slots=True)
class Sleeve:
    """A sleeve that ends `end_m` from the wrist joint, with `stripe_mm` wide stripes of a second colour (0: plain)."""

    end_m: float
    colour: Srgb
    stripe: Srgb
    stripe_mm: float


Item = Ring | Watch | Sleeve


@dataclass(frozen=True, slots=True)
class _Layer:
    """Something worn: `cover` (n,) 0..1, `height_m` (n,) above the skin, linear `colour` (n, 3), `roughness`."""

    cover: Array
    height_m: Array
    colour: Array
    roughness: float


def dress(rig: HandRig, skin: BakedSide, items: Sequence[Item], seed: int) -> BakedSide:
    """`skin` of the rig's hand with `items` on it, the later over the earlier; rings of the other hand are left out."""
    side = SkinSide(rig, seed)
    height, albedo, roughness = np.zeros(len(rig.vertices)), skin.albedo.astype(np.float64), skin.roughness.astype(np.float64)
    nail = skin.nail
    for item in items:
        if isinstance(item, Ring):
            if item.hand is not rig.side:
                continue
            layer = _ring(side, item)
        else:
            layer = _watch(side, item) if isinstance(item, Watch) else _sleeve(side, item)
        cover = layer.cover[:, None]
        height = np.maximum(height, layer.height_m)
        albedo = albedo * (1 - cover) + layer.colour * cover
        roughness = roughness * (1 - layer.cover) + layer.roughness * layer.cover
        nail = nail * (1 - layer.cover).astype(np.float32)
    return replace(
        skin,
        vertices=(skin.vertices + rig.normals * height[:, None]).astype(np.float32),
        albedo=np.clip(albedo, 0.004, 0.95).astype(np.float32),
        roughness=roughness.astype(np.float32),
        nail=nail,
    )


def covers(items: Sequence[Item], at_m: Array, margin_m: float) -> bool:
    """True when a watch or sleeve comes within `margin_m` of a point of the arm, given in the wrist frame (3,), +z to the elbow."""
    z = float(at_m[2])
    return any(
        (isinstance(item, Sleeve) and z > item.end_m - margin_m)
        or (isinstance(item, Watch) and abs(z - WATCH_AT_M) < item.reach_m + margin_m)
        for item in items
    )


def _flat(colour: Srgb, count: int) -> Array:
    return np.tile(srgb_to_linear(np.array(colour)), (count, 1))


def _ring(side: SkinSide, ring: Ring) -> _Layer:
    count = len(side.rig.vertices)
    joints = side.rig.finger_joint_ids(ring.finger)
    frame = side.rig.bind[joints[1]]
    local = (side.rig.vertices - frame[:3, 3]) @ frame[:3, :3]
    bone_m = float(np.linalg.norm(side.rig.bind[joints[2], :3, 3] - frame[:3, 3]))
    on_finger: Mask = np.asarray(side.rig.finger_weight(ring.finger) > 0.6)
    off_m = np.abs(local[:, 2] + 0.62 * bone_m) - ring.width_mm / 2000
    cover = smoothstep(_EDGE_M, -_EDGE_M, off_m) * on_finger
    dome = np.sqrt(np.clip(-off_m / (ring.width_mm / 2000), 0, 1))
    return _Layer(cover, _RING_HEIGHT_M * cover * (0.6 + 0.4 * dome), _flat(ring.colour, count), 0.22)


def _watch(side: SkinSide, watch: Watch) -> _Layer:
    points = side.points
    off_m = np.abs(points[:, 2] - WATCH_AT_M) - _BAND_HALF_M
    band = smoothstep(_EDGE_M, -_EDGE_M, off_m)
    height, colour = _BAND_HEIGHT_M * band, _flat(watch.band, len(points))
    if watch.dial is None:
        return _Layer(band, height, colour, 0.6)
    on_arm = np.abs(points[:, 2] - WATCH_AT_M) < 0.05
    middle_x = float(points[on_arm, 0].mean())
    radius_m = watch.diameter_mm / 2000
    from_middle = np.hypot(points[:, 0] - middle_x, points[:, 2] - WATCH_AT_M)
    case = smoothstep(radius_m + _EDGE_M, radius_m - _EDGE_M, from_middle) * (side.normals_in_wrist[:, 1] > 0.2) * on_arm
    glass = smoothstep(radius_m - 0.0025, radius_m - 0.003, from_middle)[:, None] * case[:, None]
    rim = colour * (1 - case[:, None]) + 0.55 * case[:, None]
    colour = rim * (1 - glass) + srgb_to_linear(np.array(watch.dial)) * glass
    return _Layer(np.maximum(band, case), np.maximum(height, _CASE_HEIGHT_M * case), colour, 0.35)


def _sleeve(side: SkinSide, sleeve: Sleeve) -> _Layer:
    z = side.points[:, 2] + 0.0025 * side.noise(0.035, 950)
    inside_m = z - sleeve.end_m
    cover = smoothstep(-_EDGE_M, _EDGE_M, inside_m)
    hem = cover * smoothstep(0.012, 0.011, inside_m)
    folds = 0.0014 * side.noise(0.02, 951) + 0.0006 * side.noise(0.008, 952)
    height = cover * np.maximum(_CLOTH_M + _HEM_M * hem + folds * smoothstep(0.0, 0.02, inside_m), 0.001)
    colour = _flat(sleeve.colour, len(z))
    if sleeve.stripe_mm > 0:
        striped = (np.floor(inside_m / (sleeve.stripe_mm * 1e-3)) % 2 > 0)[:, None]
        colour = np.where(striped, srgb_to_linear(np.array(sleeve.stripe)), colour)
    weave = 1 + 0.10 * side.noise(0.0012, 953) + 0.06 * side.noise(0.01, 954)
    seam = 1 - 0.3 * np.exp(-(((inside_m - 0.011) / 0.0006) ** 2))
    return _Layer(cover, height, colour * (weave * seam)[:, None], 0.85)
