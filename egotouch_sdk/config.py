"""All settings in one place, and where they may come from: code, a preset, a file, the environment."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Self

from pydantic import BaseModel, Field

from egotouch_sdk.config_layers import Layer, merged, read_environment, read_file
from egotouch_sdk.config_presets import PRESET_NAMES, PresetName, preset_settings
from egotouch_sdk.config_section import Section
from egotouch_sdk.config_sections import (
    GateConfig,
    GestureConfig,
    HandsConfig,
    HostConfig,
    PatchesConfig,
    StateConfig,
    TouchModelConfig,
)
from egotouch_sdk.errors import ConfigError

__all__ = [
    "GateConfig",
    "GestureConfig",
    "HandsConfig",
    "HostConfig",
    "PatchesConfig",
    "StateConfig",
    "TouchConfig",
    "TouchModelConfig",
]


class TouchConfig(Section):
    """All settings of the pipeline, one section per stage; the defaults work for an egocentric camera.

    Settings come from code (`TouchConfig(gestures={"touch_slop_mm": 2})`), a preset, a file, or the environment; `load` layers them.
    Every mistake is a `ConfigError` that names the setting, where it came from, and the nearest right name.
    """

    hands: HandsConfig = HandsConfig()
    gate: GateConfig = GateConfig()
    patches: PatchesConfig = PatchesConfig()
    touch: TouchModelConfig = TouchModelConfig()
    host: HostConfig = HostConfig()
    state: StateConfig = StateConfig()
    gestures: GestureConfig = GestureConfig()
    debug: bool = Field(default=False, description="Check the grammar of every event; a breach raises GrammarError.")

    @classmethod
    def android(cls) -> Self:
        """Android's own timeouts and slops (`ViewConfiguration`), in millimetres of skin at 160 dp per inch.

        A press in place seems to move farther than its touch slop: of the demo clip's six clicks one remains (our measurement).
        """
        return cls.load(preset="android")

    @classmethod
    def precise(cls) -> Self:
        """Fine steps of force, and nothing guessed for long, for a steady camera in good light."""
        return cls.load(preset="precise")

    @classmethod
    def forgiving(cls) -> Self:
        """Large slops and long timeouts, for unsteady hands, a moving head and poor light."""
        return cls.load(preset="forgiving")

    @classmethod
    def from_file(cls, path: str | Path) -> Self:
        """Settings of a .toml or .json file with the sections and names of this class; what it leaves out keeps its default."""
        return cls._layered([read_file(path)])

    @classmethod
    def from_env(cls, prefix: str = "EGOTOUCH_", environ: Mapping[str, str] = os.environ) -> Self:
        """Settings of environment variables such as EGOTOUCH_GESTURES__LONG_PRESS_TIMEOUT_MS=500 or EGOTOUCH_DEBUG=1.

        `none` stands for None. Variables with the prefix that do not look like a setting are left alone.
        """
        return cls._layered(read_environment(cls.names(), prefix, environ))

    @classmethod
    def load(
        cls,
        path: str | Path | None = None,
        *,
        preset: PresetName | None = None,
        environ: Mapping[str, str] | None = None,
        overrides: Mapping[str, Any] | None = None,
    ) -> Self:
        """Settings in layers: preset, then file, then environment (when given), then `overrides` from code; the last one counts."""
        layers: list[Layer] = []
        if preset is not None:
            if preset not in PRESET_NAMES:
                raise ConfigError(f"there is no preset {preset!r}", hint=f"There are: {', '.join(PRESET_NAMES)}")
            layers.append(Layer(f"preset {preset}", preset_settings(preset)))
        if path is not None:
            layers.append(read_file(path))
        if environ is not None:
            layers += read_environment(cls.names(), "EGOTOUCH_", environ)
        if overrides:
            layers.append(Layer("", overrides))
        return cls._layered(layers)

    def changed_by(self, path: str | Path) -> Self:
        """These settings, but for those that a .toml or .json file names."""
        return self._layered([Layer("", self.model_dump()), read_file(path)])

    @classmethod
    def names(cls) -> dict[str, tuple[str, ...]]:
        """The settings of each section; under `""` those outside sections."""
        sections = cls.sections()
        inner = {name: tuple(section.model_fields) for name, section in sections.items()}
        return {**inner, "": tuple(name for name in cls.model_fields if name not in sections)}

    @classmethod
    def sections(cls) -> dict[str, type[BaseModel]]:
        """The class of each section."""
        kinds = {name: field.annotation for name, field in cls.model_fields.items()}
        return {name: kind for name, kind in kinds.items() if isinstance(kind, type) and issubclass(kind, BaseModel)}

    @classmethod
    def _layered(cls, layers: Sequence[Layer]) -> Self:
        try:
            return cls._merged(layers)
        except ConfigError as error:
            origin, cause = cls._first_mistake(layers, error)
            raise ConfigError(f"{origin}: {cause.message}" if origin else cause.message, hint=cause.hint) from None

    @classmethod
    def _first_mistake(cls, layers: Sequence[Layer], error: ConfigError) -> tuple[str, ConfigError]:
        """The layer that made the settings wrong, and in which way."""
        for count, layer in enumerate(layers[:-1], 1):
            try:
                cls._merged(layers[:count])
            except ConfigError as earlier:
                return layer.origin, earlier
        return layers[-1].origin, error

    @classmethod
    def _merged(cls, layers: Sequence[Layer]) -> Self:
        return cls.model_validate(merged(layer.settings for layer in layers))
