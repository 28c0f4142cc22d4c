"""Triangle meshes: welding, Loop subdivision that carries any attribute, normals, and mixed resolution."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_matrix

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


def weld(positions: FloatArray, faces: IntArray, decimals: int = 6) -> tuple[IntArray, IntArray]:
    """Join vertices at the same place and drop faces that collapse.

    `positions` (n, 3) in metres, `faces` (m, 3); vertices equal to `decimals` decimals (1 um by default) are one.
    Returns (kept vertex ids into `positions`, faces over the kept vertices).
    """
    _, kept, inverse = np.unique(np.round(positions, decimals), axis=0, return_index=True, return_inverse=True)
    joined = inverse.ravel()[faces]
    a, b, c = joined.T
    return kept.astype(np.int64), joined[(a != b) & (b != c) & (a != c)].astype(np.int64)


def directed_edges(faces: IntArray) -> IntArray:
    """All (3 m, 2) half-edges of the faces: first every corner 0->1, then 1->2, then 2->0."""
    return np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def boundary_loop(faces: IntArray) -> IntArray:
    """Vertex ids round the mesh's one open border, in the order of its half-edges.

    Raises `ValueError` when there is no border or more than one loop.
    """
    edges = directed_edges(faces)
    _, inverse, count = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    border = edges[count[inverse.ravel()] == 1]
    following = {int(a): int(b) for a, b in border}
    if not following:
        raise ValueError("the mesh has no open border")
    start = int(border[0, 0])
    loop = [start]
    while (vertex := following[loop[-1]]) != start:
        loop.append(vertex)
    if len(loop) != len(border):
        raise ValueError(f"the mesh has several borders: one loop has {len(loop)} of {len(border)} border edges")
    return np.array(loop, dtype=np.int64)


def loop_subdivide(faces: IntArray, attributes: FloatArray) -> tuple[IntArray, FloatArray]:
    """One step of Loop subdivision (C. Loop 1987, borders as cubic B-splines), applied to every attribute column.

    `faces` (m, 3), `attributes` (n, k): positions, skin weights, anything that interpolates linearly.
    Returns (4 m, 3) faces and (n + edges, k) attributes. Old vertices keep their index; the four children of
    face i are rows i, i + m, i + 2 m and i + 3 m.
    """
    vertex_count, face_count = len(attributes), len(faces)
    edges = np.sort(directed_edges(faces), axis=1)
    opposite = np.concatenate([faces[:, 2], faces[:, 0], faces[:, 1]])
    unique, inverse, sharing = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    inverse = inverse.ravel()
    on_border = sharing == 1

    ends = attributes[unique[:, 0]] + attributes[unique[:, 1]]
    wings = coo_matrix((np.ones(len(inverse)), (inverse, opposite)), shape=(len(unique), vertex_count)).tocsr() @ attributes
    edge_points = np.where(on_border[:, None], 0.5 * ends, 0.375 * ends + 0.125 * wings)

    neighbours = _adjacency(unique, vertex_count)
    valence = np.maximum(np.asarray(neighbours.sum(axis=1)).ravel(), 1)
    beta = (0.625 - (0.375 + 0.25 * np.cos(2 * np.pi / valence)) ** 2) / valence
    moved = attributes * (1 - valence * beta)[:, None] + beta[:, None] * (neighbours @ attributes)
    border = np.unique(unique[on_border])
    if len(border):
        moved[border] = 0.75 * attributes[border] + 0.125 * (_adjacency(unique[on_border], vertex_count) @ attributes)[border]

    mid01, mid12, mid20 = (vertex_count + inverse[k * face_count : (k + 1) * face_count] for k in range(3))
    v0, v1, v2 = faces.T
    children = [(v0, mid01, mid20), (v1, mid12, mid01), (v2, mid20, mid12), (mid01, mid12, mid20)]
    return np.vstack([np.stack(child, axis=1) for child in children]), np.vstack([moved, edge_points])


def _adjacency(edges: IntArray, vertex_count: int) -> coo_matrix:
    rows, columns = np.concatenate([edges[:, 0], edges[:, 1]]), np.concatenate([edges[:, 1], edges[:, 0]])
    return coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(vertex_count, vertex_count)).tocsr()


def vertex_normals(vertices: FloatArray, faces: IntArray) -> FloatArray:
    """Area-weighted unit normals (n, 3) of a mesh; a vertex of no face gets zeros."""
    corners = vertices[faces]
    face_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    ids = faces.ravel()
    summed = np.stack([np.bincount(ids, np.repeat(face_normals[:, k], 3), minlength=len(vertices)) for k in range(3)], axis=1)
    unit: FloatArray = summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-20)
    return unit


def mixed_resolution(faces_at: Sequence[IntArray], near: Sequence[npt.NDArray[np.bool_]]) -> tuple[IntArray, IntArray]:
    """Fine faces where wanted, coarser ones elsewhere.

    `faces_at[k]` are the faces after k subdivisions. `near` holds one vertex mask (n at the finest level,) per refinement
    wanted, widest first: with two masks, faces far from both stay two levels below the finest, faces that touch the
    first are split once, those that touch the second twice. Resolutions meet with T-junctions, far from what is looked
    at: the surfaces differ by less than the finer edge length there.
    Returns (vertex ids into the finest mesh, ascending; faces over those ids).
    """
    finest = len(faces_at) - 1
    level = finest - len(near)
    rows = np.arange(len(faces_at[level]))
    kept = []
    for mask in near:
        faces = faces_at[level]
        split = mask[faces[rows]].any(axis=1)
        kept.append(faces[rows[~split]])
        rows = (rows[split] + len(faces) * np.arange(4)[:, None]).ravel()
        level += 1
    faces = np.vstack([*kept, faces_at[level][rows]])
    used = np.zeros(len(near[0]), dtype=bool)
    used[faces.ravel()] = True
    ids = np.flatnonzero(used)
    renumber = np.zeros(len(used), dtype=np.int64)
    renumber[ids] = np.arange(len(ids))
    return ids, renumber[faces]
