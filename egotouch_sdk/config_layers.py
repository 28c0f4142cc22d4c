"""Settings from files, the environment and code, as plain dictionaries; what the keys mean is not known here."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ConfigError

#: What separates section and setting in the name of an environment variable.
SEPARATOR = "__"

_PARSERS: dict[str, Callable[[str], Any]] = {".toml": tomllib.loads, ".json": json.loads}
_HINTS = {".toml": "Write it like: [hands] and below it: max_hands = 2", ".json": 'Write it like {"hands": {"max_hands": 2}}'}


@dataclass(frozen=True, slots=True)
class Layer:
    """Settings by section, and where they come from: a file, one environment variable, or code."""

    origin: str
    settings: Mapping[str, Any]


def merged(layers: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """One dictionary of sections; of two layers that set the same, the later one counts."""
    result: dict[str, Any] = {}
    for layer in layers:
        for key, value in layer.items():
            old = result.get(key)
            result[key] = merged([old, value]) if isinstance(old, Mapping) and isinstance(value, Mapping) else value
    return result


def read_file(path: str | Path) -> Layer:
    """The settings of a .toml or .json file; raises `ConfigError` when it cannot be read or is not an object."""
    path = Path(path)
    kind = path.suffix.lower()
    parse = _PARSERS.get(kind)
    if parse is None:
        raise ConfigError(f"the config file {path} is neither .toml nor .json", hint="Rename it, or print one with: egotouch config")
    try:
        settings = parse(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(f"cannot read the config file {path} ({error.strerror})", hint="Check the path") from error
    except ValueError as error:
        raise ConfigError(f"the config file {path} is not {kind[1:].upper()} ({error})", hint=_HINTS[kind]) from error
    if not isinstance(settings, dict):
        raise ConfigError(f"the config file {path} is not an object of sections", hint=_HINTS[kind])
    return Layer(f"config file {path}", settings)


def read_environment(names: Mapping[str, Iterable[str]], prefix: str, environ: Mapping[str, str]) -> list[Layer]:
    """One layer for each variable that is a setting, such as EGOTOUCH_GESTURES__LONG_PRESS_TIMEOUT_MS=500; `none` stands for None.

    `names` has the settings of each section, and under `""` those outside sections. Other variables with the prefix are left alone
    unless they look like a setting; then `ConfigError` names the right spelling.
    """
    right = {
        (f"{section}{SEPARATOR}{name}" if section else name).upper(): (section, name) for section, keys in names.items() for name in keys
    }
    layers = []
    for variable in sorted(environ):
        if variable.startswith(prefix):
            key = variable.removeprefix(prefix).upper()
            if key in right:
                section, name = right[key]
                value = None if environ[variable].lower() == "none" else environ[variable]
                layers.append(Layer(f"environment variable {variable}", {section: {name: value}} if section else {name: value}))
            else:
                _refuse_lookalike(variable, key, prefix, right)
    return layers


def _refuse_lookalike(variable: str, key: str, prefix: str, right: Mapping[str, tuple[str, str]]) -> None:
    single = {name.replace(SEPARATOR, "_"): name for name in right}
    flat = {name.upper(): full for full, (_, name) in right.items()}
    meant = single.get(key) or flat.get(key)
    if meant is None and SEPARATOR not in key:
        return
    close = [meant] if meant else get_close_matches(key, right, n=1)
    hint = f"Did you mean {prefix}{close[0]}?" if close else "`egotouch config` prints all settings"
    raise ConfigError(f"environment variable {variable} names no setting", hint=hint)
