"""What the README shows has to work."""

import argparse
import re
from importlib import import_module
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.cli.main import COMMANDS, build_parser

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def test_the_python_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    writer = cv2.VideoWriter(str(tmp_path / "clip.mp4"), cv2.VideoWriter.fourcc(*"mp4v"), 30.0, (160, 120))
    for _ in range(5):
        writer.write(np.zeros((120, 160, 3), np.uint8))
    writer.release()
    monkeypatch.chdir(tmp_path)
    (example,) = blocks("python")
    exec(compile(example, "README.md", "exec"), {})


def test_every_command_line_it_shows_is_accepted() -> None:
    lines = [line.split("#")[0].split() for block in blocks("sh") for line in block.splitlines() if line.startswith("egotouch ")]
    assert lines
    for line in lines:
        assert callable(build_parser().parse_args(line[1:]).handler)


def test_every_make_target_it_shows_exists() -> None:
    makefile = (Path(__file__).parents[2] / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"\bmake ([a-z]+)", README))
    assert {"demo", "test"} <= targets
    assert all(f"\n{target}:" in makefile for target in targets)


def test_every_command_is_in_the_overview() -> None:
    for module in COMMANDS:
        parser = argparse.ArgumentParser()
        subparsers = parser.add_subparsers()
        import_module(module).add_parser(subparsers)
        for command in subparsers.choices:
            assert f"`egotouch {command}" in README
