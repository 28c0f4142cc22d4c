"""Plausible hands for tests, built joint by joint.

A hand is described in millimetres in its own plane: x to its thumb side, y from the wrist to the middle MCP, z out of the palm.
Sizes are those between MediaPipe's landmarks on the generic WebXR hand, rounded.
"""

from __future__ import annotations

from collections.abc import Collection
from math import cos, radians, sin

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import FINGERS, Finger, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation

PALM_MM = 83.0
FOUR = (Finger.INDEX, Finger.MIDDLE, Finger.RING, Finger.PINKY)
_KNUCKLES = {Finger.INDEX: (22.0, 80.0), Finger.MIDDLE: (0.0, PALM_MM), Finger.RING: (-18.0, 77.0), Finger.PINKY: (-36.0, 66.0)}
_PHALANGES = {
    Finger.INDEX: (38.0, 24.0, 16.0),
    Finger.MIDDLE: (40.0, 27.0, 17.6),
    Finger.RING: (36.0, 27.0, 16.7),
    Finger.PINKY: (28.0, 20.0, 15.3),
}
_OPEN_THUMB = ((23.0, 18.0, 8.0), (42.0, 44.0, 12.0), (58.0, 72.0, 14.0), (67.0, 87.5, 14.0))
_TUCKED_THUMB = ((23.0, 18.0, 8.0), (38.0, 46.0, 18.0), (15.0, 58.0, 30.0), (-3.0, 59.0, 31.0))
_STRAIGHT = (5.0, 5.0, 5.0)
_FIST = (75.0, 100.0, 65.0)


def hand_mm(
    extended: Collection[Finger] = FINGERS, bends_deg: dict[Finger, tuple[float, float, float]] | None = None
) -> npt.NDArray[np.float64]:
    """Landmarks (21, 3) of a right hand with its thumb at +x; fingers not in `extended` are curled into a fist."""
    points = np.zeros((21, 3))
    for finger in FINGERS:
        if finger is Finger.THUMB:
            points[list(finger.chain)] = _OPEN_THUMB if finger in extended else _TUCKED_THUMB
            continue
        bends = (bends_deg or {}).get(finger, _STRAIGHT if finger in extended else _FIST)
        position, angle = np.array([*_KNUCKLES[finger], 0.0]), 0.0
        points[finger.chain[0]] = position
        for joint, bone, bend in zip(finger.chain[1:], _PHALANGES[finger], bends, strict=True):
            angle += radians(bend)
            position = position + bone * np.array([0.0, cos(angle), sin(angle)])
            points[joint] = position
    return points


def make_hand(
    handedness: Handedness = Handedness.RIGHT,
    *,
    wrist_px: tuple[float, float] = (400.0, 400.0),
    pointing_deg: float = 90.0,
    tilt_deg: float = 0.0,
    px_per_mm: float = 2.0,
    extended: Collection[Finger] = FINGERS,
    bends_deg: dict[Finger, tuple[float, float, float]] | None = None,
    palm_up: bool = False,
    hand_id: int = 1,
    score: float = 1.0,
) -> HandObservation:
    """A hand seen by a distant camera.

    `pointing_deg` is the direction wrist to middle MCP as seen (0 right, 90 up); `tilt_deg` turns the fingers away from the
    camera. The back of the hand faces the camera unless `palm_up`.
    """
    local = hand_mm(extended, bends_deg)
    thumb_to_the_left = (handedness is Handedness.RIGHT) != palm_up
    x = -local[:, 0] if thumb_to_the_left else local[:, 0]
    z = -local[:, 2] if palm_up else local[:, 2]
    tilt = radians(tilt_deg)
    up, away = local[:, 1] * cos(tilt) - z * sin(tilt), local[:, 1] * sin(tilt) + z * cos(tilt)
    turn = radians(pointing_deg - 90.0)
    right, upward = x * cos(turn) - up * sin(turn), x * sin(turn) + up * cos(turn)
    world = np.stack([right, -upward, away], axis=1)
    pixels = world * px_per_mm
    pixels[:, :2] += wrist_px
    return HandObservation(hand_id, handedness, score, pixels, world - world.mean(axis=0))


def with_tip_at(hand: HandObservation, finger: Finger, tip_px: tuple[float, float]) -> HandObservation:
    """The same hand, moved in the image so that one fingertip is at `tip_px`."""
    moved = hand.landmarks_px.copy()
    moved[:, :2] += np.asarray(tip_px, np.float32) - moved[finger.tip, :2]
    return HandObservation(hand.hand_id, hand.handedness, hand.score, moved, hand.world_mm)


def host_hand(**options: object) -> HandObservation:
    """A flat left hand, palm towards the camera, fingers up."""
    return make_hand(Handedness.LEFT, **{"hand_id": 2, "palm_up": True, "wrist_px": (640.0, 500.0), **options})  # type: ignore[arg-type]


def pointing_hand(tip_px: tuple[float, float], **options: object) -> HandObservation:
    """A right hand that points with its index finger, fingertip at `tip_px`, coming from the lower right."""
    hand = make_hand(Handedness.RIGHT, **{"hand_id": 1, "extended": (Finger.INDEX,), "pointing_deg": 135.0, **options})  # type: ignore[arg-type]
    return with_tip_at(hand, Finger.INDEX, tip_px)


def palm_centre(host: HandObservation) -> tuple[float, float]:
    """The middle of the host's palm in the image."""
    x, y = host.landmarks_px[[0, 5, 17], :2].mean(axis=0)
    return float(x), float(y)


def host_frame_xy(host: HandObservation, tip_px: tuple[float, float]) -> tuple[float, float]:
    """A fingertip in the host's own frame in the image: origin wrist, +y to the middle MCP, +x to the host's thumb side.

    Both in lengths wrist to middle MCP.
    """
    wrist = host.xy_px(HandJoint.WRIST)
    axis_x, axis_y = (float(v) for v in host.xy_px(HandJoint.MIDDLE_FINGER_MCP) - wrist)
    thumb_x, thumb_y = (float(v) for v in host.xy_px(HandJoint.INDEX_FINGER_MCP) - host.xy_px(HandJoint.PINKY_MCP))
    tip_x, tip_y = tip_px[0] - float(wrist[0]), tip_px[1] - float(wrist[1])
    squared = axis_x * axis_x + axis_y * axis_y
    thumb_side = 1.0 if axis_x * thumb_y - axis_y * thumb_x >= 0 else -1.0
    return thumb_side * (axis_x * tip_y - axis_y * tip_x) / squared, (axis_x * tip_x + axis_y * tip_y) / squared
