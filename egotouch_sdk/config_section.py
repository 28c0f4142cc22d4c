"""What all sections of the settings have in common: frozen, nothing unknown, and mistakes that name the right setting."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic.functional_validators import ModelWrapValidatorHandler

from egotouch_sdk.errors import ConfigError

#: Where each setting is among the sections of another section: `touch_slop_mm` at `gestures.touch_slop_mm`.
_PLACES: dict[str, list[str]] = {}


class Section(BaseModel):
    """Frozen settings that refuse unknown keys; every mistake is a `ConfigError` naming the field."""

    model_config = ConfigDict(frozen=True, extra="forbid", protected_namespaces=())

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        super().__pydantic_init_subclass__(**kwargs)
        for name, field in cls.model_fields.items():
            if isinstance(field.annotation, type) and issubclass(field.annotation, Section):
                for setting in field.annotation.model_fields:
                    _PLACES.setdefault(setting, []).append(f"{name}.{setting}")

    @model_validator(mode="wrap")
    @classmethod
    def _explain(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return handler(data)
        except ValidationError as error:
            raise _config_error(cls, error) from None


def _config_error(section: type[BaseModel], error: ValidationError) -> ConfigError:
    first = error.errors()[0]
    path = ".".join(str(part) for part in first["loc"])
    name = f"{section.__name__}.{path}" if path else section.__name__
    if first["type"] == "extra_forbidden":
        return ConfigError(f"there is no setting {name}", hint=_nearest(section, str(first["loc"][-1])))
    return ConfigError(f"setting {name} is {first['input']!r}: {first['msg'][:1].lower()}{first['msg'][1:]}")


def _nearest(section: type[BaseModel], unknown: str) -> str:
    """What was meant: a setting of another section with just this name, else the section's own nearest name, else any nearest."""
    for known in ([unknown] if unknown in _PLACES else [], section.model_fields, _PLACES):
        if close := get_close_matches(unknown, known, n=1):
            return f"Did you mean {' or '.join(_PLACES[close[0]]) if known is not section.model_fields else close[0]}?"
    return f"There are: {', '.join(section.model_fields)}"


def require_order(section: BaseModel, low: str, high: str) -> None:
    """Raise `ConfigError` where the setting `low` is above the setting `high`."""
    if getattr(section, low) > getattr(section, high):
        raise ConfigError(
            f"{type(section).__name__}.{low} is {getattr(section, low)}, more than {high} = {getattr(section, high)}",
            hint="Give both, with the first at most as large as the second",
        )
