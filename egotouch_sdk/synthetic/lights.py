"""Light of one scene in three separable groups: a key lamp or sun, bright windows and lamps, and the room itself.

Light adds up, so one render that carries each group in its own colour channel can be re-lit at will afterwards.
Each group is scaled so that a white surface in the open, facing along `normal`, reads 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.synthetic.linalg import Array, unit

_ROWS, _COLS = 64, 128
KEY_DISTANCE_M = 2.5
#: Least light on the receiving skin, relative to a surface that faces the light: nobody uses skin in its own shade (our choice).
_LEAST_SHARE = 0.45


@dataclass(frozen=True, slots=True)
class Lights:
    """`key_direction` (3,) unit and `key_radius_rad` (half angle); `windows`, `room` (64, 128) radiance; `rotation` (3, 3) of the map."""

    kind: str
    key_direction: Array
    key_radius_rad: float
    windows: npt.NDArray[np.float32]
    room: npt.NDArray[np.float32]
    rotation: Array

    @property
    def key_radiance(self) -> float:
        """Radiance that lights a white surface facing the lamp to 1 (irradiance pi)."""
        return float(1.0 / np.sin(self.key_radius_rad) ** 2)


def _map_directions() -> Array:
    theta = (np.arange(_ROWS) + 0.5) / _ROWS * np.pi
    phi = (np.arange(_COLS) + 0.5) / _COLS * 2 * np.pi
    sin = np.sin(theta)[:, None]
    return np.stack([np.sin(phi) * sin, np.cos(theta)[:, None] * np.ones(_COLS), -np.cos(phi) * sin], -1)


def _irradiance(radiance: npt.NDArray[np.float32], normal: Array) -> float:
    theta = (np.arange(_ROWS) + 0.5) / _ROWS * np.pi
    solid_angle = np.sin(theta)[:, None] * (np.pi / _ROWS) * (2 * np.pi / _COLS)
    return float((radiance * np.maximum(_map_directions() @ normal, 0.0) * solid_angle).sum() / np.pi)


def _room(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    room = np.full((_ROWS, _COLS), rng.uniform(0.15, 0.6))
    room[: _ROWS // 3] = rng.uniform(0.4, 1.0)
    room[2 * _ROWS // 3 :] = rng.uniform(0.02, 0.3)
    for _ in range(12):
        y, x, h, w = rng.integers(0, _ROWS), rng.integers(0, _COLS), rng.integers(4, 20), rng.integers(6, 30)
        room[y : y + h, x : x + w] *= np.exp(rng.normal(0, 0.5))
    return room.astype(np.float32)


def _windows(rng: np.random.Generator) -> npt.NDArray[np.float32]:
    sky = np.zeros((_ROWS, _COLS), np.float32)
    for _ in range(rng.integers(1, 4)):
        y, x, h, w = rng.integers(0, _ROWS * 7 // 16), rng.integers(0, _COLS), rng.integers(3, 18), rng.integers(4, 26)
        sky[y : y + h, (x + np.arange(w)) % _COLS] += rng.uniform(0.4, 1.0)
    return sky


def _main_direction(radiance: npt.NDArray[np.float32]) -> Array:
    weight = radiance * np.sin((np.arange(_ROWS) + 0.5) / _ROWS * np.pi)[:, None]
    return unit((_map_directions() * weight[..., None]).sum((0, 1)))


def _soften(image: npt.NDArray[np.float32], sigma: float) -> npt.NDArray[np.float32]:
    return np.asarray(cv2.GaussianBlur(image, (0, 0), sigma, borderType=cv2.BORDER_REFLECT), np.float32)


def draw_lights(rng: np.random.Generator, normal: Array, up: Array, view: Array) -> Lights:
    """Random light for skin with `normal`, seen from `view` with `up` in the image (unit vectors of the scene).

    The key is a bare sun (0.27 deg half angle), a bulb or a panel; the world's up lies between the image's and the camera's.
    """
    world_up = unit(0.6 * up + 0.7 * view + rng.normal(0, 0.15, 3))
    side = unit(np.cross(world_up, [0.3, 0.1, 0.9]))
    rotation = np.stack([side, world_up, np.cross(side, world_up)], 1)
    forward = np.cross(world_up, side)
    azimuth, elevation = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(18, 80))
    key = np.sin(elevation) * world_up + np.cos(elevation) * (np.cos(azimuth) * side + np.sin(azimuth) * forward)
    if key @ normal < _LEAST_SHARE:
        key = unit(key + normal * (1.2 * _LEAST_SHARE - key @ normal))
    kind = ("sun", "bulb", "panel")[rng.choice(3, p=(0.3, 0.35, 0.35))]
    radius = {"sun": 0.27, "bulb": rng.uniform(1, 4), "panel": rng.uniform(4, 14)}[kind]
    local = rotation.T @ normal
    maps: list[npt.NDArray[np.float32]] = []
    for make in (_windows, _room):
        level, strongest = 0.0, 1.0
        while level < _LEAST_SHARE * strongest:
            image = _soften(make(rng), rng.uniform(0.8, 2.0))
            level, strongest = _irradiance(image, local), _irradiance(image, _main_direction(image))
        maps.append(np.asarray(image / level, np.float32))
    return Lights(kind, key, float(np.radians(radius)), maps[0], maps[1], rotation)
