"""What a script can tell a finger, or the camera, to do."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.simulator.motion import Point
from egotouch_sdk.surface import Surface

#: The longest time a single act may take or wait: ten minutes, so that a slip of the hand does not make a script of days.
MAX_MS = 600_000.0

Ms = Annotated[float, Field(ge=0, le=MAX_MS, allow_inf_nan=False)]
Duration = Annotated[float, Field(gt=0, le=MAX_MS, allow_inf_nan=False)]
Mm = Annotated[float, Field(ge=-1000, le=1000, allow_inf_nan=False)]
Force = Annotated[float, Field(ge=0, le=FORCE_MAX_N, allow_inf_nan=False)]
Pitch = Annotated[float, Field(ge=0, le=90, allow_inf_nan=False)]
Yaw = Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)]
Place = tuple[Mm, Mm]


def _as_path(value: object) -> object:
    """One place stands for a way with one place."""
    return [value] if isinstance(value, list) and value and not isinstance(value[0], list) else value


Way = Annotated[tuple[Place, ...], BeforeValidator(_as_path), Field(min_length=1)]


class Model(BaseModel):
    """Frozen, and refuses keys that it does not know."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Act(Model):
    """Something that happens at its time."""

    word: ClassVar[str]
    after_ms: Ms | None = None
    with_ms: Ms | None = None

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

    at: Place
    hand: Handedness | None = None
    finger: Finger | None = None
    surface: Surface | None = None
    force_n: Force | None = None
    pitch_deg: Pitch | None = None
    yaw_deg: Yaw | None = None
    duration_ms: Duration

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
    duration_ms: Duration = 120.0


class DoubleTap(FingerAct):
    """Two short touches of `duration_ms` each, `gap_ms` apart (within Android's 40..300 ms)."""

    word = "double_tap"
    duration_ms: Duration = 100.0
    gap_ms: Duration = 120.0

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
    duration_ms: Duration = 800.0


class Drag(FingerAct):
    """A touch that moves from `at` along `to`, at rest at both ends."""

    word = "drag"
    to: Way
    duration_ms: Duration = 600.0

    @property
    def path(self) -> tuple[Point, ...]:
        """`at`, then every place of `to`."""
        return (self.at, *self.to)


class Fling(Drag):
    """A drag that lifts while it moves."""

    word = "fling"
    duration_ms: Duration = 300.0


class Hover(FingerAct):
    """A finger over the skin, `height_mm` (default 10) above it, that may move from `at` along `to`."""

    word = "hover"
    to: Way | None = None
    height_mm: Annotated[float, Field(ge=4, le=100, allow_inf_nan=False)] = 10.0
    duration_ms: Duration = 500.0

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
    duration_ms: Duration = 300.0

    @property
    def total_ms(self) -> float:
        """As long as no hand is found."""
        return self.duration_ms


class Stall(Vanish):
    """The camera gives no pictures for a while."""

    word = "stall"
    duration_ms: Duration = 400.0


class Swap(Act):
    """Hand tracking takes all hands for new ones."""

    word = "swap"


ACTS: dict[str, type[Act]] = {act.word: act for act in (Tap, DoubleTap, Press, Drag, Fling, Hover, Vanish, Stall, Swap)}
