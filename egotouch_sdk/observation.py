"""What each stage sees in one frame: frozen data passed along the pipeline's arrows."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from math import isfinite, pi
from typing import Any

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import NUM_JOINTS, Finger, HandJoint, Handedness
from egotouch_sdk.surface import Surface

FloatArray = npt.NDArray[np.float32]

#: Side of the touch model's patch in pixels (EgoTouch, UIST'24, section 4: 100 x 100 px, about 4 x 4 cm).
PATCH_PX = 100
#: Side of the touch model's patch on the skin in millimetres (same section).
PATCH_MM = 40.0
#: Largest force the model reports, in newtons (range of the paper's sensor study).
FORCE_MAX_N = 3.5


def frozen_array(value: Any, shape: tuple[int, ...], name: str) -> FloatArray:
    """Copy `value` into a read-only float32 array of `shape`; raises `FrameError` when it does not fit or is not finite."""
    array = np.array(value, np.float32)
    if array.shape != shape:
        raise FrameError(f"{name} has shape {array.shape}, need {shape}")
    if not np.isfinite(array).all():
        raise FrameError(f"{name} holds a value that is not finite")
    array.flags.writeable = False
    return array


@dataclass(frozen=True, slots=True, eq=False)
class HandObservation:
    """One hand in one frame.

    `hand_id` is the identity over time; `handedness` the wearer's side; `score` 0..1 the presence.
    `landmarks_px` (21, 3): x, y in image pixels, z in the same scale relative to the wrist, smaller = nearer.
    `world_mm` (21, 3): metric, camera-aligned axes (x right, y down, z away), origin at the hand's centre.
    """

    hand_id: int
    handedness: Handedness
    score: float
    landmarks_px: FloatArray
    world_mm: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "landmarks_px", frozen_array(self.landmarks_px, (NUM_JOINTS, 3), "landmarks_px"))
        object.__setattr__(self, "world_mm", frozen_array(self.world_mm, (NUM_JOINTS, 3), "world_mm"))
        if not 0.0 <= self.score <= 1.0:
            raise FrameError(f"hand score is {self.score}, need 0..1")

    def xy_px(self, joint: HandJoint) -> FloatArray:
        """Image position (2,) of one joint in pixels."""
        return self.landmarks_px[joint, :2]


class GateReason(StrEnum):
    """Why the proximity gate is open or closed."""

    OPEN = "open"
    NO_HANDS = "no_hands"
    NO_HOST = "no_host"
    TOO_FAR = "too_far"
    NO_ACTIVE_FINGER = "no_active_finger"


@dataclass(frozen=True, slots=True)
class TouchPair:
    """One touching hand over one host limb, with the fingers that could touch it."""

    touching: HandObservation
    host: HandObservation
    distance_palms: float
    active_fingers: tuple[Finger, ...]


@dataclass(frozen=True, slots=True)
class GateResult:
    """The gate's answer for one frame: `pairs` to look at, and why the gate is open or closed."""

    reason: GateReason
    pairs: tuple[TouchPair, ...] = ()

    @property
    def is_open(self) -> bool:
        """True when at least one finger is worth looking at."""
        return self.reason is GateReason.OPEN


@dataclass(frozen=True, slots=True, kw_only=True)
class Fingertip:
    """Where one fingertip is that could touch.

    `tip_px` (2,) and `px_per_mm` locate it in the frame.
    `r_palms` is the distance host wrist to fingertip in lengths of the axis wrist to middle MCP;
    `theta_rad` its angle from that axis, counter-clockwise as seen, in (-pi, pi], sign flipped for a left touching hand.
    Both are 0 where the host is unknown.
    """

    hand_id: int
    handedness: Handedness
    finger: Finger
    tip_px: tuple[float, float]
    px_per_mm: float
    r_palms: float = 0.0
    theta_rad: float = 0.0

    def __post_init__(self) -> None:
        if not self.px_per_mm > 0:
            raise FrameError(f"fingertip px_per_mm is {self.px_per_mm}, need > 0")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FingertipPatch(Fingertip):
    """A fingertip with its finger-up view.

    `image` (100, 100, 3) uint8 RGB, tip at the centre, DIP to TIP pointing up, mirrored for a left touching hand.
    """

    image: npt.NDArray[np.uint8] = field(repr=False)

    def __post_init__(self) -> None:
        Fingertip.__post_init__(self)
        if self.image.shape != (PATCH_PX, PATCH_PX, 3) or self.image.dtype != np.uint8:
            raise FrameError(f"patch is {self.image.dtype} {self.image.shape}, need uint8 ({PATCH_PX}, {PATCH_PX}, 3)")


@dataclass(frozen=True, slots=True)
class HostPoint:
    """A fingertip in the host's own frame.

    `x_mm`, `y_mm`: origin at the host's wrist landmark, +y to the middle MCP, +x to the host's thumb side, on the `surface` under
    the finger. `pitch_rad` 0 (flat on the skin) to pi/2 (perpendicular); `yaw_rad` in (-pi, pi], 0 along +y, positive towards +x.
    """

    surface: Surface
    x_mm: float
    y_mm: float
    pitch_rad: float
    yaw_rad: float

    def __post_init__(self) -> None:
        if not (isfinite(self.x_mm) and isfinite(self.y_mm) and 0.0 <= self.pitch_rad <= pi / 2 and -pi <= self.yaw_rad <= pi):
            raise FrameError(f"host point is out of range: {self}")


@dataclass(frozen=True, slots=True)
class TouchEstimate:
    """The touch model's answer for one fingertip in one frame: probability 0..1 and force in newtons, 0..3.5.

    `force_sigma_n` is the standard error of the force if it is a touch, None when the model gives none.
    """

    hand_id: int
    finger: Finger
    touch_probability: float
    force_n: float
    force_sigma_n: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 <= self.touch_probability <= 1.0:
            raise FrameError(f"touch_probability is {self.touch_probability}, need 0..1")
        if not 0.0 <= self.force_n <= FORCE_MAX_N:
            raise FrameError(f"force_n is {self.force_n}, need 0..{FORCE_MAX_N}")
        if self.force_sigma_n is not None and not 0.0 <= self.force_sigma_n < float("inf"):
            raise FrameError(f"force_sigma_n is {self.force_sigma_n}, need 0 or more, or None")
