"""Ctrl-C and closed pipes, in real processes."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from egotouch_sdk.sources import VideoFileSource

EGOTOUCH = [sys.executable, "-m", "egotouch_sdk"]

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT for child processes")]


def interrupted(arguments: list[str]) -> subprocess.CompletedProcess[str]:
    """Run a command and press Ctrl-C after its first report of progress."""
    process = subprocess.Popen([*EGOTOUCH, *arguments, "--progress"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    first_report = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    return subprocess.CompletedProcess(arguments, process.returncode, out, first_report + err)


def test_ctrl_c_ends_a_run_cleanly_and_leaves_a_playable_file(long_clip: Path, tmp_path: Path) -> None:
    done = interrupted(["run", str(long_clip), "--save", str(tmp_path / "out.mp4")])
    assert done.returncode == 130
    assert "Traceback" not in done.stderr
    assert "interrupted" in done.stderr
    with VideoFileSource(tmp_path / "out.mp4") as saved:
        assert 0 < len(list(saved)) < 6000


def test_ctrl_c_ends_hands_between_two_lines(long_clip: Path) -> None:
    done = interrupted(["hands", str(long_clip), "--json"])
    assert done.returncode == 130
    assert "Traceback" not in done.stderr
    assert done.stdout.endswith("}\n")


def test_a_reader_that_leaves_ends_the_command_quietly(long_clip: Path) -> None:
    process = subprocess.Popen([*EGOTOUCH, "hands", str(long_clip), "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.readline()
    process.stdout.close()
    assert process.wait(timeout=60) == 0
    assert process.stderr.read() == ""
    process.stderr.close()
