import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from egotouch_sdk.errors import SourceError  # noqa: E402
from egotouch_sdk.training.augment import view  # noqa: E402
from egotouch_sdk.training.dataset import PatchDataset, SeededOrder, collate, finger_weights, fixed_views  # noqa: E402
from egotouch_sdk.training.film_sheet import film_sheet  # noqa: E402
from egotouch_sdk.training.films import before_clutter, read_films, view_film  # noqa: E402
from egotouch_sdk.training.folder import read_folder  # noqa: E402
from egotouch_sdk.training.shards import HOVER_MAX_MM, held_out, read_shard  # noqa: E402


def test_a_folder_is_read_whole(shard_folder: Path) -> None:
    patches = read_folder(shard_folder)
    assert len(patches) == 48
    assert {p.label.participant for p in patches} == {0, 1, 2, 3}
    assert all((p.label.force_n > 0) == p.label.touch for p in patches)


@pytest.mark.parametrize("damage", ["text", "half", "no_field", "lengths"])
def test_a_damaged_shard_is_named(shard_folder: Path, tmp_path: Path, damage: str) -> None:
    good, bad = shard_folder / "shard-0.npz", tmp_path / "bad.npz"
    arrays = dict(np.load(good))
    metas = json.loads(str(arrays["meta"]))
    if damage == "text":
        bad.write_text("not a shard")
    elif damage == "half":
        bad.write_bytes(good.read_bytes()[:5000])
    elif damage == "no_field":
        del metas[0]["place"]
        np.savez(bad, **{**arrays, "meta": np.array(json.dumps(metas))})
    else:
        np.savez(bad, **{**arrays, "albedo": arrays["albedo"][1:]})
    with pytest.raises(SourceError):
        read_shard(bad)


def test_an_empty_folder_says_how_to_fill_it(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="Render some first"):
        read_folder(tmp_path)


def test_no_participant_is_on_both_sides(shard_folder: Path) -> None:
    labels = [p.label for p in read_folder(shard_folder)]
    marked = held_out(labels, 0.3)
    inside = {label.participant for label, m in zip(labels, marked, strict=True) if m}
    outside = {label.participant for label, m in zip(labels, marked, strict=True) if not m}
    assert inside and outside and not inside & outside
    assert marked.mean() >= 0.3
    assert min(inside) > max(outside)


def test_with_two_participants_whole_scenes_are_held_out(shard_folder: Path) -> None:
    labels = [p.label for p in read_folder(shard_folder) if p.label.participant < 2]
    marked = held_out(labels, 0.3)
    sides = [{label.scene for label, m in zip(labels, marked, strict=True) if m == side} for side in (True, False)]
    assert all(sides) and not sides[0] & sides[1]


def test_a_view_depends_on_its_seed_alone(shard_folder: Path) -> None:
    dataset = PatchDataset(read_folder(shard_folder)[:2])
    first, again, other = dataset[0, 7], dataset[0, 7], dataset[0, 8]
    assert torch.equal(first.patch, again.patch) and torch.equal(first.polar, again.polar)
    assert not torch.equal(first.patch, other.patch)
    assert first.patch.shape == (1, 3, 100, 100) and abs(float(first.patch.mean())) < 1e-3


def test_half_of_the_views_know_the_host_and_mirroring_negates_theta(shard_folder: Path) -> None:
    rendered = read_folder(shard_folder)[0]
    polars = np.array([view(rendered, np.random.default_rng(seed))[1] for seed in range(300)])
    unknown = (polars == 0).all(1)
    assert 0.4 < unknown.mean() < 0.6
    known = polars[~unknown]
    assert known[:, 0].mean() == pytest.approx(rendered.label.r_palms, rel=0.05)
    assert 0.35 < (known[:, 1] < 0).mean() < 0.65
    assert np.abs(known[:, 1]).mean() == pytest.approx(rendered.label.theta_rad, abs=0.05)


def test_every_epoch_visits_every_patch_once_with_new_cameras() -> None:
    order = SeededOrder(50, seed=3)
    first, again = list(order), list(order)
    order.epoch = 1
    second = list(order)
    assert first == again
    assert sorted(i for i, _ in first) == sorted(i for i, _ in second) == list(range(50))
    assert not {s for _, s in first} & {s for _, s in second}


def test_fixed_views_are_fixed(shard_folder: Path) -> None:
    rendered = read_folder(shard_folder)[:3]
    index, batch = fixed_views(rendered, views=2, seed=1)
    assert index == [0, 1, 2, 0, 1, 2] and batch.patch.shape == (6, 1, 3, 100, 100)
    assert torch.equal(batch.patch, fixed_views(rendered, views=2, seed=1)[1].patch)
    assert torch.equal(collate([PatchDataset(rendered, ordinary=True)[0, 5]]).patch[0], PatchDataset(rendered, ordinary=True)[0, 5].patch)


def test_only_hovers_lose_their_host(shard_folder: Path) -> None:
    touch, hover = read_folder(shard_folder)[:2]
    assert touch.label.touch and not hover.label.touch
    dataset = PatchDataset([touch, hover], air_share=0.5)
    heights = [[float(dataset[index, seed].hover_mm[0]) for seed in range(40)] for index in (0, 1)]
    assert set(heights[0]) == {0.0}
    assert set(heights[1]) == {8.0, 30.0}


