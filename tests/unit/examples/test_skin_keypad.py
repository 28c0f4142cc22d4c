"""The keypad example dials what simulated fingers tap, drawn and undrawn."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "skin_keypad"
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


def dial(*arguments: str) -> list[str]:
    """The lines that the app prints to a file."""
    command = [sys.executable, str(EXAMPLE / "app.py"), *arguments, "--fast"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=ENVIRONMENT)
    assert done.returncode == 0
    assert "has thrown" not in done.stderr and "Traceback" not in done.stderr  # on a busy machine it may say that a listener was slow
    return done.stdout.split("\n")


def key_places(surface: str, host: str, *keys: str) -> list[list[float]]:
    sys.path.insert(0, str(EXAMPLE))
    try:
        from layout import LAYOUTS
    finally:
        sys.path.remove(str(EXAMPLE))
    regions = {view.name: view.region for view in LAYOUTS[surface].views}
    return [[round(value, 1) for value in regions[f"{host}/{key}"].centre_mm] for key in keys]


@pytest.fixture(autouse=True)
def _needs_yaml() -> None:
    pytest.importorskip("yaml")


def test_a_number_is_dialled_on_the_palm() -> None:
    lines = dial(str(EXAMPLE / "dial.yaml"))
    assert lines == ["+", "+4", "+49", "+493", "+4930", "+49300", "+4930", "+49301", "Dialled +49301", ""]


def test_a_number_is_dialled_on_the_forearm() -> None:
    assert dial(str(EXAMPLE / "dial_forearm.yaml"), "--surface", "inner_forearm") == ["1", "11", "112", "Dialled 112", ""]


@pytest.mark.parametrize("surface", ["palm", "back_of_hand", "inner_forearm", "outer_forearm"])
@pytest.mark.parametrize("host", ["left", "right"])
def test_every_limb_can_be_dialled_on(surface: str, host: str, tmp_path: Path) -> None:
    keys = "159*0#"
    taps = "\n".join(f"  - tap: {{at: {place}}}" for place in key_places(surface, host, *keys))
    script = tmp_path / "taps.yaml"
    script.write_text(f"hand: {'right' if host == 'left' else 'left'}\nsurface: {surface}\nacts:\n{taps}\n")
    assert dial(str(script), "--surface", surface)[-2] == f"Dialled {keys}"


def test_a_wrong_source_is_said_in_one_line() -> None:
    command = [sys.executable, str(EXAMPLE / "app.py"), "nothing.mp4"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=ENVIRONMENT)
    assert done.returncode == 1
    assert done.stderr.startswith("app.py: no such source: nothing.mp4.") and done.stderr.count("\n") == 1


def test_in_a_terminal_keys_light_up_under_the_finger() -> None:
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    app = subprocess.Popen([sys.executable, str(EXAMPLE / "app.py"), str(EXAMPLE / "dial.yaml"), "--fast"], stdout=theirs, env=ENVIRONMENT)
    os.close(theirs)
    shown = bytearray()
    try:
        while chunk := os.read(ours, 65536):
            shown += chunk
    except OSError:  # the way a terminal says that nobody writes to it any more
        pass
    os.close(ours)
    assert app.wait() == 0
    screens = shown.decode().split("\x1b[H\x1b[J")
    assert any("\x1b[4;48;5;242m   4   \x1b[0m" in screen for screen in screens), "4 was hovered over"
    assert any("\x1b[30;48;5;155m   4   \x1b[0m" in screen and "1.0 N on 4" in screen for screen in screens), "4 was pressed with 1 N"
    assert "+49301" in screens[-1] and "Dialled +49301" in screens[-1]
