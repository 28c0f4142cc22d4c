"""From numbers to the discrete inputs of the state table."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from egotouch_sdk.config import StateConfig
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.state.sample import FingertipSample
from egotouch_sdk.state.table import Input

#: Wrist to middle MCP in millimetres between MediaPipe's landmarks, to turn palm lengths into a speed (the generic WebXR hand
#: with landmarks placed as MediaPipe places them, our measurement).
PALM_MM = 83.0


@dataclass(frozen=True, slots=True)
class Thresholds:
    """A touch begins at `down` and ends below `up`, both touch probabilities, 0 < up <= down < 1."""

    down: float
    up: float

    def __post_init__(self) -> None:
        if not 0.0 < self.up <= self.down < 1.0:
            raise ConfigError(f"touch thresholds are down={self.down}, up={self.up}", hint="Choose 0 < up <= down < 1")

    def read(self, touch_probability: float) -> Input:
        """The input that a seen fingertip gives."""
        if touch_probability >= self.down:
            return Input.CONTACT
        return Input.LIFTED if touch_probability < self.up else Input.BETWEEN


def has_jumped(before: FingertipSample, after: FingertipSample, elapsed_ns: int, config: StateConfig) -> bool:
    """True when a fingertip would have had to move faster than a finger can.

    The way is measured across the image and, where both samples know it, across the host limb; the shorter one counts, since
    a turning head moves the image and a noisy host moves the limb.
    """
    scale = max(before.px_per_mm, after.px_per_mm)
    way_mm = hypot(after.tip_px[0] - before.tip_px[0], after.tip_px[1] - before.tip_px[1]) / scale
    if before.host_palms is not None and after.host_palms is not None:
        on_host = hypot(after.host_palms[0] - before.host_palms[0], after.host_palms[1] - before.host_palms[1])
        way_mm = min(way_mm, on_host * PALM_MM)
    return way_mm > config.max_speed_mm_s * elapsed_ns / 1e9 + config.jump_slack_mm
