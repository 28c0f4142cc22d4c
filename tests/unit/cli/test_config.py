"""`egotouch config` prints a file that --config reads back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.config_presets import PRESET_NAMES

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.parametrize("preset", [None, *PRESET_NAMES])
def test_what_is_printed_is_read_back(egotouch: Command, tmp_path: Path, preset: str | None) -> None:
    code, out, err = egotouch("config", *(["--preset", preset] if preset else []))
    assert (code, err) == (0, "")
    (tmp_path / "egotouch.toml").write_text(out)
    assert TouchConfig.from_file(tmp_path / "egotouch.toml") == (getattr(TouchConfig, preset)() if preset else TouchConfig())


def test_every_setting_is_printed_with_unit_range_default_and_source(egotouch: Command) -> None:
    _, out, _ = egotouch("config", "--preset", "android")
    lines = out.splitlines()
    for section, names in TouchConfig.names().items():
        assert not section or f"[{section}]" in lines
        for name in names:
            assert any(line.removeprefix("# ").startswith(f"{name} =") for line in lines), name
    place = lines.index("touch_slop_mm = 1.27")
    default = TouchConfig().gestures.touch_slop_mm
    assert lines[place - 2 : place] == [f"# mm, > 0, default {default}", "# Preset: ViewConfiguration.TOUCH_SLOP: 8 dp"]


def test_a_file_shows_its_effect(egotouch: Command, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("[host]\npalm_mm = 90.0\n")
    _, out, _ = egotouch("config", "--config", tmp_path / "mine.toml")
    assert "\npalm_mm = 90.0\n" in out


def test_the_environment_reaches_the_command_line(egotouch: Command, clip: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("EGOTOUCH_GESTURES__TOUCH_SLOP", "2")
    code, _, err = egotouch("run", clip)
    assert code == 1
    assert err.endswith("EGOTOUCH_GESTURES__TOUCH_SLOP names no setting. Did you mean EGOTOUCH_GESTURES__TOUCH_SLOP_MM?\n")


def test_a_preset_a_file_and_a_flag_go_together(egotouch: Command, clip: Path, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("[gestures]\ntouch_slop_mm = 2.0\n")
    assert egotouch("run", clip, "--preset", "forgiving", "--config", tmp_path / "mine.toml", "--threads", "1")[0] == 0
    code, _, err = egotouch("run", clip, "--preset", "ios")
    assert code == 2
    assert "forgiving" in err
