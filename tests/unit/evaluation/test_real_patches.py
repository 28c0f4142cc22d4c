import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.real_estimates import estimate_film, estimate_stills
from egotouch_sdk.evaluation.real_patches import RealPatch, read_real_patches, real_report
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate
from egotouch_sdk.touch import TouchModel
from tests.support.study import memory_model

HEADER = "file,recording,frame,label,press_strength,label_confidence,force_sensor_counts\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "image").mkdir()
    picture = np.full((480, 640, 3), 120, np.uint8)
    picture[:175] = (10, 20, 200)
    for name in ("a.png", "b.png", "c.png", "d.png"):
        cv2.imwrite(str(tmp_path / "image" / name), picture)
    rows = "a.png,one,1,touch,hard,0.9,55\nb.png,one,2,hover,,0.9,0\nc.png,two,3,hover,,0.5,\nd.png,two,4,none,,0.9,\n"
    (tmp_path / "labels.csv").write_text(HEADER + rows)
    return tmp_path


def test_confident_touches_and_hovers_are_read_and_cut_at_the_tip(folder: Path) -> None:
    patches = read_real_patches(folder, (316.0, 175.0), 7.3, 0.7)
    assert [(p.file, p.touch, p.sensor_counts) for p in patches] == [("a.png", True, 55.0), ("b.png", False, 0.0)]
    image = patches[0].image
    assert image.shape == (100, 100, 3)
    assert image[10, 50].tolist() == pytest.approx([200, 20, 10], abs=2)
    assert image[90, 50].tolist() == pytest.approx([120, 120, 120], abs=2)


def test_the_other_pictures_come_as_history_of_a_film(folder: Path) -> None:
    patches = read_real_patches(folder, (316.0, 175.0), 7.3, 0.7, history=True)
    assert [(p.file, p.recording, p.frame, p.scored) for p in patches] == [
        ("a.png", "one", 1, True), ("b.png", "one", 2, True), ("c.png", "two", 3, False), ("d.png", "two", 4, False),
    ]  # fmt: skip


@pytest.mark.parametrize("damage", ["no_table", "no_column", "nothing_left", "no_picture", "bad_picture"])
def test_a_damaged_folder_is_named(folder: Path, damage: str) -> None:
    if damage == "no_table":
        (folder / "labels.csv").unlink()
    elif damage == "no_column":
        (folder / "labels.csv").write_text("file,label\na.png,touch\n")
    elif damage == "nothing_left":
        (folder / "labels.csv").write_text(HEADER)
    elif damage == "no_picture":
        (folder / "image" / "a.png").unlink()
    else:
        (folder / "image" / "a.png").write_text("no picture")
    with pytest.raises(SourceError):
        read_real_patches(folder, (316.0, 175.0), 7.3, 0.7)


def test_the_report_counts_per_recording_and_pooled() -> None:
    image = np.zeros((100, 100, 3), np.uint8)
    rows = [
        ("one", True, 0.9, 1.0, 10.0),
        ("one", False, 0.2, 0.0, np.nan),
        ("two", True, 0.4, 2.0, 20.0),
        ("two", False, 0.6, 0.0, np.nan),
    ]
    patches = [RealPatch("x", name, 1, touch, counts, image) for name, touch, _, _, counts in rows]
    estimates = [TouchEstimate(0, Finger.THUMB, p, force) for _, _, p, force, _ in rows]
    report = real_report(patches, estimates, 0.5, draws=200)
    assert report["recordings"]["one"]["accuracy"] == 1.0 and report["recordings"]["two"]["accuracy"] == 0.0
    pooled = report["pooled"]
    assert {name: value for name, value in pooled.items() if not name.endswith("_interval")} == {
        "touches": 2, "hovers": 2, "auroc": 0.75, "darkness_auroc": 0.5, "true_positive_rate": 0.5, "false_positive_rate": 0.5,
        "accuracy": 0.5, "force_spearman": None, "force_spearman_above_floor": None,
    }  # fmt: skip
    assert pooled["accuracy_interval"] == [0.0, 1.0] and pooled["force_spearman_interval"] is None


