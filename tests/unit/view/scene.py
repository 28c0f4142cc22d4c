"""A right index finger over a left palm, as the pipeline would report it."""

from __future__ import annotations

import numpy as np

from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch, GateReason, GateResult, HandObservation, TouchEstimate, TouchPair
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.hands import host_hand, palm_centre, pointing_hand

FRAME_NS = 33_333_333
INDEX = (Handedness.RIGHT, Finger.INDEX)
HOST = host_hand()
POINTING = pointing_hand(palm_centre(HOST))
PATCH_RED = np.zeros((100, 100, 3), np.uint8)
PATCH_RED[:, :, 0] = 255


def blank_frame(index: int = 0, size_px: tuple[int, int] = (1280, 720)) -> Frame:
    return Frame(np.zeros((size_px[1], size_px[0], 3), np.uint8), index * FRAME_NS, index)


def touching_result(
    index: int,
    kind: EventType | None,
    *,
    finger: Finger = Finger.INDEX,
    force_n: float = 2.0,
    touching: HandObservation = POINTING,
) -> FrameResult:
    """One frame with both hands, one patch and, with `kind`, one event."""
    time_ns = index * FRAME_NS
    x, y = (float(value) for value in touching.xy_px(finger.tip))
    patch = FingertipPatch(touching.hand_id, Handedness.RIGHT, finger, PATCH_RED, 0.5, 0.1, (x, y), 2.0)
    estimate = TouchEstimate(touching.hand_id, finger, 0.9, force_n)
    reason = CancelReason.TRACKING_LOST if kind is EventType.CANCEL else None
    events = () if kind is None else (TouchEvent(kind, 1, 1, time_ns, Handedness.RIGHT, finger, 0.9, 0.0, 0.5, 0.5, 0.0, 0.0, reason),)
    gate = GateResult(GateReason.OPEN, (TouchPair(touching, HOST, 0.5, (finger,)),))
    return FrameResult(index, time_ns, (touching, HOST), gate, (patch,), (estimate,), (estimate,), events, {})
