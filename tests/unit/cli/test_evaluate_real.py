from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.cli.main import main
from tests.support.study import memory_model, signal_model

HEADER = "file,recording,frame,label,press_strength,label_confidence,force_sensor_counts\n"


@pytest.fixture
def pictures(tmp_path: Path) -> Path:
    folder = tmp_path / "pictures"
    folder.mkdir()
    rows = ""
    for number in range(8):
        is_touch = number % 2 == 0
        cv2.imwrite(str(folder / f"{number}.png"), np.full((480, 640, 3), 60 if is_touch else 160, np.uint8))
        rows += f"{number}.png,push{number // 4},{number},{'touch' if is_touch else 'hover'},,0.9,{20 + number if is_touch else ''}\n"
    (folder / "labels.csv").write_text(HEADER + rows)
    return folder


@pytest.fixture
def video(tmp_path: Path) -> Path:
    path = tmp_path / "empty.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 30, (64, 48))
    for _ in range(30):
        writer.write(np.full((48, 64, 3), 90, np.uint8))
    writer.release()
    return path


def test_real_pictures_are_told_by_recording_with_the_darkness_rule(
    pictures: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "real.md"
    model = str(signal_model(tmp_path))
    assert main(["evaluate", "real", str(pictures), "--model", model, "--report", str(report)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[3:]] == ["push0", "push1", "pooled"] and "threshold 0.600" in lines[0]
    assert lines[1] == "judged every picture alone, since the model has no memory"
    assert "| pooled | 4 | 4 | 0.500 [0.50, 0.50] | 1.000 [1.00, 1.00] |" in report.read_text()
    assert "## Force by recording" in report.read_text()
    assert main(["evaluate", "real", str(pictures), "--model", model, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["pooled"]["darkness_auroc"] == 1.0 and told["recordings"]["push0"]["touches"] == 2


def test_a_model_that_remembers_judges_pictures_as_a_film_or_as_stills(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "pictures"
    folder.mkdir()
    rows = ""
    for number, label in enumerate(["none", "unclear", "touch", "hover"]):
        cv2.imwrite(str(folder / f"{number}.png"), np.full((480, 640, 3), (60, 80, 200) if label == "touch" else (200, 80, 60), np.uint8))
        rows += f"{number}.png,push,{number},{label},,0.9,\n"
    (folder / "labels.csv").write_text(HEADER + rows)
    report, arguments = tmp_path / "real.md", ["evaluate", "real", str(folder), "--model", str(memory_model(tmp_path))]
    told = {}
    for judged, options in (("film", []), ("stills", ["--stills"])):
        assert main([*arguments, *options, "--json", "--report", str(report)]) == 0
        told[judged] = json.loads(capsys.readouterr().out)
        assert told[judged]["judged"] == judged and told[judged]["pooled"]["touches"] == told[judged]["pooled"]["hovers"] == 1
        assert ("as films at 30 frames per second" if judged == "film" else "- Judged: every picture alone\n") in report.read_text()
    assert (told["film"]["pooled"]["true_positive_rate"], told["stills"]["pooled"]["true_positive_rate"]) == (0.0, 1.0)


def test_false_touches_are_told_by_clip_and_pooled(video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = tmp_path / "false.md"
    arguments = ["evaluate", "false-touches", str(video), str(video), "--model", str(signal_model(tmp_path)), "--report", str(report)]
    assert main([*arguments, "--json"]) == 0
    clips = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(Path(clip["video"]).name, clip["frames"], clip["downs"]) for clip in clips] == [
        ("empty.avi", 30, 0),
        ("empty.avi", 30, 0),
        ("all", 60, 0),
    ]
    assert clips[-1]["interval_per_minute"][1] > 60
    assert "| **all** | 2.0 | 0.0 | 0 | 0.00 |" in report.read_text()


def test_a_gate_that_never_opens_is_told(video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["evaluate", "false-touches", str(video), "--model", str(signal_model(tmp_path))]
    assert main(arguments) == 0
    assert capsys.readouterr().out.endswith("It never opened, so the touch model was never asked: see --without-gate.\n")
    assert main([*arguments, "--without-gate"]) == 0
    assert "No gate: every outstretched finger is shown to the model." in capsys.readouterr().out


@pytest.mark.parametrize("kind", ["real", "false-touches"])
def test_a_report_that_cannot_be_written_is_refused_before_any_work(kind: str, pictures: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", kind, str(pictures), "--report", "report.pdf"]) == 1
    assert "neither .html nor .md" in capsys.readouterr().err
