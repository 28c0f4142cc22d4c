"""The hand rig: closed surface, weights, pose and skinning."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra [synthetic]")
pytest.importorskip("pygltflib", reason="needs the extra [synthetic]")

from egotouch_sdk.joints import FINGERS, Finger, HandJoint
from egotouch_sdk.synthetic.hand_rig import PARENTS, HandRig
from egotouch_sdk.synthetic.mesh import boundary_loop, directed_edges
from egotouch_sdk.synthetic.rig_build import FOREARM, JOINT_NAMES, build_rig_arrays, load_rig_arrays

LEVEL = 2
BENT = {"index-finger-phalanx-proximal": (50.0, 5.0, 0.0), "thumb-phalanx-distal": (30.0, 0.0, 0.0), "forearm": (10.0, -8.0, 0.0)}


@pytest.fixture(scope="module", params=["left", "right"])
def rig(request: pytest.FixtureRequest, mesh_dir: Path) -> HandRig:
    return HandRig(request.param, LEVEL)


def test_surface_is_closed_but_for_the_cut_at_the_elbow(rig: HandRig) -> None:
    edges = directed_edges(rig.faces)
    assert len(np.unique(edges, axis=0)) == len(edges)
    border = boundary_loop(rig.faces)
    assert len(border) == 20 * 2**LEVEL
    assert rig.wrist_coords[border, 2].min() > 0.5
    a, b, c = (rig.vertices[rig.faces[:, k]] for k in range(3))
    assert (np.cross(a, b) * c).sum() / 6 > 1e-3


def test_normals_point_away_from_the_bones(rig: HandRig) -> None:
    forearm = np.flatnonzero((rig.wrist_coords[:, 2] > 0.1) & (rig.wrist_coords[:, 2] < 0.5))
    outward = rig.wrist_coords[forearm, :2] - rig.wrist_coords[forearm, :2].mean(axis=0)
    normals = (rig.normals[forearm] @ rig.bind[0, :3, :3])[:, :2]
    assert ((outward * normals).sum(axis=1) > 0).all()


def test_counts_follow_the_subdivision(rig: HandRig) -> None:
    for coarse, fine in zip(rig.faces_at, rig.faces_at[1:], strict=False):
        assert len(fine) == 4 * len(coarse)
    assert rig.vertex_count_at == tuple(int(faces.max()) + 1 for faces in rig.faces_at)
    assert len(rig.vertices) == rig.vertex_count_at[-1]


def test_weights_sum_to_one(rig: HandRig) -> None:
    np.testing.assert_allclose(np.asarray(rig.weights.sum(axis=1)).ravel(), 1, atol=1e-12)
    assert rig.weights.data.min() > 0
    per_finger = sum(rig.finger_weight(finger) for finger in FINGERS)
    assert np.max(per_finger) <= 1 + 1e-12
    assert rig.weights[rig.wrist_coords[:, 2] > 0.1][:, FOREARM].min() == pytest.approx(1)


def test_identity_pose_is_the_bind_pose(rig: HandRig) -> None:
    transforms = rig.pose({})
    np.testing.assert_allclose(transforms, rig.bind, atol=1e-12)
    np.testing.assert_allclose(rig.skin(transforms), rig.vertices, atol=1e-12)


def test_skinning_moves_with_a_rigid_motion(rig: HandRig) -> None:
    transforms = rig.pose(BENT)
    motion = np.eye(4)
    motion[:3, :3] = np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]
    motion[:3, 3] = [0.3, -0.2, 0.5]
    expected = rig.skin(transforms) @ motion[:3, :3].T + motion[:3, 3]
    np.testing.assert_allclose(rig.skin(motion @ transforms), expected, atol=1e-12)


def test_bending_keeps_bones_and_moves_only_what_hangs_below(rig: HandRig) -> None:
    transforms = rig.pose(BENT)
    for joint, parent in enumerate(PARENTS[1:], start=1):
        before = np.linalg.norm(rig.bind[joint, :3, 3] - rig.bind[parent, :3, 3])
        assert np.linalg.norm(transforms[joint, :3, 3] - transforms[parent, :3, 3]) == pytest.approx(before)
    ring = rig.finger_weight(Finger.RING) > 0.999
    np.testing.assert_allclose(rig.skin(transforms)[ring], rig.vertices[ring], atol=1e-9)


def test_positive_flexion_curls_to_the_palm(rig: HandRig) -> None:
    transforms = rig.pose({"index-finger-phalanx-proximal": (60.0, 0.0, 0.0)})
    tip = JOINT_NAMES.index("index-finger-tip")
    moved = (transforms[tip, :3, 3] - rig.bind[tip, :3, 3]) @ rig.bind[0, :3, 1]
    assert moved < -0.04


def test_selected_vertices_equal_the_whole(rig: HandRig) -> None:
    transforms, ids = rig.pose(BENT), np.array([5, 17, 400, 2000])
    np.testing.assert_allclose(rig.skin(transforms, rig.vertices, ids), rig.skin(transforms)[ids], atol=1e-15)


def test_unknown_joint_is_refused(rig: HandRig) -> None:
    with pytest.raises(KeyError, match="index-knuckle"):
        rig.pose({"index-knuckle": (0.0, 0.0, 0.0)})


def test_landmarks_follow_the_finger(rig: HandRig) -> None:
    transforms = rig.pose(BENT)
    landmarks = rig.mediapipe_joints(transforms)
    assert landmarks.shape == (21, 3)
    palm = np.linalg.norm(landmarks[HandJoint.MIDDLE_FINGER_MCP] - landmarks[HandJoint.WRIST])
    assert 0.075 < palm < 0.090
    np.testing.assert_allclose(
        landmarks[HandJoint.INDEX_FINGER_PIP], transforms[JOINT_NAMES.index("index-finger-phalanx-intermediate"), :3, 3]
    )
    for finger in FINGERS:
        length = np.linalg.norm(landmarks[finger.tip] - landmarks[finger.dip])
        own = rig.skin(transforms)[rig.finger_weight(finger) > 0.5]
        axis = (landmarks[finger.tip] - landmarks[finger.dip]) / length
        end = float(((own - landmarks[finger.dip]) @ axis).max())
        assert 0.010 < length < 0.025
        assert end - length > 0.002, "the tip landmark lies inside the finger"


def test_left_and_right_mirror_each_other(mesh_dir: Path) -> None:
    left, right = HandRig("left", 1), HandRig("right", 1)
    mirrored = np.sort(right.wrist_coords * [-1, 1, 1], axis=0)
    np.testing.assert_allclose(mirrored, np.sort(left.wrist_coords, axis=0), atol=1e-3)


def test_disk_cache_returns_what_was_built(own_cache: Path, mesh_dir: Path) -> None:
    load_rig_arrays.cache_clear()
    built = build_rig_arrays(HandRig("left", 1).side, 1)
    load_rig_arrays.cache_clear()
    loaded = HandRig("left", 1)
    assert list(own_cache.glob("rig-*.npz"))
    np.testing.assert_array_equal(loaded.vertices, built.vertices)
    np.testing.assert_array_equal(loaded.weights.toarray(), built.weights.toarray())
    for a, b in zip(loaded.faces_at, built.faces_at, strict=True):
        np.testing.assert_array_equal(a, b)
    load_rig_arrays.cache_clear()
