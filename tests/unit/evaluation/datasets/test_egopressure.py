from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import MissingExtraError, SourceError
from egotouch_sdk.evaluation.datasets.egopressure import find_egopressure
from egotouch_sdk.evaluation.datasets.recording import LabelledRecording
from egotouch_sdk.evaluation.datasets.run import score_recording
from egotouch_sdk.joints import HandJoint, Handedness
from egotouch_sdk.touch import TouchModel
from tests.support.datasets import HEIGHT_M, LENS, write_egopressure
from tests.support.study import colour_model, memory_model

pytest.importorskip("pyarrow")
TOUCH = "xx....######....xx"


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(colour_model(tmp_path_factory.mktemp("model"), force_n=2.5))


def load(folder: Path, number: int = 0) -> LabelledRecording:
    return find_egopressure(folder)[number].load()


def test_only_index_presses_are_found_with_their_gesture(tmp_path: Path) -> None:
    for gesture in ("high_x5", "no-contact_5x", "pull_x5", "rotate-right_x5_2"):
        write_egopressure(tmp_path, "p_002", gesture, "..#")
    (tmp_path / "data" / "p_002" / "p_002_draw_word_5x_right").mkdir()
    recordings = [found.load() for found in find_egopressure(tmp_path)]
    assert [(each.conditions["gesture"], each.is_hover, each.is_drag) for each in recordings] == [
        ("high", False, False), ("no-contact", True, False), ("pull", False, True), ("rotate-right", False, True),
    ]  # fmt: skip


def test_counts_become_newtons_and_depth_becomes_height(tmp_path: Path) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH)
    labels = load(tmp_path).labels
    assert sorted(labels) == list(range(3, 17))
    assert [labels[frame].touch for frame in range(3, 17)] == [letter == "#" for letter in TOUCH[2:-2]]
    assert labels[8].force_n == pytest.approx(2.0, rel=1e-5) and np.isnan(labels[8].hover_mm)
    assert labels[3].hover_mm == pytest.approx(12.0) and np.isnan(labels[3].force_n)


def test_joints_appear_where_the_camera_sees_them(tmp_path: Path) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH, hand="left")
    recording = load(tmp_path)
    assert recording.touching_hand is Handedness.LEFT and recording.landmarks is not None
    (hand,) = recording.landmarks[8]
    assert hand.handedness is Handedness.LEFT
    assert hand.xy_px(HandJoint.INDEX_FINGER_TIP) == pytest.approx([LENS["cx"], LENS["cy"]])
    dip_px = LENS["fy"] * 0.016 / (HEIGHT_M - 0.008)
    assert hand.xy_px(HandJoint.INDEX_FINGER_DIP) == pytest.approx([LENS["cx"], LENS["cy"] + dip_px], abs=1e-3)


def test_presses_are_scored_by_the_joints_that_the_data_set_brings(tmp_path: Path, model: TouchModel) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH)
    score = score_recording(load(tmp_path), model)
    assert (score.touches, score.clicks, score.false_touches, score.participant) == (1, 1, 0, "p_001")
    assert len(score.touch) == 14 and score.frames["raw", 0].accuracy == 1.0
    assert score.true_n[score.touch] == pytest.approx([2.0] * 6, rel=1e-5) and score.told_n[5] == pytest.approx(2.5)


def test_a_model_with_memory_remembers_the_finger_through_a_recording(tmp_path: Path) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH)
    median_n = score_recording(load(tmp_path), TouchModel(memory_model(tmp_path))).told_n
    assert [round(force_n / 0.1) for force_n in median_n] == list(range(14))


def test_a_model_with_memory_forgets_the_finger_where_a_recording_stalls(tmp_path: Path) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH)
    model, recording = TouchModel(memory_model(tmp_path)), load(tmp_path)
    flowing, stalling = (score_recording(recording, model, TouchConfig(state={"stall_ms": stall_ms})) for stall_ms in (250.0, 20.0))
    assert flowing.frames["raw", 0].accuracy < 1.0 == stalling.frames["raw", 0].accuracy


def test_a_dropped_picture_is_a_gap_and_no_shift(tmp_path: Path, model: TouchModel) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", TOUCH, dropped=5)
    score = score_recording(load(tmp_path), model)
    assert len(score.touch) == 13 and score.frames["raw", 0].accuracy == 1.0


def test_a_hard_press_counts_as_the_range_ends(tmp_path: Path) -> None:
    import pyarrow as pa
    from pyarrow import parquet

    path = write_egopressure(tmp_path, "p_001", "high_x5", "..#") / "pressure.parquet"
    grids = [np.zeros((105, 185)), np.zeros((105, 185)), np.full((105, 185), 1.0)]
    parquet.write_table(pa.table({"frame": [1, 2, 3], "force": [grid.ravel().tolist() for grid in grids]}), path)
    assert load(tmp_path).labels[3].force_n == 3.5


@pytest.mark.parametrize("shard", ["cam-d.color.parquet", "pressure.parquet", "annotation.parquet"])
def test_a_missing_or_damaged_shard_is_named(tmp_path: Path, shard: str, model: TouchModel) -> None:
    path = write_egopressure(tmp_path, "p_001", "high_x5", "..#") / shard
    path.write_bytes(b"PAR1 is not all")
    with pytest.raises(SourceError, match=rf"{shard} is not a readable shard"):
        score_recording(load(tmp_path), model)
    path.unlink()
    with pytest.raises(SourceError, match=rf"{shard} is missing"):
        load(tmp_path)


def test_a_shard_without_a_column_is_named(tmp_path: Path) -> None:
    import pyarrow as pa
    from pyarrow import parquet

    path = write_egopressure(tmp_path, "p_001", "high_x5", "..#") / "pressure.parquet"
    parquet.write_table(pa.table({"frame": [1, 2, 3]}), path)
    with pytest.raises(SourceError, match=r"pressure\.parquet lacks the columns force"):
        load(tmp_path)


@pytest.mark.parametrize("content", [None, "{", '{"camera_calibrations": {"1": {}}}', '{"camera_calibrations": {"0": {"fx": 1}}}'])
def test_a_wrong_config_is_named(tmp_path: Path, content: str | None) -> None:
    name = write_egopressure(tmp_path, "p_001", "high_x5", "..#").name
    config = tmp_path / "configs" / "p_001" / f"{name}.json"
    config.unlink() if content is None else config.write_text(content)
    with pytest.raises(SourceError, match=rf"{name}\.json (is missing|has no camera_calibrations)"):
        load(tmp_path)


def test_a_folder_without_sequences_or_annotations_is_named(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="there is no data/<participant>"):
        find_egopressure(tmp_path)
    write_egopressure(tmp_path, "p_001", "high_x5", "xxx")
    with pytest.raises(SourceError, match="has no annotated frame"):
        load(tmp_path)


def test_the_missing_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_egopressure(tmp_path, "p_001", "high_x5", "..#")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingExtraError, match=r"egotouch-sdk\[evaluation\]"):
        load(tmp_path)


def test_intrinsics_come_from_the_first_camera(tmp_path: Path) -> None:
    name = write_egopressure(tmp_path, "p_001", "high_x5", "..#").name
    config = tmp_path / "configs" / "p_001" / f"{name}.json"
    content = json.loads(config.read_text())
    content["camera_calibrations"]["0"]["cx"] = 100.0
    config.write_text(json.dumps(content))
    landmarks = load(tmp_path).landmarks
    assert landmarks is not None and landmarks[3][0].xy_px(HandJoint.INDEX_FINGER_TIP) == pytest.approx([100.0, LENS["cy"]])
