"""Whatever the user gets wrong: a non-zero exit code, one clear line on stderr, no traceback."""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

Make = Callable[[Path], list[object]]


def text_named_mp4(folder: Path) -> list[object]:
    (folder / "notes.mp4").write_text("this is a text\n" * 40)
    return ["run", folder / "notes.mp4"]


def truncated_video(folder: Path) -> list[object]:
    whole = folder / "whole.mp4"
    writer = cv2.VideoWriter(str(whole), cv2.VideoWriter.fourcc(*"mp4v"), 30.0, (96, 64))
    for _ in range(30):
        writer.write(np.zeros((64, 96, 3), np.uint8))
    writer.release()
    whole.write_bytes(whole.read_bytes()[:-700])
    return ["run", whole]


def one_pixel_picture(folder: Path) -> list[object]:
    cv2.imwrite(str(folder / "dot.png"), np.zeros((1, 1, 3), np.uint8))
    return ["hands", folder / "dot.png", "--json"]


def float_picture(folder: Path) -> list[object]:
    cv2.imwrite(str(folder / "float.tiff"), np.zeros((100, 100, 3), np.float32))
    return ["estimate", folder / "float.tiff", "--tip", "50,50", "--px-per-mm", "3"]


def text_named_png(folder: Path) -> list[object]:
    (folder / "notes.png").write_text("no picture")
    return ["estimate", folder / "notes.png", "--tip", "5,5", "--px-per-mm", "3", "--json"]


def picture(folder: Path) -> Path:
    path = folder / "tip.png"
    cv2.imwrite(str(path), np.zeros((100, 100, 3), np.uint8))
    return path


def tip_outside(folder: Path) -> list[object]:
    return ["estimate", picture(folder), "--tip", "500,5", "--px-per-mm", "3"]


def model_that_is_no_model(folder: Path) -> list[object]:
    (folder / "model.onnx").write_text("no network")
    (folder / "model.json").write_text("{}")
    return ["estimate", picture(folder), "--tip", "50,50", "--px-per-mm", "3", "--model", folder / "model.onnx"]


def missing_model(folder: Path) -> list[object]:
    return ["estimate", picture(folder), "--tip", "50,50", "--px-per-mm", "3", "--model", folder / "gone.onnx"]


def unknown_setting(folder: Path) -> list[object]:
    (folder / "config.json").write_text('{"hands": {"max_hand": 1}}')
    return ["run", picture(folder), "--config", folder / "config.json"]


def config_that_is_no_json(folder: Path) -> list[object]:
    (folder / "config.json").write_text("hands: 2")
    return ["run", picture(folder), "--config", folder / "config.json"]


CASES: dict[str, tuple[Make, str]] = {
    "missing camera": (lambda _: ["run", "93"], "cannot open camera 93"),
    "missing stream": (lambda _: ["run", "http://127.0.0.1:9/video"], "cannot open camera http"),
    "missing file": (lambda folder: ["run", folder / "gone.mp4"], "no such source"),
    "text named .mp4": (text_named_mp4, "notes.mp4 as a video"),
    "truncated video": (truncated_video, "cut off"),
    "1x1 picture": (one_pixel_picture, "1x1 px"),
    "float picture": (float_picture, "float32"),
    "text named .png": (text_named_png, "notes.png as an image"),
    "empty folder": (lambda folder: ["run", folder], "no images in"),
    "tip outside the picture": (tip_outside, "outside"),
    "wrong model file": (model_that_is_no_model, "model"),
    "missing model file": (missing_model, "gone.onnx"),
    "unknown setting": (unknown_setting, "Did you mean max_hands?"),
    "config that is no JSON": (config_that_is_no_json, "not JSON"),
    "save without a folder": (lambda folder: ["run", picture(folder), "--save", folder / "gone" / "x.mp4"], "no folder"),
    "save under a wrong name": (lambda folder: ["run", picture(folder), "--save", folder / "x.gif"], "ends in .mp4"),
    "bench without frames": (lambda folder: ["bench", picture(folder)], "egotouch: error"),
}


@pytest.mark.parametrize("case", CASES)
def test_bad_input_is_one_clear_line(case: str, tmp_path: Path, egotouch: Callable[..., tuple[int, str, str]]) -> None:
    make, expected = CASES[case]
    code, out, err = egotouch(*make(tmp_path))
    assert code == 1
    assert out == ""
    assert err.startswith("egotouch: error: ")
    assert expected in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["dance"],
        ["run"],
        ["run", "0", "--threads", "0"],
        ["run", "0", "--fps", "nan"],
        ["run", "0", "--size", "big"],
        ["estimate", "a.png", "--tip", "5", "--px-per-mm", "3"],
        ["estimate", "a.png", "--tip", "5,5", "--px-per-mm", "-1"],
        ["estimate", "a.png"],
    ],
    ids=" ".join,
)
def test_a_wrong_command_line_is_one_line_with_the_way_to_the_help(
    arguments: list[str], egotouch: Callable[..., tuple[int, str, str]]
) -> None:
    code, out, err = egotouch(*arguments)
    assert (code, out) == (2, "")
    assert err.startswith("egotouch: error: ")
    assert "--help" in err
    assert err.count("\n") == 1
