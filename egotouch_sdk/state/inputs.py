"""From numbers to the discrete inputs of the state table."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from egotouch_sdk.config import StateConfig
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.state.sample import FingertipSample
from egotouch_sdk.state.table import Input


@dataclass(frozen=True, slots=True)
class Thresholds:
    """A touch begins at `down` and ends below `up`, both touch probabilities, 0 < up <= down < 1."""

    down: float
    up: float

    def __post_init__(self) -> None:
        if not 0.0 < self.up <= self.down < 1.0:
            raise ConfigError(f"touch thresholds are down={self.down}, up={self.up}", hint="Choose 0 < up <= down < 1")

    def overridden_by(self, config: StateConfig) -> Thresholds:
        """These thresholds, with those that `config` sets in their place; `ConfigError` when they contradict each other."""
        down = self.down if config.down_probability is None else config.down_probability
        up = self.up if config.up_probability is None else config.up_probability
        return Thresholds(down, up)

    def read(self, touch_probability: float) -> Input:
        """The input that a seen fingertip gives."""
        if touch_probability >= self.down:
            return Input.CONTACT
        return Input.LIFTED if touch_probability < self.up else Input.BETWEEN


def has_jumped(before: FingertipSample, after: FingertipSample, elapsed_ns: int, config: StateConfig, *, is_touching: bool) -> bool:
    """True when a fingertip would have had to move faster than a finger can.

    A touch is where it is on the host limb, and must not jump there. While it hovers, the way across the image counts instead
    where that is shorter: a noisy host then moves the limb, not the finger.
    """
    way_mm = hypot(after.point.x_mm - before.point.x_mm, after.point.y_mm - before.point.y_mm)
    if not is_touching:
        scale = max(before.px_per_mm, after.px_per_mm)
        way_mm = min(way_mm, hypot(after.tip_px[0] - before.tip_px[0], after.tip_px[1] - before.tip_px[1]) / scale)
    return way_mm > config.max_speed_mm_s * elapsed_ns / 1e9 + config.jump_slack_mm
