"""One hand's bare surface seen by the skin painters, and the relief they carve into it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.mesh import IntArray
from egotouch_sdk.synthetic.noise import noise


@dataclass(frozen=True)
class SkinSide:
    """Rest surface of one hand. `seed` is the identity's own for this side."""

    rig: HandRig
    seed: int

    @cached_property
    def points(self) -> Array:
        """Vertices (n, 3) in the wrist frame in metres, right hands mirrored: +x thumbwards, +y dorsal, +z to the elbow."""
        return self.rig.wrist_coords * [1.0 if self.rig.side is Handedness.LEFT else -1.0, 1.0, 1.0]

    @cached_property
    def normals_in_wrist(self) -> Array:
        """Unit normals (n, 3) in the same frame as `points`."""
        turned = self.rig.normals @ self.rig.bind[0, :3, :3]
        return np.asarray(turned * [1.0 if self.rig.side is Handedness.LEFT else -1.0, 1.0, 1.0], np.float64)

    @cached_property
    def dorsal(self) -> Array:
        """How far each vertex faces the back of its own bone, (n,) in -1 (pad) .. 1 (nail)."""
        per_joint = self.rig.normals @ self.rig.bind[:, :3, 1].T
        return np.asarray(self.rig.weights.multiply(per_joint).sum(axis=1), np.float64).ravel()

    @cached_property
    def palmar(self) -> Array:
        """Palm-side mask (n,) in 0..1 with an irregular border, on the forearm its inner side."""
        return smoothstep(0.25, -0.35, self.dorsal + 0.12 * self.noise(0.012, 1))

    def noise(self, scale_m: float, salt: int, ids: IntArray | None = None) -> Array:
        """Smooth noise at all vertices (or `ids`); `salt` tells one use from another."""
        return noise(self.points if ids is None else self.points[ids], scale_m, self.seed + salt)

    def finger_ids(self, finger: Finger) -> IntArray:
        """Vertices that belong mostly to a finger."""
        return np.flatnonzero(self.rig.finger_weight(finger) > 0.5)

    def in_bone(self, joint: int, ids: IntArray) -> tuple[Array, Array]:
        """Positions and normals (k, 3) of some vertices in a joint's frame: -z to the tip, +y dorsal; metres."""
        frame = self.rig.bind[joint]
        return (self.rig.vertices[ids] - frame[:3, 3]) @ frame[:3, :3], self.rig.normals[ids] @ frame[:3, :3]


class Relief:
    """What carving leaves on a side: `height_m` (n,) along the normal and `dark` (n,), the depth of shading in a furrow."""

    def __init__(self, vertex_count: int) -> None:
        self.height_m: Array = np.zeros(vertex_count)
        self.dark: Array = np.zeros(vertex_count)

    def carve(self, ids: IntArray, profile: Array, depth_m: float, dark: float) -> None:
        """Sink the vertices `ids` by `profile` (k,) times `depth_m` and darken them by `profile` times `dark`."""
        self.height_m[ids] -= depth_m * profile
        self.dark[ids] += dark * profile
