"""Scripts: what simulated fingers do and when, read from YAML.

    name: A tap and a drag          # all of these are optional; the values here are the defaults
    fps: 60                         # 1..240
    hand: right                     # the touching hand; the other one is touched
    finger: index
    surface: palm                   # palm, back_of_hand: y_mm >= 0; inner_forearm, outer_forearm: y_mm < 0
    force_n: 1.0                    # 0..3.5
    pitch_deg: 45                   # 0 flat .. 90 perpendicular
    yaw_deg: 0                      # 0 along +y, positive towards the host's thumb
    jitter_mm: 0                    # standard deviation of noise on every place
    seed: 0                         # of that noise
    acts:                           # one after another
      - tap: {at: [0, 50]}
      - double_tap: {at: [0, 50], finger: middle}
      - press: {at: [20, 40], duration_ms: 800, force_n: 2.5}
      - drag: {at: [0, 20], to: [0, 70]}             # or to: [[0, 70], [20, 70]]
      - fling: {at: [0, 20], to: [0, 70]}            # lifts while it moves
      - hover: {at: [0, 50], to: [10, 50], height_mm: 10}
      - vanish: {duration_ms: 300}                   # tracking is lost
      - swap: {}                                     # the hands are found as new ones
      - stall: {duration_ms: 400}                    # the camera gives no pictures

Every act that moves a finger takes hand, finger, surface, force_n, pitch_deg and yaw_deg in place of the script's.
Every act begins `after_ms` (default 400) after all acts before it have ended. With `with_ms` it joins the last act that has no
`with_ms` of its own and begins so long after that one began: two fingers touch together, tracking is lost during a touch.
Places are [x_mm, y_mm] in the host frame: origin wrist, +y to the middle MCP, +x to the host's thumb side.
"""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError

from egotouch_sdk.errors import ConfigError, MissingExtraError, SourceError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.simulator.acts import ACTS, Act, Force, Model, Pitch, Yaw
from egotouch_sdk.surface import Surface


class Script(Model):
    """A whole script; the defaults and the meaning of every key are at the top of this module."""

    name: str = ""
    fps: Annotated[float, Field(ge=1, le=240, allow_inf_nan=False)] = 60.0
    hand: Handedness = Handedness.RIGHT
    finger: Finger = Finger.INDEX
    surface: Surface = Surface.PALM
    force_n: Force = 1.0
    pitch_deg: Pitch = 45.0
    yaw_deg: Yaw = 0.0
    jitter_mm: Annotated[float, Field(ge=0, le=20, allow_inf_nan=False)] = 0.0
    seed: Annotated[int, Field(ge=0)] = 0
    acts: tuple[Act, ...]


def read_script(path: Path) -> Script:
    """The script in a file; raises `SourceError` when it cannot be read and `ConfigError` when it is wrong."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise SourceError(f"cannot read the script {path} ({error.strerror})", hint="Check the path") from error
    except UnicodeDecodeError as error:
        raise ConfigError(f"the script {path} is not UTF-8 text", hint="Save it as UTF-8") from error
    return parse_script(text, str(path))


def parse_script(text: str, name: str) -> Script:
    """The script in `text`; `name` is what errors call it. Raises `ConfigError` that says which act and key are wrong."""
    content = _load_yaml(text, name)
    if not isinstance(content, dict):
        raise ConfigError(f"{name}: the script is not a mapping", hint='Write "acts:" and below it lines like "- tap: {at: [0, 50]}"')
    acts = content.get("acts")
    if not isinstance(acts, list) or not acts:
        raise ConfigError(f"{name}: the script has no acts", hint='Write "acts:" and below it lines like "- tap: {at: [0, 50]}"')
    parsed = tuple(_parse_act(act, f"{name}: act {number}") for number, act in enumerate(acts, 1))
    script: Script = _validated(Script, content | {"acts": parsed}, name)
    return script


def _load_yaml(text: str, name: str) -> object:
    try:
        import yaml
    except ModuleNotFoundError as error:
        raise MissingExtraError("reading a simulator script", "simulate") from error
    try:
        return yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f" at line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        problem = getattr(error, "problem", None) or type(error).__name__
        raise ConfigError(f"{name}: the script is not YAML{where} ({problem})", hint="Mind indentation, colons and brackets") from error


def _parse_act(act: object, where: str) -> Act:
    if not isinstance(act, dict) or len(act) != 1:
        raise ConfigError(f"{where} is not of the form word: {{keys}}", hint='Write it like "- tap: {at: [0, 50]}"')
    ((word, fields),) = act.items()
    if word not in ACTS:
        raise ConfigError(f"{where}: there is no act {word!r}", hint=_nearest(str(word), ACTS))
    fields = {} if fields is None else fields
    if not isinstance(fields, dict):
        raise ConfigError(f"{where} ({word}) is {fields!r}, not a mapping", hint='Write it like "- tap: {at: [0, 50]}"')
    parsed: Act = _validated(ACTS[word], fields, f"{where} ({word})")
    return parsed


def _validated(model: type[Any], fields: Mapping[Any, Any], where: str) -> Any:
    unknown = [key for key in fields if key not in model.model_fields]
    if unknown:
        raise ConfigError(f"{where}: there is no key {unknown[0]!r}", hint=_nearest(str(unknown[0]), model.model_fields))
    try:
        return model(**fields)
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        if first["type"] == "missing":
            raise ConfigError(f"{where}: {key} is missing", hint=f"There are: {', '.join(model.model_fields)}") from None
        said = first["msg"].removeprefix("Value error, ")
        value = f"{key} is {first['input']!r}: " if key else ""
        raise ConfigError(f"{where}: {value}{said[:1].lower()}{said[1:]}") from None


def _nearest(unknown: str, known: Mapping[str, object]) -> str:
    close = get_close_matches(unknown, known, n=1)
    return f"Did you mean {close[0]}?" if close else f"There are: {', '.join(known)}"
