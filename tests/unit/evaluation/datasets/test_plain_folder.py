from __future__ import annotations

import json
from math import isnan
from pathlib import Path

import cv2
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.datasets.plain_folder import find_folder
from egotouch_sdk.evaluation.datasets.recording import LabelledRecording
from egotouch_sdk.evaluation.datasets.run import score_recording
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.touch import TouchModel
from tests.support.datasets import picture, write_folder
from tests.support.study import colour_model

TOUCH = "....######.....#####...."


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(colour_model(tmp_path_factory.mktemp("model")))


def load(folder: Path) -> LabelledRecording:
    (found,) = find_folder(folder)
    return found.load()


def test_recordings_are_found_with_their_participants(tmp_path: Path) -> None:
    write_folder(tmp_path, {"ann/tap": "..#", "bob/tap": "..#", "ann/press": "..#"})
    assert [(found.participant, found.name) for found in find_folder(tmp_path)] == [("ann", "press"), ("ann", "tap"), ("bob", "tap")]


def test_a_recording_with_landmarks_is_scored_through_the_whole_pipeline(tmp_path: Path, model: TouchModel) -> None:
    about = {"fps": 30, "finger": "index", "touching_hand": "right", "task": "drag", "conditions": {"skin tone": "III"}}
    recording = load(write_folder(tmp_path, {"ann/tap": TOUCH}, about=about))
    assert recording.is_drag and recording.conditions == {"skin tone": "III"} and recording.fps == 30.0
    score = score_recording(recording, model)
    assert (score.touches, score.clicks, score.false_touches, score.unseen) == (2, 2, 0, 0)
    assert score.frames["raw", 0].accuracy == score.frames["live", 1].accuracy == 1.0 and len(score.touch) == len(TOUCH)
    assert score.true_n[score.touch] == pytest.approx([1.2] * 11) and isnan(score.hover_mm[0])
    assert score.told_n[6] == pytest.approx(1.5)


def test_another_finger_and_another_hand_are_not_scored(tmp_path: Path, model: TouchModel) -> None:
    middle = score_recording(load(write_folder(tmp_path / "a", {"ann/tap": TOUCH}, about={"finger": "middle"})), model)
    left = score_recording(load(write_folder(tmp_path / "b", {"ann/tap": TOUCH}, about={"touching_hand": "left"})), model)
    for score in (middle, left):
        assert len(score.touch) == 0 and (score.touches, score.unseen, score.false_touches) == (0, 2, 0)


def test_frames_without_a_label_are_shown_but_not_scored(tmp_path: Path, model: TouchModel) -> None:
    write_folder(tmp_path, {"ann/tap": TOUCH})
    (tmp_path / "ann" / "tap" / "labels.csv").write_text("frame,touch,hover_mm\n4,1,\n5,1,\n11,0,7.5\n12,0,\n")
    score = score_recording(load(tmp_path), model)
    assert score.touch.tolist() == [True, True, False, False] and score.hover_mm[2] == 7.5
    assert score.live.tolist() == [False, True, False, False]


def test_without_landmarks_the_tracker_looks_for_hands_and_finds_none_in_plain_colour(tmp_path: Path, model: TouchModel) -> None:
    score = score_recording(load(write_folder(tmp_path, {"ann/tap": "..##.."}, landmarks=False)), model)
    assert len(score.touch) == 0 and score.unseen == 1


def test_pictures_may_stand_for_a_video(tmp_path: Path, model: TouchModel) -> None:
    write_folder(tmp_path, {"ann/tap": TOUCH}, about={"fps": 15})
    path = tmp_path / "ann" / "tap"
    (path / "video.avi").unlink()
    (path / "frames").mkdir()
    for number, letter in enumerate(TOUCH):
        cv2.imwrite(str(path / "frames" / f"{number}.png"), picture(letter))
    score = score_recording(load(tmp_path), model)
    assert score.frames["live", 1].accuracy == 1.0 and score.seconds == pytest.approx(len(TOUCH) / 15)


@pytest.mark.parametrize(
    ("file", "content", "complaint"),
    [
        ("labels.csv", "frame\n0\n", r"labels\.csv lacks the columns touch"),
        ("labels.csv", "frame,touch\n", r"labels\.csv has no row"),
        ("labels.csv", "frame,touch\n0,1\n1,yes\n", r"line 3 of .*labels\.csv is wrong"),
        ("labels.csv", "frame,touch,force_n\n0,1,-2\n", r"line 2 of .*labels\.csv is wrong \(force_n of a label is -2\.0"),
        ("about.json", "[]", r"about\.json is wrong"),
        ("about.json", '{"finger": "toe"}', r"about\.json is wrong \('toe' is not a valid Finger\)"),
        ("about.json", '{"task": "wave"}', r"about\.json is wrong \(task is 'wave'"),
        ("about.json", '{"tasks": "drag"}', r"there is no key tasks"),
        ("landmarks.csv", "frame,hand\n", r"landmarks\.csv lacks the columns joint, x_px"),
        ("landmarks.csv", "frame,hand,joint,x_px,y_px,z_px,x_mm,y_mm,z_mm\n0,up,0,1,1,1,1,1,1\n", r"line 2 of .*landmarks\.csv is wrong"),
        (
            "landmarks.csv",
            "frame,hand,joint,x_px,y_px,z_px,x_mm,y_mm,z_mm\n0,left,0,1,1,1,1,1,1\n",
            r"left hand of frame 0 .*joint 1 is missing",
        ),
        ("video.mp4", "", r"has video\.avi and video\.mp4"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, file: str, content: str, complaint: str) -> None:
    write_folder(tmp_path, {"ann/tap": "..#"})
    (tmp_path / "ann" / "tap" / file).write_text(content)
    with pytest.raises(SourceError, match=complaint):
        load(tmp_path)


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"there is no <participant>/<recording>/labels\.csv"):
        find_folder(tmp_path)
    write_folder(tmp_path, {"ann/tap": "..#"})
    (tmp_path / "ann" / "tap" / "video.avi").unlink()
    with pytest.raises(SourceError, match=r"neither a video\.mp4 nor a folder frames"):
        load(tmp_path)


def test_about_may_be_missing(tmp_path: Path) -> None:
    write_folder(tmp_path, {"ann/tap": "..#"})
    (tmp_path / "ann" / "tap" / "about.json").unlink()
    recording = load(tmp_path)
    assert (recording.finger, recording.touching_hand, recording.is_drag, recording.is_hover) == (Finger.INDEX, None, False, False)
    (tmp_path / "ann" / "tap" / "about.json").write_text(json.dumps({"touching_hand": "left", "task": "hover"}))
    assert load(tmp_path).touching_hand is Handedness.LEFT and load(tmp_path).is_hover
