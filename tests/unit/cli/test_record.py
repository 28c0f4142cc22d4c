"""`egotouch record` and `egotouch replay`."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from egotouch_sdk.engine import EventEngine
from egotouch_sdk.recording import Header, Recorder, RecordingSource, topics
from egotouch_sdk.recording.container import message_count
from egotouch_sdk.simulator import shipped_script
from egotouch_sdk.touch_event import EventType
from tests.support.recordings import record_taps, taps

Command = Callable[..., tuple[int, str, str]]
SCRIPT = shipped_script("taps")


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    path = tmp_path / "taps.mcap"
    record_taps(path)
    return path


def test_a_recorded_script_replays_to_the_same_events(egotouch: Command, tmp_path: Path) -> None:
    file = tmp_path / "script.mcap"
    code, out, err = egotouch("record", SCRIPT, "-o", file)
    assert (code, out) == (0, "")
    assert err.startswith("recorded 376 frames and ")
    assert egotouch("replay", file) == (0, "", f"{err.split()[4]} events, identical\n")


def test_run_on_a_recording_prints_what_run_on_its_source_printed(egotouch: Command, tmp_path: Path) -> None:
    file = tmp_path / "script.mcap"
    egotouch("record", SCRIPT, "-o", file)
    _, from_script, _ = egotouch("run", SCRIPT, "--json")
    code, from_recording, _ = egotouch("run", file, "--json")
    assert code == 0
    assert from_recording == from_script != ""


def test_replay_prints_events_as_json(egotouch: Command, recording: Path) -> None:
    code, out, err = egotouch("replay", recording, "--json")
    events = [json.loads(line) for line in out.splitlines()]
    assert code == 0
    assert err == f"{len(events)} events, identical\n"
    assert events[0]["type"] == "hover_enter"


def test_other_settings_are_shown_as_a_difference(egotouch: Command, recording: Path, tmp_path: Path) -> None:
    settings = tmp_path / "impatient.json"
    settings.write_text('{"gestures": {"long_press_timeout_ms": 30}}')
    code, out, err = egotouch("replay", recording, "--config", settings)
    assert code == 0
    assert [line for line in out.splitlines() if line.startswith("+ ") and "long_click" in line]
    assert "different from the" in err


def test_settings_that_change_nothing_are_said_to(egotouch: Command, recording: Path, tmp_path: Path) -> None:
    settings = tmp_path / "same.json"
    settings.write_text('{"gestures": {"long_press_timeout_ms": 400}}')
    code, out, err = egotouch("replay", recording, "--config", settings)
    assert (code, out) == (0, "")
    assert err.endswith("events, identical\n")


def test_a_mistake_in_the_settings_is_said_with_its_file(egotouch: Command, recording: Path, tmp_path: Path) -> None:
    settings = tmp_path / "mistaken.json"
    settings.write_text('{"gestures": {"long_press": 30}}')
    code, out, err = egotouch("replay", recording, "--config", settings)
    words = f"config file {settings}: there is no setting GestureConfig.long_press. Did you mean long_press_timeout_ms?"
    assert (code, out, err) == (1, "", f"egotouch: error: {words}\n")


def test_a_difference_is_named_with_version_and_model(egotouch: Command, tmp_path: Path) -> None:
    """A recording of a version that reported twice the force."""
    file, engine = tmp_path / "other.mcap", EventEngine()
    header = Header(engine.config, engine.thresholds, {"touch.onnx": "0" * 64}, sdk_version="0.0.1")
    with Recorder(file, header) as recorder:
        for observation in taps(10):
            result = engine.process(observation)
            recorder.write(replace(result, events=tuple(replace(event, force_n=2 * event.force_n) for event in result.events)))
    code, out, err = egotouch("replay", file)
    first, *details = err.splitlines()
    assert (code, out) == (1, "")
    assert first.endswith("the same as recorded but for numbers, which differ by up to 1")
    assert details[0].startswith("  first difference in frame 5, ")
    assert any("recorded by egotouch 0.0.1" in line for line in details)
    assert any("another touch.onnx: 000000000000" in line for line in details)


def test_another_event_is_more_than_another_number(egotouch: Command, tmp_path: Path) -> None:
    """A recording of a version that reported no clicks."""
    file, engine = tmp_path / "other.mcap", EventEngine()
    with Recorder(file, Header(engine.config, engine.thresholds)) as recorder:
        for observation in taps(20):
            result = engine.process(observation)
            recorder.write(replace(result, events=tuple(event for event in result.events if event.type is not EventType.CLICK)))
    code, _, err = egotouch("replay", file)
    assert code == 1
    assert "different from the" in err
    assert "+type=click pointer_id=1 contact_id=1" in err


def test_pictures_are_recorded_when_asked_for(egotouch: Command, clip: Path, tmp_path: Path) -> None:
    plain, video = tmp_path / "plain.mcap", tmp_path / "video.mcap"
    assert egotouch("record", clip, "-o", plain)[0] == 0
    assert egotouch("record", clip, "-o", video, "--video")[0] == 0
    assert (message_count(plain, topics.IMAGE), message_count(video, topics.IMAGE)) == (0, 12)
    assert RecordingSource(video).frame_count == RecordingSource(plain).frame_count == 12
    assert set(RecordingSource(plain).header.model_sha256) >= {"touch.onnx"}


def test_a_source_without_pictures_has_no_video(egotouch: Command, tmp_path: Path) -> None:
    code, _, err = egotouch("record", SCRIPT, "-o", tmp_path / "x.mcap", "--video")
    assert code == 1
    assert "has no pictures" in err
    assert not (tmp_path / "x.mcap").exists()


def test_an_existing_file_needs_force(egotouch: Command, recording: Path) -> None:
    code, _, err = egotouch("record", SCRIPT, "-o", recording)
    assert code == 1
    assert err == f"egotouch: error: {recording} exists already. Choose another name, or overwrite it with --force\n"
    assert egotouch("record", SCRIPT, "-o", recording, "--force")[0] == 0
    assert RecordingSource(recording).frame_count == 376


@pytest.mark.parametrize("name", ["session.mp4", "session"])
def test_the_file_must_be_called_mcap(egotouch: Command, tmp_path: Path, name: str) -> None:
    code, _, err = egotouch("record", SCRIPT, "-o", tmp_path / name)
    assert code == 2
    assert "does not end in .mcap" in err


def test_a_cut_recording_is_replayed_as_far_as_it_goes(egotouch: Command, recording: Path) -> None:
    recording.write_bytes(recording.read_bytes()[:-5000])
    code, _, err = egotouch("replay", recording)
    assert code == 0
    assert "egotouch: warning: the recording" in err
    assert err.endswith("identical\n")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT for child processes")
def test_ctrl_c_finishes_the_file(long_clip: Path, tmp_path: Path) -> None:
    file = tmp_path / "session.mcap"
    command = [sys.executable, "-m", "egotouch_sdk", "record", str(long_clip), "-o", str(file), "--progress"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        process.stderr.readline()
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
    assert process.returncode == 130
    assert "Traceback" not in rest
    source = RecordingSource(file)
    assert f"recorded {source.frame_count} frames and 0 events" in rest
    assert 0 < len(list(source)) == source.frame_count < 6000
