"""Loop subdivision, normals, welding, borders and mixed resolution on small meshes."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra [synthetic]")

from egotouch_sdk.synthetic.mesh import (
    FloatArray,
    IntArray,
    boundary_loop,
    directed_edges,
    loop_subdivide,
    mixed_resolution,
    vertex_normals,
    weld,
)

TETRAHEDRON = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
TETRAHEDRON_FACES = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])


def grid(size: int) -> tuple[FloatArray, IntArray]:
    """A flat square of size x size cells in the plane z = 0, faces counter-clockwise seen from +z."""
    x, y = np.meshgrid(np.arange(size + 1.0), np.arange(size + 1.0), indexing="ij")
    corner = (np.arange(size)[:, None] * (size + 1) + np.arange(size)).ravel()
    right, up = corner + size + 1, corner + 1
    faces = np.vstack([np.stack([corner, right, right + 1], axis=1), np.stack([corner, right + 1, up], axis=1)])
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1), faces


def sharing_of_edges(faces: IntArray) -> IntArray:
    return np.unique(np.sort(directed_edges(faces), axis=1), axis=0, return_counts=True)[1]


def test_subdivision_splits_every_face_in_four_and_stays_closed() -> None:
    faces, vertices = TETRAHEDRON_FACES, TETRAHEDRON
    for _ in range(3):
        edge_count, vertex_count = len(sharing_of_edges(faces)), len(vertices)
        finer, vertices = loop_subdivide(faces, vertices)
        assert len(finer) == 4 * len(faces)
        assert len(vertices) == vertex_count + edge_count
        assert (sharing_of_edges(finer) == 2).all()
        assert len(np.unique(directed_edges(finer), axis=0)) == 3 * len(finer)
        faces = finer


def test_subdivision_keeps_old_vertices_first_and_children_in_four_blocks() -> None:
    finer, _ = loop_subdivide(TETRAHEDRON_FACES, TETRAHEDRON)
    children = finer.reshape(4, len(TETRAHEDRON_FACES), 3)
    for corner in range(3):
        np.testing.assert_array_equal(children[corner, :, 0], TETRAHEDRON_FACES[:, corner])
    assert (children[3] >= len(TETRAHEDRON)).all()


def test_subdivision_commutes_with_affine_maps() -> None:
    matrix, shift = np.array([[2.0, 0.3, 0], [-0.4, 1, 0.2], [0, 0.5, 3]]), np.array([4.0, -1, 2])
    _, plain = loop_subdivide(TETRAHEDRON_FACES, TETRAHEDRON)
    _, mapped = loop_subdivide(TETRAHEDRON_FACES, TETRAHEDRON @ matrix + shift)
    np.testing.assert_allclose(mapped, plain @ matrix + shift, atol=1e-12)


def test_border_of_a_flat_square_follows_the_b_spline_rule() -> None:
    vertices, faces = grid(3)
    _, finer = loop_subdivide(faces, vertices)
    np.testing.assert_allclose(finer[:, 2], 0, atol=1e-15)
    on_edge = 1 * 4  # (1, 0): straight border on both sides, stays where it is
    np.testing.assert_allclose(finer[on_edge], [1, 0, 0], atol=1e-15)
    np.testing.assert_allclose(finer[0], [0.125, 0.125, 0], atol=1e-15)
    assert finer[:, :2].min() >= 0 and finer[:, :2].max() <= 3


def test_normals_point_out_and_have_length_one() -> None:
    vertices, faces = grid(2)
    np.testing.assert_allclose(vertex_normals(vertices, faces), np.tile([0.0, 0, 1], (len(vertices), 1)), atol=1e-15)
    normals = vertex_normals(TETRAHEDRON, TETRAHEDRON_FACES)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
    np.testing.assert_allclose(np.abs((normals * TETRAHEDRON).sum(axis=1)), np.sqrt(3))


def test_weld_joins_split_corners_and_drops_collapsed_faces() -> None:
    soup = np.vstack([TETRAHEDRON[TETRAHEDRON_FACES.ravel()], TETRAHEDRON[:1], TETRAHEDRON[:1] + 1e-8, TETRAHEDRON[1:2]])
    faces = np.vstack([np.arange(12).reshape(4, 3), [[12, 13, 14]]])
    kept, welded = weld(soup, faces)
    assert len(kept) == 4 and len(welded) == 4
    assert (sharing_of_edges(welded) == 2).all()


def test_boundary_loop_runs_once_round() -> None:
    vertices, faces = grid(3)
    loop = boundary_loop(faces)
    assert len(loop) == len(set(loop.tolist())) == 12
    np.testing.assert_allclose(np.linalg.norm(np.diff(vertices[loop], axis=0), axis=1), 1)


def test_boundary_loop_refuses_closed_meshes_and_two_holes() -> None:
    with pytest.raises(ValueError, match="no open border"):
        boundary_loop(TETRAHEDRON_FACES)
    _, faces = grid(5)
    with pytest.raises(ValueError, match="several borders"):
        boundary_loop(np.delete(faces, 12, axis=0))


def test_mixed_resolution_is_fine_near_and_coarse_elsewhere() -> None:
    vertices, coarse = grid(6)
    middle, vertices = loop_subdivide(coarse, vertices)
    fine, vertices = loop_subdivide(middle, vertices)
    near = np.zeros(len(vertices), dtype=bool)
    near[0] = True
    ids, faces = mixed_resolution([coarse, middle, fine], [near, near])
    split_once, split_twice = ((level == 0).any(axis=1).sum() for level in (coarse, middle))
    assert len(faces) == len(coarse) + 3 * split_once + 3 * split_twice
    assert (np.diff(ids) > 0).all()
    assert faces.max() == len(ids) - 1
    for mask, expected in ((np.zeros_like(near), middle), (np.ones_like(near), fine)):
        ids, faces = mixed_resolution([coarse, middle, fine], [mask])
        assert {tuple(face) for face in ids[faces].tolist()} == {tuple(face) for face in expected.tolist()}
