from __future__ import annotations

import json
from pathlib import Path

import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.folds import Folds, read_folds


def written(folder: Path, content: object) -> Path:
    (folder / "a.onnx").touch()
    (folder / "b.onnx").touch()
    path = folder / "folds.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def test_each_participant_has_the_model_of_its_fold(tmp_path: Path) -> None:
    content = {"folds": [{"participants": [0, 2], "model": "a.onnx"}, {"participants": [1], "model": "b.onnx"}]}
    folds = read_folds(written(tmp_path, content))
    assert [folds.model_of(number) for number in (0, 1, 2)] == [tmp_path / "a.onnx", tmp_path / "b.onnx", tmp_path / "a.onnx"]
    assert folds.are_held_out
    folds.check([0, 1, 2])
    with pytest.raises(SourceError, match="participants 3, 4 are in no fold"):
        folds.check([0, 3, 4])


def test_one_model_may_score_all() -> None:
    folds = Folds({}, Path("model.onnx"))
    folds.check(range(15))
    assert folds.model_of(3) == Path("model.onnx") and not folds.are_held_out
    assert Folds({}).model_of(0) is None


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        ("no json", "is not a folds file"),
        ({"fold": []}, "is not a folds file"),
        ({"folds": [{"participants": 3, "model": "a.onnx"}]}, "is not a folds file"),
        ({"folds": []}, "holds no participants"),
        ({"folds": [{"participants": [1, 1], "model": "a.onnx"}]}, "has a participant in two folds"),
        ({"folds": [{"participants": [1], "model": "gone.onnx"}]}, r"gone\.onnx, which is not there"),
    ],
)
def test_a_wrong_file_is_named(tmp_path: Path, content: object, complaint: str) -> None:
    with pytest.raises(SourceError, match=complaint):
        read_folds(written(tmp_path, content))
    with pytest.raises(SourceError, match="cannot read"):
        read_folds(tmp_path / "absent.json")
