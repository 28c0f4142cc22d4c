"""Where the fingertip is on the host limb: the touch model's second input (R, theta)."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, hypot, pi

import numpy as np
import numpy.typing as npt

Point = Sequence[float] | npt.NDArray[np.floating]

#: (R, theta) when no usable host hand is in view; a tip exactly on the wrist gives it too.
HOST_UNKNOWN = (0.0, 0.0)
#: A wrist-to-MCP axis shorter than this many pixels has no direction (our choice).
MIN_AXIS_PX = 1.0


def polar(host_wrist_xy: Point, host_middle_mcp_xy: Point, tip_xy: Point, mirror: bool) -> tuple[float, float]:
    """Locate a fingertip relative to the host wrist on the axis wrist to middle MCP (EgoTouch, UIST'24, section 4).

    All points are image pixels (x right, y down). Returns `(r_palms, theta_rad)`: the distance wrist to tip in lengths
    of the axis, and the angle from the axis to the tip, counter-clockwise as seen, in (-pi, pi], its sign flipped when
    `mirror` (a left touching hand). Returns `HOST_UNKNOWN` for an axis shorter than 1 px.
    """
    axis_x = float(host_middle_mcp_xy[0]) - float(host_wrist_xy[0])
    axis_y = float(host_middle_mcp_xy[1]) - float(host_wrist_xy[1])
    tip_x = float(tip_xy[0]) - float(host_wrist_xy[0])
    tip_y = float(tip_xy[1]) - float(host_wrist_xy[1])
    axis = hypot(axis_x, axis_y)
    if axis < MIN_AXIS_PX:
        return HOST_UNKNOWN
    counter_clockwise = axis_y * tip_x - axis_x * tip_y
    theta = atan2(-counter_clockwise if mirror else counter_clockwise, axis_x * tip_x + axis_y * tip_y)
    return hypot(tip_x, tip_y) / axis, pi if theta <= -pi else theta
