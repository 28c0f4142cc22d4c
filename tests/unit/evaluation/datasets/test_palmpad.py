from __future__ import annotations

import json
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import egotouch_sdk
from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.datasets.palmpad import find_palmpad
from egotouch_sdk.evaluation.datasets.run import score_recording
from egotouch_sdk.sources import open_frames
from egotouch_sdk.touch import TouchModel
from tests.support.datasets import write_palmpad
from tests.support.study import colour_model

ASSETS = Path(egotouch_sdk.__file__).parent / "assets"
TOUCH = "...####..."


def test_users_of_two_groups_are_different_people(tmp_path: Path) -> None:
    for group, user, take in ((1, 1, 0), (1, 1, 1), (1, 12, 0), (2, 1, 0)):
        write_palmpad(tmp_path, group, user, "..", take=take)
    found = find_palmpad(tmp_path)
    assert [(each.participant, each.name) for each in found] == [
        ("g1-u01", "user-1_0"), ("g1-u01", "user-1_1"), ("g1-u12", "user-12_0"), ("g2-u01", "user-1_0"),
    ]  # fmt: skip
    assert found[-1].load().conditions == {"group": "2"}


@pytest.mark.parametrize("unit", [1.0, 1e3, 1e6, 1e9])
def test_labels_and_times_are_those_of_the_table_whatever_its_unit(tmp_path: Path, unit: float) -> None:
    path = write_palmpad(tmp_path, 1, 3, TOUCH)
    lines = [f"{1.7e9 * unit + frame * unit / 20:.6f} {int(letter == '#')} 600" for frame, letter in enumerate(TOUCH)]
    path.with_suffix(".txt").write_text("\n".join(lines))
    recording = find_palmpad(tmp_path)[0].load()
    frames = list(recording.read())
    assert [recording.labels[frame.index].touch for frame in frames] == [letter == "#" for letter in TOUCH]
    assert [frame.timestamp_ns for frame in frames] == pytest.approx([n * 50_000_000 for n in range(10)], abs=1000)
    assert recording.fps == pytest.approx(20.0, rel=1e-4)


def test_times_of_no_camera_give_way_to_those_of_the_video(tmp_path: Path) -> None:
    path = write_palmpad(tmp_path, 1, 3, TOUCH)
    path.with_suffix(".txt").write_text("\n".join(f"{n * 777} {int(letter == '#')} 1" for n, letter in enumerate(TOUCH)))
    recording = find_palmpad(tmp_path)[0].load()
    assert [frame.timestamp_ns for frame in recording.read()][1] == pytest.approx(33_333_333, abs=1000)


@pytest.mark.parametrize(
    ("lines", "complaint"),
    [
        (["Timestamp downsample raw"], "has no line with a label"),
        (["0 1 3", "1 2 3"], r"line 2 of .*user-3_0\.txt is '1 2 3'"),
        (["0 1 3", "later 0 3"], "line 2 of"),
        (["0 1 3", "1"], "line 2 of"),
    ],
)
def test_a_wrong_table_is_named(tmp_path: Path, lines: list[str], complaint: str) -> None:
    write_palmpad(tmp_path, 1, 3, TOUCH).with_suffix(".txt").write_text("\n".join(lines))
    with pytest.raises(SourceError, match=complaint):
        find_palmpad(tmp_path)[0].load()


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"there is no group_1/user-\.\.\./\*\.avi"):
        find_palmpad(tmp_path)
    write_palmpad(tmp_path, 1, 3, TOUCH).with_suffix(".txt").unlink()
    with pytest.raises(SourceError, match=r"user-3_0\.txt is missing"):
        find_palmpad(tmp_path)[0].load()


def test_a_table_of_another_video_is_refused(tmp_path: Path) -> None:
    path = write_palmpad(tmp_path, 1, 3, TOUCH)
    path.with_suffix(".txt").write_text("\n".join(f"{n} 0 1" for n in range(30)))
    with pytest.raises(SourceError, match=r"has 10 frames but user-3_0\.txt 30 labels"):
        list(find_palmpad(tmp_path)[0].load().read())


def test_two_hands_of_the_demo_clip_are_found_and_its_touch_is_told(tmp_path: Path) -> None:
    truth = json.loads((ASSETS / "demo_truth.json").read_text())
    touch = "".join("#" if frame["touching"] else "." for frame in truth["frames"][:66])
    with open_frames(str(ASSETS / "demo.mp4")) as source:
        pictures = [np.array(frame.image) for frame in islice(source, len(touch))]
    write_palmpad(tmp_path, 1, 1, touch, pictures)
    score = score_recording(find_palmpad(tmp_path)[0].load(), TouchModel(colour_model(tmp_path)))
    assert len(score.touch) > 40 and score.touches == 2 and score.touch.sum() > 8
