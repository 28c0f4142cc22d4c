"""Builds the arrays of a `HandRig` from the GLB asset: weld, open the wrist, grow a forearm, subdivide; cached on disk."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from egotouch_sdk.errors import MissingExtraError
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.synthetic.assets import cache_dir, hand_mesh_path
from egotouch_sdk.synthetic.mesh import FloatArray, IntArray, boundary_loop, loop_subdivide, vertex_normals, weld

_FINGER_PARTS = ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")
#: WebXR's 25 joint names in spec order, then "forearm".
JOINT_NAMES: tuple[str, ...] = (
    "wrist",
    *(f"thumb-{part}" for part in _FINGER_PARTS if part != "phalanx-intermediate"),
    *(f"{finger}-finger-{part}" for finger in FINGERS[1:] for part in _FINGER_PARTS),
    "forearm",
)
JOINT_COUNT = len(JOINT_NAMES)
FOREARM = JOINT_NAMES.index("forearm")
#: Length of the grown forearm; 0.26 and 0.40 m showed its cut end in camera views.
FOREARM_LENGTH_M = 0.55

_MIN_WEIGHT = 1e-4
_BUILD_VERSION = 1


@dataclass(frozen=True, slots=True, eq=False)
class RigArrays:
    """Rest-pose arrays of one hand: vertices (n, 3), normals (n, 3), weights (n, 26) CSR, bind (26, 4, 4), faces per level."""

    vertices: FloatArray
    normals: FloatArray
    weights: csr_matrix
    bind: FloatArray
    faces_at: tuple[IntArray, ...]
    vertex_count_at: tuple[int, ...]


@lru_cache(maxsize=8)
def load_rig_arrays(side: Handedness, level: int) -> RigArrays:
    """The arrays of one hand after `level` subdivisions, from the process, the cache folder or the asset, in that order."""
    path = cache_dir() / f"rig-v{_BUILD_VERSION}-{side}-{level}.npz"
    if path.is_file():
        with np.load(path) as stored:
            return _unpack(stored, level)
    arrays = build_rig_arrays(side, level)
    _store(path, arrays)
    return arrays


def build_rig_arrays(side: Handedness, level: int) -> RigArrays:
    """Build the arrays from the asset. Raises `MissingExtraError` without pygltflib, `SourceError` without the mesh."""
    positions, weights, faces, bind = _read_glb(hand_mesh_path(side))
    positions, weights, faces = _grow_forearm(positions, weights, *_open_wrist(positions, faces, bind), bind)
    if np.einsum("ij,ij->", vertex_normals(positions, faces), positions - positions.mean(axis=0)) < 0:
        faces = faces[:, ::-1]
    attributes = np.hstack([positions, weights])
    faces_at, counts = [faces], [len(attributes)]
    for _ in range(level):
        faces, attributes = loop_subdivide(faces, attributes)
        faces_at.append(faces)
        counts.append(len(attributes))
    vertices = np.ascontiguousarray(attributes[:, :3])
    kept = np.where(attributes[:, 3:] > _MIN_WEIGHT, attributes[:, 3:], 0.0)
    return RigArrays(
        vertices=vertices,
        normals=vertex_normals(vertices, faces),
        weights=csr_matrix(kept / kept.sum(axis=1, keepdims=True)),
        bind=bind,
        faces_at=tuple(faces_at),
        vertex_count_at=tuple(counts),
    )


def _read_glb(path: Path) -> tuple[FloatArray, FloatArray, IntArray, FloatArray]:
    try:
        import pygltflib
    except ImportError as error:
        raise MissingExtraError("Reading hand meshes", "synthetic") from error
    gltf = pygltflib.GLTF2().load(str(path))
    skin, primitive = gltf.skins[0], gltf.meshes[0].primitives[0]
    rig_joint = np.array([JOINT_NAMES.index(gltf.nodes[node].name) for node in skin.joints])
    positions = _accessor(gltf, primitive.attributes.POSITION).astype(np.float64)
    joints, shares = (_accessor(gltf, a) for a in (primitive.attributes.JOINTS_0, primitive.attributes.WEIGHTS_0))
    weights = np.zeros((len(positions), JOINT_COUNT))
    np.add.at(weights, (np.arange(len(positions))[:, None], rig_joint[joints]), shares)
    inverse_bind = _accessor(gltf, skin.inverseBindMatrices).reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)
    bind = np.zeros((JOINT_COUNT, 4, 4))
    bind[rig_joint] = np.linalg.inv(inverse_bind)
    bind[FOREARM] = bind[0]
    kept, faces = weld(positions, _accessor(gltf, primitive.indices).reshape(-1, 3).astype(np.int64))
    return positions[kept], weights[kept] / weights[kept].sum(axis=1, keepdims=True), faces, bind


def _accessor(gltf: Any, index: int) -> Any:
    accessor = gltf.accessors[index]
    view = gltf.bufferViews[accessor.bufferView]
    dtype = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}[accessor.componentType]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor.type]
    offset = (view.byteOffset or 0) + (accessor.byteOffset or 0)
    return np.frombuffer(gltf.binary_blob(), dtype, accessor.count * width, offset).reshape(accessor.count, width)


def _open_wrist(positions: FloatArray, faces: IntArray, bind: FloatArray) -> tuple[IntArray, IntArray]:
    """Drop the cap at the wrist; returns the remaining faces and the border loop. The asset's cap lies in one plane."""
    local = (positions - bind[0, :3, 3]) @ bind[0, :3, :3]
    on_cap = np.abs(local[:, 2] - (0.016 - 0.355 * local[:, 1])) < 0.003
    opened = faces[~on_cap[faces].all(axis=1)]
    return opened, boundary_loop(opened)


