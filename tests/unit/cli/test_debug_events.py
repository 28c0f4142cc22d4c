"""`egotouch debug-events` and `egotouch simulate` on the command line."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from egotouch_sdk.simulator import shipped_script

Command = Callable[..., tuple[int, str, str]]
TAPS = shipped_script("taps")


def test_plain_lines_tell_every_edge(egotouch: Command) -> None:
    code, out, err = egotouch("debug-events", TAPS, "--no-tui")
    header, *lines = out.splitlines()
    assert (code, header.split()[:2]) == (0, ["time", "s"])
    words = Counter(line.split("-> ")[1].split()[0] for line in lines)
    assert words["DOWN"] == words["UP"] == 7
    assert (words["CLICK"], words["DOUBLE_CLICK"], words["LONG_CLICK"], words["FLING"], words["MOVE"]) == (5, 1, 1, 1, 0)
    assert "events" in err


def test_a_recording_gives_the_same_lines_as_what_was_recorded(egotouch: Command, tmp_path: Path) -> None:
    assert egotouch("record", TAPS, "-o", tmp_path / "taps.mcap")[0] == 0
    recorded, played = (egotouch("debug-events", source, "--no-tui", "--moves")[1] for source in (tmp_path / "taps.mcap", TAPS))
    assert recorded == played
    assert len(played.splitlines()) > 300


def test_moves_are_printed_on_demand(egotouch: Command) -> None:
    _, out, _ = egotouch("debug-events", TAPS, "--no-tui", "--moves")
    assert "-> MOVE ->" in out


def test_a_video_without_hands_has_no_events(egotouch: Command, clip: Path) -> None:
    code, out, err = egotouch("debug-events", clip, "--no-tui")
    assert (code, len(out.splitlines())) == (0, 1)
    assert err == "12 frames, 0 events\n"


def test_the_screen_at_a_time_is_saved_as_a_picture(egotouch: Command, tmp_path: Path) -> None:
    file = tmp_path / "screen.svg"
    code, _, err = egotouch("debug-events", TAPS, "--screenshot", file, "--at", "2.9")
    assert (code, err) == (0, f"saved {file}\n")
    text = " ".join("".join(element.itertext()) for element in ET.parse(file).iter() if element.tag.endswith("text"))
    text = text.replace("\xa0", " ")
    assert all(words in text for words in ("● touch", "held, hard", "2.00 N", "FORCE_ENTER", "gate", "open", "Pause", "Quit"))
    assert "LONG_CLICK" not in text


def test_the_screen_at_the_end_has_everything(egotouch: Command, tmp_path: Path) -> None:
    egotouch("debug-events", TAPS, "--screenshot", tmp_path / "screen.svg", "--screen", "140x60")
    text = (tmp_path / "screen.svg").read_text(encoding="utf-8")
    assert all(words in text for words in ("LONG_CLICK", "DRAG_END", "FLING", "ended"))


def test_without_textual_the_extra_is_named(egotouch: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [name for name in sys.modules if name.split(".")[0] == "textual" or name == "egotouch_sdk.cli.trace.app"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "textual", None)
    code, _, err = egotouch("debug-events", TAPS)
    assert code == 1
    assert err.endswith("Install it with: pip install 'egotouch-sdk[debug]'\n")


def test_simulate_prints_the_events_of_a_script(egotouch: Command) -> None:
    code, out, err = egotouch("simulate", "dial_on_palm", "--fast", "--json")
    events = [json.loads(line) for line in out.splitlines()]
    clicks = [(round(event["x_mm"]), round(event["y_mm"])) for event in events if event["type"] == "click"]
    assert (code, clicks) == (0, [(16, 68), (16, 68), (0, 68), (0, 20)])
    assert "observations in" in err


def test_run_takes_a_script_as_well(egotouch: Command) -> None:
    simulated, run = (egotouch(*command)[1] for command in (("simulate", TAPS, "--fast"), ("run", TAPS)))
    assert simulated == run != ""


def test_settings_change_what_a_script_gives(egotouch: Command, tmp_path: Path) -> None:
    settings = tmp_path / "settings.json"
    settings.write_text('{"gestures": {"long_press_timeout_ms": 5000}}', encoding="utf-8")
    assert "long_click" in egotouch("simulate", TAPS, "--fast")[1]
    assert "long_click" not in egotouch("simulate", TAPS, "--fast", "--config", settings)[1]


@pytest.mark.parametrize("arguments", [("run", TAPS, "--show"), ("run", TAPS, "--save", "x.mp4"), ("hands", TAPS)])
def test_a_script_has_no_pictures(egotouch: Command, arguments: tuple[object, ...]) -> None:
    code, _, err = egotouch(*arguments)
    assert code == 1
    assert f"{TAPS} has no pictures. Give a camera" in err


def test_a_wrong_script_is_one_line(egotouch: Command, tmp_path: Path) -> None:
    script = tmp_path / "mine.yaml"
    script.write_text("acts:\n  - tap: {at: [0, 50], forse_n: 2}\n", encoding="utf-8")
    code, _, err = egotouch("simulate", script)
    assert (code, err) == (1, f"egotouch: error: {script}: act 1 (tap): there is no key 'forse_n'. Did you mean force_n?\n")


def test_without_yaml_the_extra_is_named(egotouch: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "yaml", None)
    code, _, err = egotouch("simulate", "taps")
    assert code == 1
    assert "pip install 'egotouch-sdk[simulate]'" in err


@pytest.mark.parametrize("command", ["simulate", "debug-events"])
def test_help_ends_with_examples(egotouch: Command, command: str) -> None:
    code, out, _ = egotouch(command, "--help")
    assert code == 0
    assert f"examples:\n  egotouch {command}" in out


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals")
@pytest.mark.parametrize(("key", "code"), [(b"q", 0), (b"\x03", 130)])
def test_in_a_terminal_it_starts_and_leaves_by_key(key: bytes, code: int) -> None:
    ours, theirs = os.openpty()
    command = [sys.executable, "-m", "egotouch_sdk", "debug-events", str(TAPS)]
    environment = os.environ | {"TERM": "xterm-256color", "COLUMNS": "140", "LINES": "40"}
    with subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, env=environment, start_new_session=True) as process:
        os.close(theirs)
        screen = b""
        while b"HOVER_ENTER" not in screen:
            screen += os.read(ours, 65536)
        os.write(ours, key)
        with suppress(OSError):  # a terminal whose program has ended
            while os.read(ours, 65536):
                pass
        assert process.wait(timeout=30) == code
    os.close(ours)
    assert b"Traceback" not in screen
