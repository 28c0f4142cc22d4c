from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import BaseModel

from egotouch_sdk.config import GateConfig, GestureConfig, HandsConfig, StateConfig, TouchConfig
from egotouch_sdk.config_presets import PRESETS, PRESET_NAMES, PresetName
from egotouch_sdk.errors import ConfigError


def test_the_defaults_are_valid_and_equal_to_nothing_given() -> None:
    assert TouchConfig() == TouchConfig.model_validate({}) == TouchConfig.model_validate_json("{}")


def test_sections_can_be_given_as_dictionaries() -> None:
    assert TouchConfig.model_validate({"hands": {"threads": 2}}).hands == HandsConfig(threads=2)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ({"hnads": {}}, "TouchConfig.hnads. Did you mean hands?"),
        ({"hands": {"thread": 2}}, "HandsConfig.thread. Did you mean threads?"),
        ({"state": {"stall_s": 1}}, "StateConfig.stall_s. Did you mean stall_ms?"),
        ({"gate": {"zzz": 1}}, "There are: min_touching_score"),
    ],
)
def test_an_unknown_key_names_the_nearest_right_one(data: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        TouchConfig.model_validate(data)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("section", "values", "message"),
    [
        (StateConfig, {"stall_ms": -1}, "StateConfig.stall_ms is -1"),
        (GateConfig, {"near_enter_palms": "far"}, "GateConfig.near_enter_palms is 'far'"),
        (GateConfig, {"near_enter_palms": 9}, "more than near_exit_palms = 3.3"),
        (GateConfig, {"extended_exit": 0.9}, "more than extended_enter = 0.7"),
        (StateConfig, {"up_probability": 0.6, "down_probability": 0.5}, "more than down_probability = 0.5"),
        (HandsConfig, {"max_hands": 3}, "HandsConfig.max_hands is 3"),
        (TouchConfig, {"hands": 3}, "HandsConfig is 3"),
    ],
)
def test_a_value_out_of_range_names_its_setting(section: type[BaseModel], values: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        section(**values)
    assert message in str(caught.value)


def test_settings_are_frozen() -> None:
    with pytest.raises(ValueError, match="frozen"):
        TouchConfig().hands.threads = 3  # type: ignore[misc]


def test_every_setting_is_described() -> None:
    for section, value in TouchConfig():
        fields = type(value).model_fields if isinstance(value, BaseModel) else {section: TouchConfig.model_fields[section]}
        for name, field in fields.items():
            assert field.description, f"{section}.{name}"


@pytest.mark.parametrize(
    ("data", "hint"),
    [
        ({"long_press_timeout_ms": 500}, "Did you mean gestures.long_press_timeout_ms?"),
        ({"long_press_ms": 500}, "Did you mean gestures.long_press_timeout_ms?"),
        ({"threads": 1}, "Did you mean hands.threads or touch.threads?"),
        ({"gestures": {"stall_ms": 1}}, "Did you mean state.stall_ms?"),
    ],
)
def test_a_setting_in_the_wrong_place_names_the_right_one(data: dict[str, object], hint: str) -> None:
    with pytest.raises(ConfigError) as caught:
        TouchConfig(**data)
    assert caught.value.hint == hint


@pytest.mark.parametrize("name", PRESET_NAMES)
def test_presets_differ_from_the_defaults_and_every_value_has_a_source(name: PresetName) -> None:
    preset = getattr(TouchConfig, name)()
    assert preset == TouchConfig.load(preset=name) != TouchConfig()
    for section, values in PRESETS[name].items():
        for key, (value, source) in values.items():
            assert getattr(getattr(preset, section), key) == value
            assert source


def test_the_android_preset_is_in_millimetres_of_160_dpi() -> None:
    gestures = TouchConfig.android().gestures
    dp_mm = 25.4 / 160
    assert gestures.touch_slop_mm == pytest.approx(8 * dp_mm, abs=0.01)
    assert gestures.double_click_slop_mm == pytest.approx(100 * dp_mm, abs=0.05)
    assert gestures.fling_min_mm_s == pytest.approx(50 * dp_mm, abs=0.05)
    assert gestures.fling_max_mm_s == pytest.approx(8000 * dp_mm)


@pytest.mark.parametrize(
    ("name", "text"),
    [("c.toml", "debug = true\n[gestures]\ntouch_slop_mm = 2"), ("c.json", '{"debug": true, "gestures": {"touch_slop_mm": 2}}')],
)
def test_files_hold_sections(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    assert TouchConfig.from_file(tmp_path / name) == TouchConfig(debug=True, gestures=GestureConfig(touch_slop_mm=2.0))


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("c.toml", "[gestures]\ntouch_slop = 2", "there is no setting GestureConfig.touch_slop. Did you mean touch_slop_mm?"),
        ("c.toml", "[gestures]\ntouch_slop_mm = -2", "setting GestureConfig.touch_slop_mm is -2"),
        ("c.toml", "gestures", "is not TOML"),
        ("c.json", "{", "is not JSON"),
        ("c.json", "[]", "is not an object of sections. Write it like"),
        ("c.ini", "", "neither .toml nor .json"),
    ],
)
def test_a_mistake_in_a_file_names_the_file(tmp_path: Path, name: str, text: str, message: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(ConfigError) as caught:
        TouchConfig.from_file(tmp_path / name)
    assert message in str(caught.value)
    assert f"config file {tmp_path / name}" in str(caught.value)


def test_a_file_that_is_not_there() -> None:
    with pytest.raises(ConfigError, match=r"cannot read the config file nowhere\.toml"):
        TouchConfig.from_file("nowhere.toml")


def test_the_environment_sets_what_looks_like_a_setting() -> None:
    environ = {
        "EGOTOUCH_GESTURES__LONG_PRESS_TIMEOUT_MS": "500",
        "EGOTOUCH_DEBUG": "1",
        "EGOTOUCH_HOST__PALM_MM": "none",
        "EGOTOUCH_CACHE": "/tmp",
        "EGOTOUCH_LITE": "1",
        "EGOTOUCH_HAND_MESH_DIR": "/tmp",
        "EGOTOUCH_MEDIAPIPE_WHEEL": "/tmp",
        "EGOTOUCH_REAL_DIR": "/tmp",
        "OTHER_GESTURES__TOUCH_SLOP_MM": "9",
    }
    assert TouchConfig.from_env(environ=environ) == TouchConfig(debug=True, gestures=GestureConfig(long_press_timeout_ms=500.0))
    assert TouchConfig.from_env("OTHER_", environ).gestures.touch_slop_mm == 9.0


@pytest.mark.parametrize(
    ("variable", "value", "message"),
    [
        ("EGOTOUCH_GESTURES__LONG_PRES_TIMEOUT_MS", "5", "Did you mean EGOTOUCH_GESTURES__LONG_PRESS_TIMEOUT_MS?"),
        ("EGOTOUCH_GESTURES_TOUCH_SLOP_MM", "5", "Did you mean EGOTOUCH_GESTURES__TOUCH_SLOP_MM?"),
        ("EGOTOUCH_TOUCH_SLOP_MM", "5", "Did you mean EGOTOUCH_GESTURES__TOUCH_SLOP_MM?"),
        ("EGOTOUCH_ZZZ__QQQ", "5", "`egotouch config` prints all settings"),
        ("EGOTOUCH_STATE__STALL_MS", "soon", "StateConfig.stall_ms is 'soon'"),
        ("EGOTOUCH_GESTURES__FORCE_EXIT_N", "9", "more than force_enter_n = 1.5"),
    ],
)
def test_a_mistake_in_the_environment_names_the_variable(variable: str, value: str, message: str) -> None:
    with pytest.raises(ConfigError) as caught:
        TouchConfig.from_env(environ={"EGOTOUCH_DEBUG": "0", variable: value})
    assert message in str(caught.value)
    assert f"environment variable {variable}" in str(caught.value)


def test_code_comes_before_the_environment_before_the_file_before_the_preset(tmp_path: Path) -> None:
    file = tmp_path / "c.toml"
    file.write_text("[gestures]\ntouch_slop_mm = 2.2\nlong_press_timeout_ms = 222\nfling_min_mm_s = 22")
    environ = {"EGOTOUCH_GESTURES__LONG_PRESS_TIMEOUT_MS": "333", "EGOTOUCH_GESTURES__FLING_MIN_MM_S": "33"}
    config = TouchConfig.load(file, preset="forgiving", environ=environ, overrides={"gestures": {"fling_min_mm_s": 44.0}})
    changed = GestureConfig(
        touch_slop_mm=2.2, long_press_timeout_ms=333.0, fling_min_mm_s=44.0, double_click_slop_mm=25.0, double_tap_timeout_ms=450.0
    )
    assert config.gestures == changed
    assert config.state == TouchConfig.forgiving().state


def test_an_unknown_preset() -> None:
    with pytest.raises(ConfigError, match="There are: android, precise, forgiving"):
        TouchConfig.load(preset="ios")  # type: ignore[arg-type]