def _grow_forearm(
    positions: FloatArray, weights: FloatArray, faces: IntArray, loop: IntArray, bind: FloatArray
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Extrude the wrist's border into a forearm: rings that turn into ellipses 53 x 39 mm, widening towards the elbow."""
    rotation, origin = bind[0, :3, :3], bind[0, :3, 3]
    local = (positions[loop] - origin) @ rotation
    centre = local.mean(axis=0)
    angle = np.arctan2(local[:, 1] - centre[1], local[:, 0] - centre[0])
    radius = np.hypot(local[:, 0] - centre[0], local[:, 1] - centre[1])
    all_positions, all_weights, all_faces = [positions], [weights], [faces]
    previous, first = loop, len(positions)
    for z in np.concatenate([np.arange(0.006, 0.06, 0.008), np.arange(0.066, 0.2, 0.014), np.arange(0.2, FOREARM_LENGTH_M, 0.03)]):
        turn = min(1.0, z / 0.05)
        turn = turn * turn * (3 - 2 * turn)
        along = min(1.2, z / 0.2)
        half_width, half_height = 0.0265 + 0.016 * along**1.1, 0.0195 + 0.018 * along**1.1
        ellipse = half_width * half_height / np.hypot(half_height * np.cos(angle), half_width * np.sin(angle))
        ring_radius = radius * (1 - turn) + ellipse * turn
        depth = np.maximum(local[:, 2], centre[2]) * (1 - turn) + centre[2] * turn + z
        ring = np.stack([centre[0] + ring_radius * np.cos(angle), centre[1] + ring_radius * np.sin(angle) - 0.004 * along, depth], axis=1)
        all_positions.append(ring @ rotation.T + origin)
        ring_weights = np.zeros((len(ring), JOINT_COUNT))
        ring_weights[:, FOREARM] = np.clip(z / 0.03, 0, 1)
        ring_weights[:, 0] = 1 - ring_weights[:, FOREARM]
        all_weights.append(ring_weights)
        current = first + np.arange(len(ring))
        first += len(ring)
        a, b, c, d = previous, np.roll(previous, -1), current, np.roll(current, -1)
        all_faces += [np.stack([b, a, c], axis=1), np.stack([b, c, d], axis=1)]
        previous = current
    return np.vstack(all_positions), np.vstack(all_weights), np.vstack(all_faces)


def _store(path: Path, arrays: RigArrays) -> None:
    scratch = path.with_suffix(f".{os.getpid()}.tmp.npz")
    weights = arrays.weights
    np.savez(
        scratch,
        vertices=arrays.vertices,
        normals=arrays.normals,
        bind=arrays.bind,
        counts=np.array(arrays.vertex_count_at),
        weight_data=weights.data,
        weight_indices=weights.indices,
        weight_indptr=weights.indptr,
        **{f"faces{level}": faces.astype(np.int32) for level, faces in enumerate(arrays.faces_at)},  # type: ignore[arg-type]
    )
    scratch.replace(path)


def _unpack(stored: Any, level: int) -> RigArrays:
    counts = tuple(int(count) for count in stored["counts"])
    weights = csr_matrix((stored["weight_data"], stored["weight_indices"], stored["weight_indptr"]), shape=(counts[-1], JOINT_COUNT))
    faces_at = tuple(stored[f"faces{k}"].astype(np.int64) for k in range(level + 1))
    return RigArrays(stored["vertices"], stored["normals"], weights, stored["bind"], faces_at, counts)