def test_rare_fingers_are_drawn_more_often(shard_folder: Path) -> None:
    label = read_folder(shard_folder)[0].label
    weights = finger_weights([replace(label, finger="thumb")] * 4 + [label] * 16)
    draws = [index for index, _ in SeededOrder(20, 0, weights)]
    assert weights[:4].sum() / weights.sum() == pytest.approx(1 / 3)
    assert len(draws) == 20 and set(draws) <= set(range(20))


def test_a_film_is_read_with_the_truth_of_every_frame(film_folder: Path) -> None:
    films = read_folder(film_folder)
    assert len(films) == 8
    film = films[1]
    assert film.shown == (1, 1, 0, 2) and len(film.layers) == 3 and film.fps == 30
    assert [label.touch for label in film.labels] == [False, False, True, True]
    assert [label.force_n for label in film.labels] == [0.0, 0.0, 0.6, 1.4]
    assert [label.hover_mm for label in film.labels] == [8.0, 3.0, 0.0, 0.0]


def test_a_folder_of_films_and_patches_is_refused(film_folder: Path, shard_folder: Path, tmp_path: Path) -> None:
    for shard in (*film_folder.glob("*"), *shard_folder.glob("*")):
        (tmp_path / shard.name).write_bytes(shard.read_bytes())
    with pytest.raises(SourceError, match="films and patches"):
        read_folder(tmp_path)


@pytest.mark.parametrize("damage", ["half", "no_field", "beyond"])
def test_a_damaged_shard_of_films_is_named(film_folder: Path, tmp_path: Path, damage: str) -> None:
    good, bad = film_folder / "films-0.npz", tmp_path / "films-bad.npz"
    arrays = dict(np.load(good))
    metas = json.loads(str(arrays["meta"]))
    if damage == "half":
        bad.write_bytes(good.read_bytes()[:5000])
    else:
        if damage == "no_field":
            del metas[0]["shown"]
        else:
            metas[0]["shown"] = [0, 1, 2, 3]
        np.savez(bad, **{**arrays, "meta": np.array(json.dumps(metas))})
    with pytest.raises(SourceError):
        read_films(bad)


def test_one_camera_films_all_frames_and_a_fast_finger_smears(film_folder: Path) -> None:
    film = replace(read_folder(film_folder)[0], shown=(1, 1, 1, 1))
    still = replace(film, velocity_px=np.zeros((4, 2)))
    differences, smears = [], []
    for seed in range(12):
        images, polar = view_film(still, np.random.default_rng(seed))
        fast, same = view_film(film, np.random.default_rng(seed))
        np.testing.assert_array_equal(polar, same)
        assert images.shape == (4, 100, 100, 3) and images.dtype == np.uint8 and len(set(map(tuple, polar))) == 1
        other, _ = view_film(still, np.random.default_rng(seed + 100))
        colour = images.mean((1, 2))
        differences.append((np.ptp(colour, axis=0).max(), np.abs(colour[0] - other.mean((1, 2))[0]).max()))
        smears.append(float(np.abs(fast[0].astype(int) - images[0]).mean() - np.abs(fast[3].astype(int) - images[3]).mean()))
    within, between = np.median(differences, axis=0)
    assert between > 3 * within
    assert max(smears) > 1


def test_some_frames_of_a_film_are_those_that_all_frames_show(film_folder: Path) -> None:
    film = read_folder(film_folder)[0]
    heights = np.array([label.hover_mm for label in film.labels])
    seen = [PatchDataset([film], frames=2)[0, seed] for seed in range(20)]
    assert all(sample.patch.shape[0] == 2 and (np.diff(sample.hover_mm) <= 0).all() for sample in seen)
    assert {float(height) for sample in seen for height in sample.hover_mm} == set(heights.tolist())
    _, every = view_film(film, np.random.default_rng(4))
    _, two = view_film(film, np.random.default_rng(4), chosen=(1, 3))
    assert two.shape == (2, 2) and (every == 0).all() == (two == 0).all()
    assert PatchDataset([film])[0, 1].patch.shape[0] == PatchDataset([film], frames=9)[0, 1].patch.shape[0] == 4


def test_a_film_in_the_air_has_clutter_for_a_host(film_folder: Path) -> None:
    film = read_folder(film_folder)[0]
    hover = replace(film, labels=(film.labels[0],) * 4)
    air = before_clutter(hover, np.random.default_rng(0))
    assert all((layers.segment != 1).all() for layers in air.layers)
    assert {label.hover_mm for label in air.labels} == {HOVER_MAX_MM}
    np.testing.assert_array_equal(air.layers[0].albedo[air.layers[0].segment == 0], air.layers[1].albedo[air.layers[1].segment == 0])
    told = [PatchDataset([one], air_share=1.0)[0, 1].hover_mm.tolist() for one in (film, hover)]
    assert told == [[8.0, 3.0, 0.0, 0.0], [HOVER_MAX_MM] * 4]


def test_a_sheet_shows_a_film_a_row(film_folder: Path, tmp_path: Path) -> None:
    assert film_sheet(film_folder, rows=3).shape == (300, 400, 3)
    with pytest.raises(SourceError, match="no films"):
        film_sheet(tmp_path)
