from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.joints import Finger
from egotouch_sdk.study_data import RoundMeta, StudyRecipe, StudyRound, TouchType, open_study, read_round, write_recipe, write_round
from tests.support.study import META, study_round, write_study

ARRAYS = ("patches", "polar", "timestamp_ns", "touch", "force_n", "hover_mm", "gate")


def altered(study: StudyRound, **changes: object) -> StudyRound:
    arrays = {name: getattr(study, name) for name in ARRAYS}
    return StudyRound(**{"meta": study.meta, **arrays, **changes})


def test_a_round_comes_back_as_it_was_written(tmp_path: Path) -> None:
    meta = {"participant": 3, "round": 17, "lux": 320.0, "acts": ({"kind": "tap", "start_frame": 2},)}
    written = study_round("x..##.", **meta)
    path = write_round(tmp_path, written)
    read = read_round(path)
    assert path.name == "p03-r017.npz" and [file.name for file in tmp_path.iterdir()] == [path.name]
    assert read.meta == written.meta
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(read, name), getattr(written, name))
        assert getattr(read, name).dtype == getattr(written, name).dtype


def test_a_study_lists_its_rounds_by_participant(tmp_path: Path) -> None:
    rounds = [study_round("..#", participant=p, round=r) for p in (0, 1) for r in (0, 1)]
    study = open_study(write_study(tmp_path, rounds))
    assert study.expected == 4 and study.recipe.sizes == {"frame_px": [960, 720]}
    assert {p: [f.name for f in files] for p, files in study.files_of().items()} == {
        0: ["p00-r000.npz", "p00-r001.npz"],
        1: ["p01-r000.npz", "p01-r001.npz"],
    }
    assert [each.meta.round for each in study.rounds()] == [0, 1, 0, 1]


def test_a_round_cannot_be_changed() -> None:
    study = study_round("..#")
    with pytest.raises(ValueError, match="read-only"):
        study.touch[0] = True


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("patches", np.zeros((3, 50, 50, 3), np.uint8)),
        ("patches", np.zeros((3, 100, 100, 3), np.float32)),
        ("polar", np.zeros((2, 2), np.float32)),
        ("polar", np.full((3, 2), np.nan, np.float32)),
        ("timestamp_ns", np.array([0, 5, 5])),
        ("touch", np.array([0, 0, 1])),
        ("force_n", np.array([0.0, 0.0, 9.0], np.float32)),
        ("force_n", np.array([0.5, 0.0, 1.0], np.float32)),
        ("hover_mm", np.array([1.0, -1.0, 0.0], np.float32)),
        ("hover_mm", np.array([1.0, 1.0, 2.0], np.float32)),
        ("gate", np.array([True])),
    ],
)
def test_an_array_that_cannot_be_is_named(name: str, value: object) -> None:
    with pytest.raises(SourceError, match=f"^{name} of a round is"):
        altered(study_round("..#"), **{name: value})


@pytest.mark.parametrize(("name", "value"), [("fitzpatrick", 0), ("participant", -1), ("fps", 0.0), ("lux", float("nan")), ("light", "")])
def test_a_meta_field_out_of_range_is_named(name: str, value: object) -> None:
    with pytest.raises(SourceError, match=f"{name} of a round is"):
        replace(META, **{name: value})


def test_meta_of_a_later_version_is_read_and_a_lack_is_named() -> None:
    data = json.loads(json.dumps({name: getattr(META, name) for name in META.__slots__})) | {"later": 1}
    assert RoundMeta.from_dict(data) == META
    with pytest.raises(SourceError, match="meta of a round lacks 'finger'"):
        RoundMeta.from_dict({name: value for name, value in data.items() if name != "finger"})
    with pytest.raises(SourceError, match="'wave' is not a valid TouchType"):
        RoundMeta.from_dict(data | {"touch_type": "wave"})


def test_a_damaged_or_renamed_file_is_named(tmp_path: Path) -> None:
    path = write_round(tmp_path, study_round("..#", touch_type=TouchType.TAP, finger=Finger.RING))
    moved = path.rename(tmp_path / "p05-r000.npz")
    with pytest.raises(SourceError, match=r"p05-r000\.npz holds the round p00-r000\.npz"):
        read_round(moved)
    moved.write_bytes(moved.read_bytes()[:100])
    with pytest.raises(SourceError, match=r"p05-r000\.npz is not a readable round"):
        read_round(moved)


def test_a_folder_without_study_is_named(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"no readable study\.json"):
        open_study(tmp_path)
    (tmp_path / "study.json").write_text("{}")
    with pytest.raises(SourceError, match="not the recipe of a study"):
        open_study(tmp_path)
    write_recipe(tmp_path, StudyRecipe(seed=0, fps=30.0, participants=1, rounds=1, seconds_per_round=1.0))
    with pytest.raises(SourceError, match="there is no round"):
        open_study(tmp_path)
    with pytest.raises(SourceError, match="participants is 0"):
        StudyRecipe(seed=0, fps=30.0, participants=0, rounds=1, seconds_per_round=1.0)
