from __future__ import annotations

import json
from pathlib import Path

import pytest

from egotouch_sdk.cli.main import main
from tests.support.datasets import write_folder
from tests.support.study import colour_model

TOUCH = "....######.....#####...."


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_folder(tmp_path / "data", {"ann/a": TOUCH, "ann/b": TOUCH, "bob/a": TOUCH}, about={"conditions": {"light": "lamp"}})


def test_recordings_are_scored_and_reported_without_the_papers_figures(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "report.md"
    model = str(colour_model(tmp_path))
    assert main(["evaluate", "dataset", "folder", str(folder), "--model", model, "--report", str(report), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["counts"]["participants"] == 2 and told["counts"]["rounds"] == 3 and told["dataset"] == "folder"
    assert told["overall"]["click_accuracy"]["pooled"] == 1.0 and set(told["participants"]) == {"ann", "bob"}
    assert "# Touch model on folder" in report.read_text() and "Simulation" not in report.read_text()
    assert main(["evaluate", "dataset", "folder", str(folder), "--model", model]) == 0
    assert "paper" not in capsys.readouterr().out


def test_participants_and_recordings_can_be_chosen(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = str(colour_model(tmp_path))
    arguments = ["evaluate", "dataset", "folder", str(folder), "--model", model, "--participants", "ann", "--limit", "1", "--json"]
    assert main(arguments) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["counts"]["rounds"] == 1 and list(told["participants"]) == ["ann"]
    assert main([*arguments[:-5], "--participants", "eve"]) == 1
    assert "there is no participant eve. There are: ann, bob" in capsys.readouterr().err


@pytest.mark.parametrize(("kind", "missing"), [("palmpad", "group_1"), ("egopressure", "data/<participant>"), ("folder", "labels.csv")])
def test_a_folder_of_another_kind_is_named(kind: str, missing: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "dataset", kind, str(tmp_path)]) == 1
    assert missing in capsys.readouterr().err


def test_hands_that_are_never_seen_are_an_error_with_a_next_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = write_folder(tmp_path / "data", {"ann/a": "..##.."}, landmarks=False)
    assert main(["evaluate", "dataset", "folder", str(folder), "--model", str(colour_model(tmp_path))]) == 1
    assert "not one frame has an open gate" in capsys.readouterr().err


def test_the_help_describes_the_layout(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["evaluate", "dataset", "--help"])
    assert "labels.csv       frame,touch[,force_n][,hover_mm]" in capsys.readouterr().out
