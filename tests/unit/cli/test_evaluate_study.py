from __future__ import annotations

import json
from pathlib import Path

import pytest

from egotouch_sdk.cli.main import main
from tests.support.study import signal_model, study_round, write_study

TOUCH = "....########...."


@pytest.fixture
def study(tmp_path: Path) -> Path:
    rounds = [study_round(TOUCH, participant=p, round=r, hover_mm=0.5 + 3 * r) for p in (0, 1) for r in (0, 1)]
    return write_study(tmp_path / "study", rounds)


def test_the_main_figures_are_printed_under_the_word_simulation(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "study", str(study), "--model", str(signal_model(tmp_path))]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("Simulation.")
    assert "Click accuracy 100.0 % 100.0 ± 0.0 % 100.0 to 100.0 % 95.6 % 97.0 %" in [" ".join(line.split()) for line in lines]


def test_json_has_everything(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = signal_model(tmp_path)
    assert main(["evaluate", "study", str(study), "--model", str(model), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["models"] == [{
        "model": "signal 1", "sha256": json.loads(model.with_suffix(".json").read_text())["sha256"], "down": 0.6, "up": 0.4,
        "participants": [0, 1],
    }]  # fmt: skip
    assert told["held_out_by_folds"] is False and told["counts"]["rounds"] == 4
    assert told["overall"]["shifted_accuracy"]["mean"] == 1.0 and told["overall"]["hover_0_1_mm"]["pooled"] < 1.0


def test_folds_score_each_participant_by_its_own_model(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    signal_model(tmp_path, "good")
    signal_model(tmp_path, "wrong", gain=-1.0)
    folds = tmp_path / "folds.json"
    folds.write_text(json.dumps({"folds": [{"participants": [0], "model": "good.onnx"}, {"participants": [1], "model": "wrong.onnx"}]}))
    report = tmp_path / "out" / "study.md"
    assert main(["evaluate", "study", str(study), "--folds", str(folds), "--report", str(report), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["held_out_by_folds"] is True
    assert {name: row["auroc"] for name, row in told["participants"].items()} == {"p00": 1.0, "p01": 0.0}
    assert "each participant by a model of a fold that never saw it" in report.read_text()


def test_several_participants_at_a_time_give_the_same_figures(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["evaluate", "study", str(study), "--model", str(signal_model(tmp_path)), "--json"]
    assert main(arguments) == 0
    alone = capsys.readouterr().out
    assert main([*arguments, "--jobs", "2"]) == 0
    assert capsys.readouterr().out == alone


def test_a_study_that_is_not_finished_says_so(study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (study / "p01-r001.npz").unlink()
    report = tmp_path / "study.html"
    assert main(["evaluate", "study", str(study), "--model", str(signal_model(tmp_path)), "--report", str(report)]) == 0
    assert "Unfinished: 3 of 4 rounds are there." in capsys.readouterr().out
    assert "Unfinished: 3 of 4 rounds are there." in report.read_text()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--report", "study.pdf"], "neither .html nor .md"),
        (["--folds", "absent.json"], "cannot read absent.json"),
        (["--folds", "folds.json", "--model", "m.onnx"], "exclude each other"),
        (["--model", "absent.onnx"], "no touch model at absent.onnx"),
    ],
)
def test_mistakes_are_named(study: Path, arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "study", str(study), *arguments]) == 1
    captured = capsys.readouterr()
    assert complaint in captured.err and captured.out == ""


def test_a_folder_without_study_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "study", str(tmp_path)]) == 1
    assert "no readable study.json" in capsys.readouterr().err
