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
from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from egotouch_sdk.errors import ConfigError, MissingExtraError, SourceError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.simulator.motion import Point
from egotouch_sdk.surface import Surface

#: The longest time a single act may take or wait: ten minutes, so that a slip of the hand does not make a script of days.
MAX_MS = 600_000.0

_Ms = Annotated[float, Field(ge=0, le=MAX_MS, allow_inf_nan=False)]
_Duration = Annotated[float, Field(gt=0, le=MAX_MS, allow_inf_nan=False)]
_Mm = Annotated[float, Field(ge=-1000, le=1000, allow_inf_nan=False)]
_Force = Annotated[float, Field(ge=0, le=FORCE_MAX_N, allow_inf_nan=False)]
_Pitch = Annotated[float, Field(ge=0, le=90, allow_inf_nan=False)]
_Yaw = Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)]
_Place = tuple[_Mm, _Mm]


def _as_path(value: object) -> object:
    """One place stands for a way with one place."""
    return [value] if isinstance(value, list) and value and not isinstance(value[0], list) else value


_Path = Annotated[tuple[_Place, ...], BeforeValidator(_as_path), Field(min_length=1)]


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Act(_Model):
    """Something that happens at its time."""

    word: ClassVar[str]
    after_ms: _Ms | None = None
    with_ms: _Ms | None = None

    @model_validator(mode="after")
    def _one_start(self) -> Self:
        if self.after_ms is not None and self.with_ms is not None:
            raise ValueError("give after_ms or with_ms, not both")
        return self

    @property
    def total_ms(self) -> float:
        """How long the act takes."""
        return 0.0


class FingerAct(Act):
    """A finger does something at a place; what is None is taken from the script."""

    at: _Place
    hand: Handedness | None = None
    finger: Finger | None = None
    surface: Surface | None = None
    force_n: _Force | None = None
    pitch_deg: _Pitch | None = None
    yaw_deg: _Yaw | None = None
    duration_ms: _Duration

    @property
    def total_ms(self) -> float:
        """From the first touch to the last lift."""
        return self.duration_ms

    @property
    def path(self) -> tuple[Point, ...]:
        """The places that the finger goes through, `at` first."""
        return (self.at,)

    @property
    def contacts_ms(self) -> tuple[tuple[float, float], ...]:
        """When the finger is on the skin, from the act's start."""
        return ((0.0, self.duration_ms),)


class Tap(FingerAct):
    """A short touch (120 ms; Android's tap timeout is 100 ms)."""

    word = "tap"
    duration_ms: _Duration = 120.0


class DoubleTap(FingerAct):
    """Two short touches of `duration_ms` each, `gap_ms` apart (within Android's 40..300 ms)."""

    word = "double_tap"
    duration_ms: _Duration = 100.0
    gap_ms: _Duration = 120.0

    @property
    def total_ms(self) -> float:
        """Both touches and the gap."""
        return 2 * self.duration_ms + self.gap_ms

    @property
    def contacts_ms(self) -> tuple[tuple[float, float], ...]:
        """The two touches."""
        return (0.0, self.duration_ms), (self.duration_ms + self.gap_ms, self.total_ms)


class Press(FingerAct):
    """A touch that stays (800 ms; Android's long press timeout is 400 ms)."""

    word = "press"
    duration_ms: _Duration = 800.0


class Drag(FingerAct):
    """A touch that moves from `at` along `to`, at rest at both ends."""

    word = "drag"
    to: _Path
    duration_ms: _Duration = 600.0

    @property
    def path(self) -> tuple[Point, ...]:
        """`at`, then every place of `to`."""
        return (self.at, *self.to)


class Fling(Drag):
    """A drag that lifts while it moves."""

    word = "fling"
    duration_ms: _Duration = 300.0


class Hover(FingerAct):
    """A finger over the skin, `height_mm` (default 10) above it, that may move from `at` along `to`."""

    word = "hover"
    to: _Path | None = None
    height_mm: Annotated[float, Field(ge=4, le=100, allow_inf_nan=False)] = 10.0
    duration_ms: _Duration = 500.0

    @property
    def path(self) -> tuple[Point, ...]:
        """`at`, then every place of `to`."""
        return (self.at, *(self.to or ()))

    @property
    def contacts_ms(self) -> tuple[tuple[float, float], ...]:
        """Never."""
        return ()


class Vanish(Act):
    """Hand tracking finds no hand for a while."""

    word = "vanish"
    duration_ms: _Duration = 300.0

    @property
    def total_ms(self) -> float:
        """As long as no hand is found."""
        return self.duration_ms


class Stall(Vanish):
    """The camera gives no pictures for a while."""

    word = "stall"
    duration_ms: _Duration = 400.0


class Swap(Act):
    """Hand tracking takes all hands for new ones."""

    word = "swap"


ACTS: dict[str, type[Act]] = {act.word: act for act in (Tap, DoubleTap, Press, Drag, Fling, Hover, Vanish, Stall, Swap)}


class Script(_Model):
    """A whole script; the defaults and the meaning of every key are at the top of this module."""

    name: str = ""
    fps: Annotated[float, Field(ge=1, le=240, allow_inf_nan=False)] = 60.0
    hand: Handedness = Handedness.RIGHT
    finger: Finger = Finger.INDEX
    surface: Surface = Surface.PALM
    force_n: _Force = 1.0
    pitch_deg: _Pitch = 45.0
    yaw_deg: _Yaw = 0.0
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
