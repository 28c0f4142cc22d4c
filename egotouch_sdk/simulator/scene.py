"""What is simulated in one instant: fingertips on a limb, and the imaginary camera that looks at it."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, pi, sin
from typing import Final

import numpy as np

from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.simulator.hand_shape import Points
from egotouch_sdk.surface import Surface, surface_at

#: Surfaces that are seen together: those of the palm's side of a limb; the others are those of its back.
PALM_SIDE: Final = frozenset({Surface.PALM, Surface.INNER_FOREARM})


@dataclass(frozen=True, slots=True)
class SimulatedFinger:
    """One fingertip over the other hand's limb.

    `x_mm`, `y_mm` are in the host frame, `hover_mm` is the height of the tip over the skin (0 touches), `force_n` 0..3.5 presses.
    `pitch_rad` 0..pi/2 is 0 for a finger flat on the skin; `yaw_rad` in [-pi, pi] is 0 for one that points along +y, positive
    towards +x. Raises `FrameError` for a value out of range, a force without touch, or a place that is not on `surface`.
    """

    surface: Surface
    x_mm: float
    y_mm: float
    hover_mm: float = 0.0
    force_n: float = 0.0
    pitch_rad: float = pi / 4
    yaw_rad: float = 0.0
    finger: Finger = Finger.INDEX
    hand: Handedness = Handedness.RIGHT

    def __post_init__(self) -> None:
        if not all(map(isfinite, (self.x_mm, self.y_mm))) or not 0.0 <= self.hover_mm < float("inf"):
            raise FrameError(f"simulated finger is at x_mm={self.x_mm}, y_mm={self.y_mm}, hover_mm={self.hover_mm}")
        if not 0.0 <= self.pitch_rad <= pi / 2 or not -pi <= self.yaw_rad <= pi:
            raise FrameError(f"simulated finger has pitch_rad={self.pitch_rad}, yaw_rad={self.yaw_rad}; need 0..pi/2 and -pi..pi")
        if not 0.0 <= self.force_n <= FORCE_MAX_N:
            raise FrameError(f"simulated finger has force_n={self.force_n}, need 0..{FORCE_MAX_N}")
        if self.force_n > 0.0 and not self.is_touching:
            raise FrameError(f"simulated finger presses with {self.force_n} N at {self.hover_mm} mm", hint="Set hover_mm to 0")
        if self.surface is not surface_at(self.y_mm, palm_side=self.on_palm_side):
            raise FrameError(f"y_mm={self.y_mm} is not on the {self.surface}", hint="The hand has y_mm >= 0, the forearm y_mm < 0")

    @property
    def is_touching(self) -> bool:
        """True when the fingertip is on the skin."""
        return self.hover_mm == 0.0

    @property
    def on_palm_side(self) -> bool:
        """True on the palm and the inner forearm."""
        return self.surface in PALM_SIDE


@dataclass(frozen=True, slots=True)
class SimulatedView:
    """The imaginary camera: a distant one (weak perspective) that looks straight at the limb unless that is turned.

    `turn_rad` turns the limb in the image, clockwise as seen; `tilt_rad` tilts its fingers away from the camera, within +-pi/3.
    """

    width_px: int = 1280
    height_px: int = 720
    px_per_mm: float = 1.7
    turn_rad: float = 0.0
    tilt_rad: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 < self.px_per_mm < float("inf"):
            raise FrameError(f"simulated camera has px_per_mm={self.px_per_mm}, need > 0")
        if not isfinite(self.turn_rad) or not abs(self.tilt_rad) <= pi / 3:
            raise FrameError(f"simulated limb has turn_rad={self.turn_rad}, tilt_rad={self.tilt_rad}; tilt at most pi/3")

    def wrist_px(self, host: Handedness) -> tuple[float, float]:
        """Where the wrist of a host limb is in the image: a left limb in its left part, a right one in its right part."""
        return self.width_px * (0.35 if host is Handedness.LEFT else 0.65), self.height_px * 0.45

    def camera_from_limb(self, host: Handedness, *, palm_side: bool) -> Points:
        """Matrix (3, 3) from the limb (x thumb side, y to the fingers, z out of the skin seen) to the camera (right, down, away).

        Seen from the palm, a left hand's thumb is on the left; so one of the two is a mirror image, as left and right hands are.
        """
        thumb = -1.0 if (host is Handedness.LEFT) == palm_side else 1.0
        upright = np.array([[thumb, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])
        c, s = cos(self.tilt_rad), sin(self.tilt_rad)
        tilt = np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
        c, s = cos(self.turn_rad), sin(self.turn_rad)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return np.asarray(turn @ tilt @ upright)


@dataclass(frozen=True, slots=True)
class SimulatedScene:
    """All that is seen in one instant.

    `fingers` may be of both hands; those of one hand touch the same side of the other's limb. `hosts` are limbs that are seen
    without fingers too, unless their own hand is touching; `palm_side` is the side that they show. `generation` counts how often
    the hand tracking has lost every hand and found it as a new one.
    Raises `FrameError` for a finger given twice or a limb touched on two sides.
    """

    fingers: tuple[SimulatedFinger, ...] = ()
    view: SimulatedView = SimulatedView()
    hosts: tuple[Handedness, ...] = (Handedness.LEFT,)
    palm_side: bool = True
    generation: int = 0

    def __post_init__(self) -> None:
        if self.generation < 0:
            raise FrameError(f"simulated scene has generation={self.generation}, need >= 0")
        if len({(finger.hand, finger.finger) for finger in self.fingers}) < len(self.fingers):
            raise FrameError("a finger is in the simulated scene twice", hint="Give every finger of a hand once")
        for hand in Handedness:
            if len({finger.on_palm_side for finger in self.of_hand(hand)}) > 1:
                raise FrameError(f"the {hand} hand touches both sides of a limb at once", hint="Turn the limb between two touches")

    def of_hand(self, hand: Handedness) -> tuple[SimulatedFinger, ...]:
        """The fingers of one touching hand."""
        return tuple(finger for finger in self.fingers if finger.hand is hand)

    def shows_palm_side(self, host: Handedness) -> bool:
        """True when the limb of `host` shows its palm's side."""
        touching = self.of_hand(host.other)
        return touching[0].on_palm_side if touching else self.palm_side


def place_at(
    x_px: float, y_px: float, *, view: SimulatedView | None = None, host: Handedness = Handedness.LEFT, palm_side: bool = True
) -> tuple[Surface, float, float]:
    """The place of a limb's skin that is seen at an image point: surface, x_mm, y_mm. For a mouse on a drawn limb."""
    view = view or SimulatedView()
    wrist = view.wrist_px(host)
    in_image = (np.array([x_px, y_px]) - wrist) / view.px_per_mm
    x_mm, y_mm = np.linalg.solve(view.camera_from_limb(host, palm_side=palm_side)[:2, :2], in_image).tolist()
    return surface_at(y_mm, palm_side=palm_side), x_mm, y_mm
