"""Scripts are read as written, and mistakes are named with file, act and key."""

from __future__ import annotations

from pathlib import Path

import pytest

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.simulator import ScriptSource, shipped_script, shipped_scripts
from egotouch_sdk.simulator.acts import ACTS, Drag, Tap
from egotouch_sdk.simulator.script import parse_script, read_script
from egotouch_sdk.simulator.timeline import Timeline


def test_defaults_are_filled_in() -> None:
    script = parse_script("acts:\n  - tap: {at: [0, 50]}\n", "mine.yaml")
    assert (script.fps, script.hand, script.finger, script.force_n) == (60.0, Handedness.RIGHT, Finger.INDEX, 1.0)
    (tap,) = script.acts
    assert isinstance(tap, Tap)
    assert tap.at == (0.0, 50.0)


@pytest.mark.parametrize(("to", "path"), [("[0, 70]", ((0, 20), (0, 70))), ("[[0, 70], [9, 70]]", ((0, 20), (0, 70), (9, 70)))])
def test_a_drag_goes_to_one_place_or_along_several(to: str, path: tuple[tuple[float, float], ...]) -> None:
    (drag,) = parse_script(f"acts: [drag: {{at: [0, 20], to: {to}}}]", "mine.yaml").acts
    assert isinstance(drag, Drag)
    assert drag.path == path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("acts: [tap: {at: [0, 50], forse_n: 2}]", r"mine.yaml: act 1 \(tap\): there is no key 'forse_n'. Did you mean force_n\?"),
        ("acts: [tap: {at: [0, 5]}, tpa: {}]", r"mine.yaml: act 2: there is no act 'tpa'. Did you mean tap\?"),
        ("acts: [jump: {}]", r"act 1: there is no act 'jump'. There are: tap, double_tap, press, drag, fling"),
        ("acts: [tap: {}]", r"act 1 \(tap\): at is missing"),
        ("acts: [tap: {at: [0, x]}]", r"act 1 \(tap\): at.1 is 'x': input should be a valid number"),
        ("acts: [tap: {at: [0, 50], force_n: 9}]", r"act 1 \(tap\): force_n is 9: .*less than or equal to 3.5"),
        ("acts: [tap: {at: [0, 50], pitch_deg: .nan}]", r"act 1 \(tap\): pitch_deg is nan"),
        ("acts: [tap: {at: [0, 50], finger: toe}]", r"act 1 \(tap\): finger is 'toe'"),
        ("acts: [tap: {at: [0, 50], after_ms: 1, with_ms: 1}]", r"act 1 \(tap\): give after_ms or with_ms, not both"),
        ("acts: [tap: 3]", r"act 1 \(tap\) is 3, not a mapping"),
        ("acts: [tap]", r"act 1 is not of the form word: \{keys\}"),
        ("acts: []", r"mine.yaml: the script has no acts"),
        ("ftp: 3\nacts: [swap: ]", r"mine.yaml: there is no key 'ftp'. Did you mean fps\?"),
        ("fps: 0\nacts: [swap: ]", r"mine.yaml: fps is 0: "),
        ("- tap", "mine.yaml: the script is not a mapping"),
        ("acts: [tap: {at: [0", r"mine.yaml: the script is not YAML at line 1, column \d+"),
    ],
)
def test_a_mistake_is_named(text: str, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        parse_script(text, "mine.yaml")


@pytest.mark.parametrize(
    ("acts", "message"),
    [
        ("tap: {at: [0, -5]}", r"act 1 \(tap\): at = \[0.0, -5.0\] is not on the palm"),
        ("press: {at: [0, 5]}, tap: {at: [0, 9], with_ms: 100}", r"act 2 \(tap\) begins before act 1 of the same right index has ended"),
        (
            "press: {at: [0, 5]}, tap: {at: [0, 9], with_ms: 100, finger: thumb, surface: back_of_hand}",
            r"act 2 \(tap\) touches the back_of_hand while act 1 touches the palm",
        ),
    ],
)
def test_acts_that_contradict_each_other_are_named(acts: str, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        Timeline(parse_script(f"acts: [{acts}]", "mine.yaml"), "mine.yaml")


def test_a_script_that_cannot_be_read_is_a_source_error(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="cannot read the script"):
        read_script(tmp_path / "gone.yaml")


def test_a_script_that_is_not_text_is_a_config_error(tmp_path: Path) -> None:
    (tmp_path / "x.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="not UTF-8"):
        read_script(tmp_path / "x.yaml")


def test_an_unknown_shipped_script_names_the_others() -> None:
    with pytest.raises(SourceError, match=r"no such script: tap. Give a .yaml file or one of .*faults, taps"):
        shipped_script("tap")


def test_the_shipped_scripts_use_every_act() -> None:
    words = {act.word for name in shipped_scripts() for act in ScriptSource(shipped_script(name)).script.acts}
    assert words == set(ACTS)
