"""Baked skin: deterministic, plausible colours, nails and hair where they belong."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra [synthetic]")
pytest.importorskip("pygltflib", reason="needs the extra [synthetic]")

from scipy.spatial import cKDTree

from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.synthetic.hair import hair_cover, spots
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.noise import cell_borders, noise
from egotouch_sdk.synthetic.skin import SkinIdentity, bake_identity, identity_path
from egotouch_sdk.synthetic.skin_side import SkinSide
from egotouch_sdk.synthetic.skin_traits import draw_traits

pytestmark = pytest.mark.slow
LEVEL = 3
LUMA = np.array([0.2126, 0.7152, 0.0722])


@pytest.fixture(scope="module")
def baked(mesh_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[float, SkinIdentity]:
    """One person in three skin types, baked into a cache of their own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("EGOTOUCH_CACHE", str(tmp_path_factory.mktemp("cache")))
        patch.setenv("EGOTOUCH_HAND_MESH_DIR", str(mesh_dir))
        return {kind: bake_identity(5, kind, LEVEL) for kind in (1.0, 2.5, 6.0)}


def test_values_are_in_range(baked: dict[float, SkinIdentity]) -> None:
    for identity in baked.values():
        for side, skin in identity.sides.items():
            rig = HandRig(side, LEVEL)
            assert skin.vertices.shape == skin.albedo.shape == rig.vertices.shape
            assert skin.albedo.min() > 0.004 and skin.albedo.max() <= 0.951
            assert skin.roughness.min() > 0.14 and skin.roughness.max() <= 0.91
            assert np.abs(skin.vertices - rig.vertices).max() < 0.006
            for mask in (skin.nail, skin.edge, skin.palmar):
                assert mask.shape == (len(rig.vertices),) and mask.min() == 0 and 0.9 < mask.max() <= 1


def test_type_orders_brightness(baked: dict[float, SkinIdentity]) -> None:
    luma = [float((skin.sides[Handedness.LEFT].albedo @ LUMA)[skin.sides[Handedness.LEFT].palmar < 0.1].mean()) for skin in baked.values()]
    assert luma == sorted(luma, reverse=True)
    assert luma[0] > 4 * luma[-1]


def test_palm_is_pinker_than_the_back(baked: dict[float, SkinIdentity]) -> None:
    for identity in baked.values():
        skin = identity.sides[Handedness.LEFT]
        on_hand = (HandRig("left", LEVEL).wrist_coords[:, 2] < -0.01) & (skin.nail < 0.01)
        palm, back = (skin.albedo[on_hand & mask].mean(axis=0) for mask in (skin.palmar > 0.9, skin.palmar < 0.1))
        assert palm[1] / palm[2] < 0.93 * back[1] / back[2]
    dark = baked[6.0].sides[Handedness.LEFT]
    assert (dark.albedo @ LUMA)[dark.palmar > 0.9].mean() > 1.5 * (dark.albedo @ LUMA)[dark.palmar < 0.1].mean()


def test_nails_sit_on_the_backs_of_the_five_fingertips(baked: dict[float, SkinIdentity]) -> None:
    rig, skin = HandRig("right", LEVEL), baked[2.5].sides[Handedness.RIGHT]
    side = SkinSide(rig, 0)
    on_nail = np.flatnonzero(skin.nail > 0.5)
    assert side.dorsal[on_nail].min() > 0
    for finger in FINGERS:
        dip = rig.finger_joint_ids(finger)[-2]
        own = on_nail[rig.finger_weight(finger)[on_nail] > 0.5]
        along = -((rig.vertices[own] - rig.bind[dip, :3, 3]) @ rig.bind[dip, :3, 2])
        assert len(own) > 20
        assert along.min() > 0.002 and along.max() < 0.035
    assert skin.edge[skin.nail < 0.01].max() < 0.02


