"""From a touching hand over its host to the finger-up patches the touch model sees."""

from __future__ import annotations

from enum import StrEnum
from math import hypot

from egotouch_sdk import hand_geometry
from egotouch_sdk.config import PatchesConfig
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger, HandJoint, Handedness
from egotouch_sdk.observation import FingertipPatch, HandObservation, TouchPair
from egotouch_sdk.patches.cut import cut_patch
from egotouch_sdk.patches.polar import HOST_UNKNOWN, polar
from egotouch_sdk.patches.scale import tip_px_per_mm

#: A finger seen shorter than this from DIP to TIP points at the camera and has no direction in the image (our choice).
MIN_DIRECTION_PX = 1.0

DEFAULTS = PatchesConfig()


class PatchRefusal(StrEnum):
    """Why a fingertip gets no patch."""

    OUTSIDE_FRAME = "outside_frame"
    NO_DIRECTION = "no_direction"
    TOO_SMALL = "too_small"


def extract(frame: Frame, pair: TouchPair, config: PatchesConfig = DEFAULTS, *, mirrored: bool = False) -> tuple[FingertipPatch, ...]:
    """Cut one patch for each active finger of the touching hand, in the pair's order.

    Fingers that `refusal` names a reason for are left out. `mirrored` says that the picture itself is a mirror image (a selfie
    camera), in which the wearer's right hand looks like a left one.
    """
    return tuple(
        _patch(frame, pair, finger, mirrored) for finger in pair.active_fingers if refusal(frame, pair.touching, finger, config) is None
    )


def refusal(frame: Frame, hand: HandObservation, finger: Finger, config: PatchesConfig = DEFAULTS) -> PatchRefusal | None:
    """The reason why this fingertip cannot be cut from this frame, or None when it can."""
    tip, dip = hand.xy_px(finger.tip), hand.xy_px(finger.dip)
    if not (-0.5 <= tip[0] <= frame.width_px - 0.5 and -0.5 <= tip[1] <= frame.height_px - 0.5):
        return PatchRefusal.OUTSIDE_FRAME
    if hypot(float(tip[0] - dip[0]), float(tip[1] - dip[1])) < MIN_DIRECTION_PX:
        return PatchRefusal.NO_DIRECTION
    if tip_px_per_mm(hand, finger) < config.min_px_per_mm:
        return PatchRefusal.TOO_SMALL
    return None


def _patch(frame: Frame, pair: TouchPair, finger: Finger, mirrored: bool) -> FingertipPatch:
    hand, host = pair.touching, pair.host
    tip = hand.xy_px(finger.tip)
    scale = tip_px_per_mm(hand, finger)
    looks_left = (hand.handedness is Handedness.LEFT) != mirrored
    r_palms, theta_rad = HOST_UNKNOWN
    if hand_geometry.has_axis(host):
        r_palms, theta_rad = polar(host.xy_px(HandJoint.WRIST), host.xy_px(HandJoint.MIDDLE_FINGER_MCP), tip, looks_left)
    return FingertipPatch(
        hand_id=hand.hand_id,
        handedness=hand.handedness,
        finger=finger,
        image=cut_patch(frame.image, tip, tip - hand.xy_px(finger.dip), scale, looks_left),
        r_palms=r_palms,
        theta_rad=theta_rad,
        tip_px=(float(tip[0]), float(tip[1])),
        px_per_mm=scale,
    )
