from __future__ import annotations

import pytest
from pydantic import BaseModel

from egotouch_sdk.config import GateConfig, HandsConfig, StateConfig, TouchConfig
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
