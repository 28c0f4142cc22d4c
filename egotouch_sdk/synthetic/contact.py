"""Contact of a fingertip with soft skin, solved on height fields in the tangent plane.

The finger sinks by `k F^(2/3)` (Hertz; Flynn 2011 gives 0.44-1.45 N/mm for the forearm). The sinking is shared
between skin and pad; outside the contact the skin is a membrane on an elastic bed (screened Laplace equation),
with an incompressible bulge around the dimple. Metres and newtons.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from scipy.ndimage import map_coordinates
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from egotouch_sdk.synthetic.linalg import Array, Indices, Mask, smoothstep

_HALF_M = 0.030
_STEP_M = 0.0006
_SOLVE_HALF_M = 0.024
_SOLVE_STEP_M = 0.0008


@dataclass(frozen=True, slots=True)
class Tissue:
    """Mechanics of one contact: `stiffness_mm` (mm per N^(2/3)), the skin's share 0..1, membrane length (m), bulge 0..1."""

    stiffness_mm: float
    skin_share: float
    membrane_m: float
    bulge: float

    def sink_m(self, force_n: float) -> float:
        """Approach of finger and limb after first contact, in metres."""
        return self.stiffness_mm * 1e-3 * force_n ** (2.0 / 3.0)


def draw_tissue(rng: np.random.Generator, place: str) -> Tissue:
    """Random mechanics for a place; means from the trial fit to photos (palm sinks 3-5 mm, the bony back half of that)."""
    stiffness = {"palm": 3.7, "back_of_hand": 2.0, "inner_forearm": 3.7, "outer_forearm": 3.0}[place]
    share = {"palm": 0.68, "back_of_hand": 0.42, "inner_forearm": 0.68, "outer_forearm": 0.6}[place]
    return Tissue(
        stiffness * float(np.exp(rng.normal(0, 0.2))),
        float(np.clip(share + rng.normal(0, 0.06), 0.3, 0.85)),
        float(np.exp(rng.uniform(np.log(0.001), np.log(0.005)))),
        float(rng.uniform(0.25, 0.75)),
    )


class HeightField:
    """Height over the tangent plane from points (n, 3) in the contact frame: their mean or their minimum per cell."""

    def __init__(self, points: Array, lowest: bool) -> None:
        size = int(2 * _HALF_M / _STEP_M) + 1
        cell = np.round((points[:, :2] + _HALF_M) / _STEP_M).astype(int)
        keep = ((cell >= 0) & (cell < size)).all(1)
        i, j, z = cell[keep, 0], cell[keep, 1], points[keep, 2]
        self._grid = self._lowest(size, i, j, z) if lowest else self._mean(size, i, j, z)

    @staticmethod
    def _mean(size: int, i: Indices, j: Indices, z: Array) -> Array:
        total, count = np.zeros((size, size)), np.zeros((size, size))
        np.add.at(total, (i, j), z)
        np.add.at(count, (i, j), 1.0)
        fine_t, fine_c = cv2.GaussianBlur(total, (0, 0), 0.7), cv2.GaussianBlur(count, (0, 0), 0.7)
        wide_t, wide_c = cv2.GaussianBlur(total, (0, 0), 2.0), cv2.GaussianBlur(count, (0, 0), 2.0)
        wide = np.where(wide_c > 0.01, wide_t / np.maximum(wide_c, 1e-9), np.nan)
        return np.where(fine_c > 0.05, fine_t / np.maximum(fine_c, 1e-9), wide)

    @staticmethod
    def _lowest(size: int, i: Indices, j: Indices, z: Array) -> Array:
        grid = np.full((size, size), 1e3)
        np.minimum.at(grid, (i, j), z)
        grid = np.where(grid > 1e2, cv2.erode(grid, np.ones((3, 3))), grid)
        known = grid < 1e2
        weight = cv2.GaussianBlur(known.astype(float), (0, 0), 0.8)
        smooth = cv2.GaussianBlur(np.where(known, grid, 0.0), (0, 0), 0.8) / np.maximum(weight, 1e-9)
        return np.where(known, smooth, np.nan)

    def at(self, x: Array, y: Array) -> Array:
        """Bilinear height at x, y (any shape); NaN where nothing is known."""
        coords = np.stack([(x.ravel() + _HALF_M) / _STEP_M, (y.ravel() + _HALF_M) / _STEP_M])
        return np.asarray(map_coordinates(self._grid, coords, order=1, mode="constant", cval=np.nan).reshape(x.shape))


