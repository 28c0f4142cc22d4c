from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.cli.main import main


@pytest.fixture
def egotouch(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Runs one command in this process; gives exit code, stdout and stderr."""

    def run(*arguments: object) -> tuple[int, str, str]:
        try:
            code = main([str(argument) for argument in arguments])
        except SystemExit as exit_:
            code = int(exit_.code or 0)
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run


@pytest.fixture
def clip(tmp_path: Path) -> Path:
    """Twelve grey frames without hands, 160x120 at 30 fps."""
    return write_grey_clip(tmp_path / "clip.mp4", 12)


def write_grey_clip(path: Path, frames: int) -> Path:
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), 30.0, (160, 120))
    for _ in range(frames):
        writer.write(np.full((120, 160, 3), 90, np.uint8))
    writer.release()
    return path


@pytest.fixture
def long_clip(tmp_path: Path) -> Path:
    """Far more frames than any test waits for."""
    return write_grey_clip(tmp_path / "long.mp4", 6000)
