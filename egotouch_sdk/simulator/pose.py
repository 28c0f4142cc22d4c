"""The rigid scene: host and touching hands as landmarks in millimetres, in the frame of the host limb's skin."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

import numpy as np

from egotouch_sdk.simulator.hand_shape import Points, flat_hand, pointing_hand
from egotouch_sdk.simulator.scene import SimulatedFinger

# Axes of the limb frame: x to the host's thumb side, y to its fingers, z out of the skin that is seen; the wrist is the origin.


def host_on_limb(*, palm_side: bool) -> Points:
    """Landmarks (21, 3) of the host hand; its palm lies in the plane z = 0."""
    points = flat_hand()
    if not palm_side:
        points[:, 2] *= -1.0
    return points


def touching_on_limb(fingers: Sequence[SimulatedFinger], *, palm_side: bool) -> Points:
    """Landmarks (21, 3) of a touching hand with each of `fingers` where it was asked to be.

    The hand as a whole follows the first finger as one rigid body; the others are bent at their joints until they reach their own
    places, and stretched where that is beyond a real hand's reach.
    """
    lead = fingers[0]
    points = pointing_hand([finger.finger for finger in fingers])
    # Two hands are mirror images, and so are the limb's frames on its two sides: seen from its back, the host's frame turns the
    # same way as the touching hand's own; seen from its palm, the other way.
    if palm_side:
        points[:, 0] *= -1.0
    dip, tip = points[lead.finger.dip], points[lead.finger.tip]
    own = _frame(tip - dip, np.array([0.0, 0.0, -1.0]))
    asked = np.stack(directions(lead), axis=1)
    asked = np.column_stack([asked, np.cross(asked[:, 0], asked[:, 1])])
    placed = np.asarray((points - tip) @ (asked @ own.T).T + _tip(lead))
    for finger in fingers[1:]:
        _bend_to(placed, finger)
    return placed


def directions(finger: SimulatedFinger) -> tuple[Points, Points]:
    """Unit vectors (3,) along the last bone, DIP to tip, and out of the back of the finger."""
    sin_yaw, cos_yaw = sin(finger.yaw_rad), cos(finger.yaw_rad)
    sin_pitch, cos_pitch = sin(finger.pitch_rad), cos(finger.pitch_rad)
    along = np.array([sin_yaw * cos_pitch, cos_yaw * cos_pitch, -sin_pitch])
    back = np.array([sin_yaw * sin_pitch, cos_yaw * sin_pitch, cos_pitch])
    return along, back


def _frame(along: Points, back: Points) -> Points:
    """Columns: `along`, the part of `back` perpendicular to it, and their cross product; all of length 1."""
    along = along / np.linalg.norm(along)
    back = back - (back @ along) * along
    back = back / np.linalg.norm(back)
    return np.column_stack([along, back, np.cross(along, back)])


def _tip(finger: SimulatedFinger) -> Points:
    return np.array([finger.x_mm, finger.y_mm, finger.hover_mm])


def _bend_to(points: Points, finger: SimulatedFinger) -> None:
    """Move the last three joints of a finger in place: tip and DIP as asked, PIP so that its bones keep their lengths."""
    base, pip, dip, tip = finger.finger.chain
    first_mm, second_mm, last_mm = (float(np.linalg.norm(points[b] - points[a])) for a, b in ((base, pip), (pip, dip), (dip, tip)))
    along, back = directions(finger)
    points[tip] = _tip(finger)
    points[dip] = points[tip] - last_mm * along
    points[pip] = _knee(points[base], points[dip], first_mm, second_mm, back)


def _knee(start: Points, end: Points, first_mm: float, second_mm: float, towards: Points) -> Points:
    """The joint between two bones that reach from `start` to `end`, bent to the side of `towards`; on the line when they are too short."""
    reach = end - start
    distance_mm = max(float(np.linalg.norm(reach)), 1e-6)
    line = reach / distance_mm
    side = towards - (towards @ line) * line
    length = float(np.linalg.norm(side))
    along_mm = (distance_mm**2 + first_mm**2 - second_mm**2) / (2.0 * distance_mm)
    beside_mm = max(first_mm**2 - along_mm**2, 0.0) ** 0.5
    if beside_mm == 0.0 or length < 1e-6:
        return np.asarray(start + reach * (first_mm / (first_mm + second_mm)))
    return np.asarray(start + along_mm * line + beside_mm * side / length)
