"""Drawing hands and fingertips onto the video."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from egotouch_sdk.joints import FINGERS, HandJoint
from egotouch_sdk.observation import FORCE_MAX_N, FloatArray, GateResult, HandObservation
from egotouch_sdk.view.palette import BACKGROUND, HOST_HAND, OTHER_HAND, STATE_COLOUR, TOUCHING_HAND, Colour, Image, put_label
from egotouch_sdk.view.timeline import TipState

#: The hand's bones as pairs of joints: each finger's chain, and the palm's outline (MediaPipe's `HAND_CONNECTIONS`).
BONES: tuple[tuple[HandJoint, HandJoint], ...] = (
    *(pair for finger in FINGERS for pair in zip(finger.chain, finger.chain[1:], strict=False)),
    (HandJoint.WRIST, HandJoint.THUMB_CMC),
    (HandJoint.WRIST, HandJoint.INDEX_FINGER_MCP),
    (HandJoint.INDEX_FINGER_MCP, HandJoint.MIDDLE_FINGER_MCP),
    (HandJoint.MIDDLE_FINGER_MCP, HandJoint.RING_FINGER_MCP),
    (HandJoint.RING_FINGER_MCP, HandJoint.PINKY_MCP),
    (HandJoint.WRIST, HandJoint.PINKY_MCP),
)

_SUBPIXEL_BITS = 4


@dataclass(frozen=True, slots=True)
class Placement:
    """Where the video sits on the canvas: canvas = image * scale + offset."""

    scale: float
    left_px: float
    top_px: float

    def apply(self, xy: FloatArray) -> FloatArray:
        """Image points (..., 2) in canvas pixels."""
        return np.asarray(xy * self.scale + (self.left_px, self.top_px), np.float32)


def _fixed(xy: FloatArray) -> tuple[int, int]:
    x, y = np.clip(np.rint(xy * (1 << _SUBPIXEL_BITS)), -(1 << 20), 1 << 20).astype(int)
    return int(x), int(y)


def _disc(canvas: Image, centre: FloatArray, radius_px: float, colour: Colour, thickness: int = -1) -> None:
    cv2.circle(canvas, _fixed(centre), round(radius_px * (1 << _SUBPIXEL_BITS)), colour, thickness, cv2.LINE_AA, _SUBPIXEL_BITS)


def role_colour(hand: HandObservation, gate: GateResult) -> Colour:
    """The colour of a hand: touching, host, or neither."""
    if any(pair.touching.hand_id == hand.hand_id for pair in gate.pairs):
        return TOUCHING_HAND
    return HOST_HAND if any(pair.host.hand_id == hand.hand_id for pair in gate.pairs) else OTHER_HAND


def draw_hand(canvas: Image, hand: HandObservation, placement: Placement, colour: Colour) -> None:
    """Bones and joints of one hand, with its side at the wrist."""
    points = placement.apply(hand.landmarks_px[:, :2])
    for width, tone in ((5, BACKGROUND), (2, colour)):
        for a, b in BONES:
            cv2.line(canvas, _fixed(points[a]), _fixed(points[b]), tone, width, cv2.LINE_AA, _SUBPIXEL_BITS)
    for point in points:
        _disc(canvas, point, 4.0, BACKGROUND)
        _disc(canvas, point, 2.5, colour)
    x, y = _fixed(points[HandJoint.WRIST] / (1 << _SUBPIXEL_BITS))
    put_label(canvas, hand.handedness.value, (x + 8, y + 18), BACKGROUND, colour)


def draw_tip(canvas: Image, xy: FloatArray, state: TipState, force_n: float) -> None:
    """A ring around a fingertip; filled while it touches, and wider the harder it presses."""
    colour = STATE_COLOUR[state]
    if state is TipState.DOWN:
        _disc(canvas, xy, 7.0, colour)
        _disc(canvas, xy, 11.0 + 14.0 * min(force_n / FORCE_MAX_N, 1.0), colour, 2)
    else:
        _disc(canvas, xy, 10.0, BACKGROUND, 4)
        _disc(canvas, xy, 10.0, colour, 2)