def _membrane(depth: Array, contact: Mask, length_m: float) -> Array:
    """Solve (1 - L^2 laplacian) d = 0 outside the contact, d = depth inside, 0 on the border."""
    n = len(depth)
    index = np.arange(n * n).reshape(n, n)
    free = np.zeros((n, n), bool)
    free[1:-1, 1:-1] = ~contact[1:-1, 1:-1]
    k2 = (length_m / _SOLVE_STEP_M) ** 2
    f, fixed = index[free], index[~free]
    rows = np.concatenate([f, f, f, f, f, fixed])
    cols = np.concatenate([f, f + n, f - n, f + 1, f - 1, fixed])
    vals = np.concatenate([np.full(len(f), 4 * k2 + 1), np.full(4 * len(f), -k2), np.ones(len(fixed))])
    rhs = np.zeros(n * n)
    rhs[index[contact]] = depth[contact]
    return np.asarray(spsolve(coo_matrix((vals, (rows, cols)), shape=(n * n, n * n)).tocsc(), rhs).reshape(n, n))


@dataclass(frozen=True, slots=True)
class Dent:
    """The solved contact: `depth` (n, n) of the skin in metres on a grid, the dented skin's height, the contact radius."""

    depth: Array
    surface: Array
    radius_m: float

    @property
    def depth_max_m(self) -> float:
        """Deepest point of the dimple in metres."""
        return float(self.depth.max())

    @staticmethod
    def _sample(grid: Array, points: Array, outside: float) -> Array:
        coords = ((points[:, :2] + _SOLVE_HALF_M) / _SOLVE_STEP_M).T
        return np.asarray(map_coordinates(grid, coords, order=1, mode="constant", cval=outside))

    def depth_at(self, points: Array) -> Array:
        """Skin displacement along the inward normal at points (n, 3) of the contact frame, in metres."""
        return self._sample(self.depth, points, 0.0)

    def surface_at(self, points: Array) -> Array:
        """Height of the dented skin at points (n, 3) of the contact frame, -1 where unknown."""
        return self._sample(self.surface, points, -1.0)


def solve_dent(skin: HeightField, finger: HeightField, tissue: Tissue) -> Dent:
    """Dent of the skin under a finger that already overlaps it."""
    q = np.arange(-_SOLVE_HALF_M, _SOLVE_HALF_M + 1e-6, _SOLVE_STEP_M)
    x, y = np.meshgrid(q, q, indexing="ij")
    height = skin.at(x, y)
    overlap = np.nan_to_num(np.maximum(0.0, height - finger.at(x, y)), nan=0.0)
    contact = overlap > 1e-6
    pressed = tissue.skin_share * overlap
    near, wide = _membrane(pressed, contact, tissue.membrane_m), _membrane(pressed, contact, 2 * tissue.membrane_m)
    depth = (1 + tissue.bulge) * near - tissue.bulge * wide
    depth[contact] = pressed[contact]
    depth = np.asarray(cv2.GaussianBlur(depth, (0, 0), 0.7), np.float64)
    radius = float(np.sqrt(contact.sum() * _SOLVE_STEP_M**2 / np.pi))
    return Dent(depth, np.nan_to_num(height - depth, nan=-1.0), radius)


def press_pad(points: Array, normals_up: Array, dent: Dent, sink_m: float) -> tuple[Array, Array]:
    """How the pad gives way: lift along the normal (n,) and outward bulge (n,) in metres, for pad points in the contact frame."""
    surface = dent.surface_at(points)
    overlap = np.maximum(0.0, surface - points[:, 2])
    lift = np.where(normals_up < 0.3, overlap + 2e-5 * (overlap > 0), 0.0)
    above = points[:, 2] - surface
    bulge = 0.17 * sink_m * np.exp(-(((above - 0.0015) / 0.002) ** 2)) * (above > 0) * (surface > -0.5)
    return lift, bulge


def dent_weight(normals_up: Array, points: Array) -> Array:
    """How much of the dent each skin point takes (0 on the far side of the limb); arrays (n,), (n, 3)."""
    return smoothstep(-0.2, 0.3, normals_up) * smoothstep(-0.02, -0.012, points[:, 2])
