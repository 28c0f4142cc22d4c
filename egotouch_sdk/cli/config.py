"""`egotouch config`: every setting with its unit, range, default and source, as a file that --config reads."""

from __future__ import annotations

import argparse
import json
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from egotouch_sdk.cli.options import Subparsers, add_command, add_config_option
from egotouch_sdk.config_presets import PRESETS

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.fields import FieldInfo

EXAMPLES = """\
  egotouch config > egotouch.toml                      every setting with its default, to edit
  egotouch config --preset android                     Android's own slops and timeouts
  egotouch run 0 --config egotouch.toml                use it
  EGOTOUCH_GESTURES__TOUCH_SLOP_MM=2 egotouch run 0    one setting from the environment
"""
#: Width of the comments.
COLUMNS = 110
#: What stands at the end of a setting's name, and in words; longer endings first.
UNITS = {
    "_mm_s": "mm/s",
    "_px_per_mm": "px/mm",
    "_ms": "ms",
    "_mm": "mm",
    "_n": "N",
    "_rad": "rad",
    "_palms": "palms",
    "_frames": "frames",
}
_BOUNDS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}


def add_parser(subparsers: Subparsers) -> None:
    """Add `config` to the command line."""
    parser = add_command(subparsers, "config", "print all settings with unit, range, default and source", EXAMPLES)
    add_config_option(parser)
    parser.set_defaults(handler=show)


def show(options: argparse.Namespace) -> int:
    """Print the settings as TOML."""
    from egotouch_sdk.config import TouchConfig

    config = TouchConfig.load(options.config, preset=options.preset)
    sections = TouchConfig.sections()
    lines = [line for name in TouchConfig.names()[""] for line in _setting(config, name, None)]
    for name in sections:
        section: BaseModel = getattr(config, name)
        lines += ["", *_comment(type(section).__doc__ or ""), f"[{name}]"]
        for key in type(section).model_fields:
            lines += _setting(section, key, PRESETS[options.preset].get(name, {}).get(key) if options.preset else None)
    sys.stdout.write("\n".join(lines) + "\n")
    return 0


def _setting(section: BaseModel, key: str, preset: tuple[float, str] | None) -> Iterator[str]:
    field = type(section).model_fields[key]
    value = getattr(section, key)
    yield from _comment(field.description or "")
    yield "# " + ", ".join([*_unit(key), *_range(field), f"default {_toml(field.default)}"])
    if preset is not None and value == preset[0]:
        yield from _comment(f"Preset: {preset[1]}")
    yield f"# {key} =" if value is None else f"{key} = {_toml(value)}"


def _unit(key: str) -> list[str]:
    return next(([unit] for ending, unit in UNITS.items() if key.endswith(ending)), [])


def _range(field: FieldInfo) -> list[str]:
    bounds = [f"{sign} {getattr(limit, name):g}" for limit in field.metadata for name, sign in _BOUNDS.items() if hasattr(limit, name)]
    return [" and ".join(bounds)] if bounds else []


def _toml(value: Any) -> str:
    return "none" if value is None else json.dumps(str(value) if isinstance(value, Path) else value)


def _comment(text: str) -> list[str]:
    return textwrap.wrap(" ".join(text.split()), COLUMNS, initial_indent="# ", subsequent_indent="# ")