def test_bare_nail_is_darker_than_its_finger_on_light_skin(baked: dict[float, SkinIdentity]) -> None:
    identity = baked[2.5]
    assert not identity.polished
    rig, skin = HandRig("left", LEVEL), identity.sides[Handedness.LEFT]
    finger = (rig.wrist_coords[:, 2] < -0.13) & (skin.palmar < 0.1)
    bed, around = (skin.albedo[finger & mask] @ LUMA for mask in ((skin.nail > 0.9) & (skin.edge < 0.1), skin.nail < 0.01))
    assert bed.mean() < around.mean()


def test_same_seed_same_skin_and_another_seed_another(own_cache: Path, baked: dict[float, SkinIdentity]) -> None:
    again, other = bake_identity(5, 2.5, LEVEL), bake_identity(6, 2.5, LEVEL)
    assert identity_path(5, draw_traits(5, 2.5), LEVEL).parent == own_cache / "skin"
    for side, skin in baked[2.5].sides.items():
        for name in ("vertices", "albedo", "roughness", "nail", "edge", "palmar"):
            np.testing.assert_array_equal(getattr(again.sides[side], name), getattr(skin, name))
        assert np.abs(other.sides[side].albedo - skin.albedo).mean() > 0.005
    assert again.traits == baked[2.5].traits != other.traits


def test_cached_identity_is_read_not_baked(own_cache: Path) -> None:
    first = bake_identity(7, 3.0, 1)
    stamp = identity_path(7, draw_traits(7, 3.0), 1).stat().st_mtime_ns
    second = bake_identity(7, 3.0, 1)
    assert identity_path(7, draw_traits(7, 3.0), 1).stat().st_mtime_ns == stamp
    np.testing.assert_array_equal(first.sides[Handedness.LEFT].albedo, second.sides[Handedness.LEFT].albedo)


@pytest.mark.parametrize("kind", [0.9, 6.1, float("nan")])
def test_unknown_skin_type_is_refused(kind: float) -> None:
    with pytest.raises(ValueError, match=r"need 1\.\.6"):
        draw_traits(0, kind)


def test_traits_vary_between_people() -> None:
    people = [draw_traits(seed, 3.0) for seed in range(200)]
    assert 0.02 < sum(p.polish is not None for p in people) / 200 < 0.15
    assert min(p.hair for p in people) < 0.1 and max(p.hair for p in people) > 2.5
    assert all(0.88 <= p.scale <= 1.1 for p in people)


def test_hair_grows_with_density_and_not_on_the_palm(mesh_dir: Path) -> None:
    side = SkinSide(HandRig("left", LEVEL), 3)
    tree = cKDTree(side.points)
    sums = [float(hair_cover(side, tree, density, 0.65).sum()) for density in (0.0, 0.5, 1.5, 3.0)]
    assert sums[0] == 0 and sums == sorted(sums) and sums[-1] > 2 * sums[1]
    on_palm = (side.palmar > 0.95) & (side.points[:, 2] < -0.03)
    assert hair_cover(side, tree, 3.0, 0.65)[on_palm].max() < 0.05
    assert spots(side, tree, 300, 20).max() > 0.3


def test_noise_is_standardised_smooth_and_seeded() -> None:
    points = np.random.default_rng(0).uniform(0, 0.2, (20000, 3))
    values = noise(points, 0.005, 1)
    assert abs(values.mean()) < 0.05 and 0.85 < values.std() < 1.15
    assert np.abs(noise(points + 0.00005, 0.005, 1) - values).max() < 0.25
    assert abs(np.corrcoef(values, noise(points, 0.005, 2))[0, 1]) < 0.05
    np.testing.assert_array_equal(values, noise(points, 0.005, 1))


def test_cells_have_the_size_asked_for() -> None:
    x, y = np.meshgrid(np.arange(0, 0.3, 0.0005), np.arange(0, 0.3, 0.0005))
    plane = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    border = cell_borders(plane, 0.003, 1)
    assert border.min() >= 0
    assert 0.15 < (border < 0.12).mean() < 0.45
