"""Killed programs, full disks and folders that cannot be written."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from egotouch_sdk.errors import RecordingError, SourceWarning
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.recording import Header, Recorder, RecordingSource
from egotouch_sdk.replay import replay
from tests.support.recordings import FPS, record_taps, taps

ROOT = Path(__file__).parents[3]

#: Records taps for ever, and says how many frames it has recorded.
ENDLESS = """
import sys
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.recording import Header, RecordedEngine, Recorder
from tests.support.recordings import taps
engine = EventEngine()
recorded = RecordedEngine(engine, Recorder(sys.argv[1], Header(engine.config, engine.thresholds)))
for count, observation in enumerate(taps(10**9), start=1):
    recorded.process(observation)
    print(count, flush=True)
"""

#: Records until the file may not grow any more, as on a full disk; then exits with the typed error's message.
FULL = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
from egotouch_sdk.errors import RecordingError
from tests.support.recordings import record_taps
try:
    record_taps(sys.argv[1], 10_000)
except RecordingError as error:
    sys.exit(str(error))
"""

posix = pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals and limits")


@posix
def test_a_killed_recorder_loses_a_second_at_most(tmp_path: Path) -> None:
    path = tmp_path / "killed.mcap"
    with subprocess.Popen([sys.executable, "-c", ENDLESS, str(path)], stdout=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stdout is not None
        for _ in range(200):
            written = int(process.stdout.readline())
        process.kill()
        written = max([written, *map(int, process.stdout.read().split("\n")[:-1])])
    with pytest.warns(SourceWarning, match="cut off"):
        frames = list(replay(RecordingSource(path)))
    assert written - FPS <= len(frames) <= written + 1
    assert all(frame.is_identical for frame in frames)


@posix
def test_a_full_disk_is_an_error_and_keeps_what_was_recorded(tmp_path: Path) -> None:
    path = tmp_path / "full.mcap"
    run = subprocess.run([sys.executable, "-c", FULL, str(path)], capture_output=True, text=True, cwd=ROOT, check=False)
    size = path.stat().st_size
    assert run.returncode == 1
    assert run.stderr.startswith(f"cannot go on writing {path} (File too large). The first {size} bytes are a sound recording")
    assert "Traceback" not in run.stderr
    with pytest.warns(SourceWarning, match="cut off"):
        frames = list(replay(RecordingSource(path)))
    assert len(frames) > FPS
    assert all(frame.is_identical for frame in frames)


def test_an_existing_file_is_not_overwritten_unasked(tmp_path: Path) -> None:
    path = tmp_path / "taps.mcap"
    header = record_taps(path, 30).header
    before = path.read_bytes()
    with pytest.raises(RecordingError, match="exists already"):
        Recorder(path, header)
    assert path.read_bytes() == before
    Recorder(path, header, overwrite=True).close()
    assert len(path.read_bytes()) < len(before)


def test_a_folder_that_is_not_there_is_named(tmp_path: Path, header: Header) -> None:
    with pytest.raises(RecordingError, match=r"cannot write .*nowhere.*No such file or directory"):
        Recorder(tmp_path / "nowhere" / "taps.mcap", header)


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_of_somebody_else_is_named(tmp_path: Path, header: Header) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(RecordingError, match="Permission denied"):
        Recorder(tmp_path / "taps.mcap", header)


def test_a_folder_is_no_file(tmp_path: Path, header: Header) -> None:
    with pytest.raises(RecordingError, match=r"cannot write|exists already"):
        Recorder(tmp_path, header, overwrite=True)


@pytest.fixture
def header(tmp_path: Path) -> Header:
    return record_taps(tmp_path / "for_its_header.mcap", 1).header


def test_a_frame_written_by_half_ends_the_recording_and_spoils_nothing(tmp_path: Path) -> None:
    path = tmp_path / "taps.mcap"
    recorder = record_taps(path, 40, finished=False)
    with pytest.raises(AttributeError):
        recorder.write(FrameResult(next(taps(1)), events=("no event",)))  # type: ignore[arg-type]
    with pytest.raises(RecordingError, match="is closed"):
        recorder.write(FrameResult(next(taps(1))))
    with pytest.warns(SourceWarning, match="cut off"):
        frames = list(replay(RecordingSource(path)))
    assert 40 - FPS <= len(frames) <= 40
    assert all(frame.is_identical for frame in frames)