def test_force_is_ranked_with_and_without_the_sensors_floor() -> None:
    image = np.zeros((100, 100, 3), np.uint8)
    counts = [0.0, 3.0, 20.0, 30.0, 40.0, 50.0, np.nan]
    told_n = [3.0, 2.5, 1.0, 1.5, 2.0, 2.2, 3.5]
    patches = [RealPatch("x", "one", 1, True, count, image) for count in counts] + [RealPatch("x", "one", 1, False, 99.0, image)]
    estimates = [TouchEstimate(0, Finger.THUMB, 0.9, force_n) for force_n in (*told_n, 0.0)]
    scores = real_report(patches, estimates, 0.5, draws=200)["recordings"]["one"]
    assert scores["force_spearman_above_floor"] == 1.0 and scores["force_spearman"] == pytest.approx(1 - 6 * 50 / (6 * 35), abs=1e-4)
    low, high = scores["force_spearman_interval"]
    assert -1 <= low < high <= 1


RED, BLUE = (200, 80, 60), (60, 80, 200)


def thumb(recording: str, frame: int | None, colour: tuple[int, int, int], scored: bool = True) -> RealPatch:
    return RealPatch("x", recording, frame, colour is RED, np.nan, np.full((100, 100, 3), colour, np.uint8), scored)


@pytest.fixture(scope="module")
def remembering(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(memory_model(tmp_path_factory.mktemp("model")))


def remembered(patches: list[RealPatch], model: TouchModel) -> list[int]:
    return [round(estimate.force_n / 0.1) for estimate in estimate_film(patches, model)]


def test_the_pictures_of_a_film_follow_their_numbers_whatever_their_order(remembering: TouchModel) -> None:
    patches = [thumb("one", 12, RED), thumb("one", 10, BLUE), thumb("two", 11, RED), thumb("one", 11, BLUE)]
    assert remembered(patches, remembering) == [3, 1, 1, 2]
    film, stills = estimate_film(patches, remembering), estimate_stills(patches, remembering)
    assert [each.touch_probability > 0.5 for each in film] == [False, False, True, False]
    assert [each.touch_probability > 0.5 for each in stills] == [True, False, True, False]


def test_frames_that_a_film_lacks_are_a_gap_in_time(remembering: TouchModel) -> None:
    assert remembered([thumb("one", frame, RED) for frame in (1, 2, 6, 11)], remembering) == [1, 2, 3, 1]


def test_history_is_remembered_and_not_scored(remembering: TouchModel) -> None:
    patches = [thumb("one", 1, BLUE, scored=False), thumb("one", 2, BLUE, scored=False), thumb("one", 3, RED), thumb("one", 4, BLUE)]
    film = real_report(patches, estimate_film(patches, remembering), 0.5, draws=200)["pooled"]
    stills = real_report(patches, estimate_stills(patches, remembering), 0.5, draws=200)["pooled"]
    assert (film["touches"], film["hovers"], film["accuracy"]) == (1, 1, 0.5)
    assert (stills["touches"], stills["hovers"], stills["accuracy"]) == (1, 1, 1.0)


@pytest.mark.parametrize(("frames", "complaint"), [((1, 1), "recording one has frame 1 2 times"), ((1, None), "no whole frame number")])
def test_pictures_without_a_number_of_their_own_are_no_film(
    frames: tuple[int | None, ...], complaint: str, remembering: TouchModel
) -> None:
    patches = [thumb("one", frame, RED) for frame in frames]
    with pytest.raises(SourceError, match=complaint):
        estimate_film(patches, remembering)
    assert len(estimate_stills(patches, remembering)) == 2


@pytest.mark.real_data
@pytest.mark.skipif("EGOTOUCH_REAL_DIR" not in os.environ, reason="EGOTOUCH_REAL_DIR is not set")
def test_the_shipped_model_reaches_the_goal_on_real_thumb_patches() -> None:
    patches = read_real_patches(Path(os.environ["EGOTOUCH_REAL_DIR"]) / "thumb_patches", (316.0, 175.0), 7.3, 0.7, history=True)
    model = TouchModel()
    pooled = real_report(patches, estimate_film(patches, model), model.manifest.down_probability)["pooled"]
    assert pooled["auroc"] >= 0.97 and pooled["accuracy"] >= 0.90


@pytest.mark.real_data
@pytest.mark.skipif("EGOTOUCH_REAL_DIR" not in os.environ, reason="EGOTOUCH_REAL_DIR is not set")
def test_the_shipped_model_beats_the_darkness_rule_on_every_recording() -> None:
    patches = read_real_patches(Path(os.environ["EGOTOUCH_REAL_DIR"]) / "thumb_patches", (316.0, 175.0), 7.3, 0.7, history=True)
    model = TouchModel()
    report = real_report(patches, estimate_film(patches, model), model.manifest.down_probability)
    for scores in (report["pooled"], *report["recordings"].values()):
        assert scores["auroc"] > scores["darkness_auroc"]
