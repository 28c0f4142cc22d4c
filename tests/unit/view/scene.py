"""A right index finger over a left palm, as the pipeline would report it."""

from __future__ import annotations

import numpy as np

from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FingertipPatch, GateReason, GateResult, HandObservation, HostPoint, TouchEstimate, TouchPair
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType
from tests.support.events import make_event
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
    patch = FingertipPatch(
        hand_id=touching.hand_id,
        handedness=Handedness.RIGHT,
        finger=finger,
        tip_px=(x, y),
        px_per_mm=2.0,
        r_palms=0.5,
        theta_rad=0.1,
        image=PATCH_RED,
    )
    estimate = TouchEstimate(touching.hand_id, finger, 0.9, force_n)
    events = () if kind is None else (make_event(kind, time_ns, finger=finger),)
    gate = GateResult(GateReason.OPEN, (TouchPair(touching, HOST, 0.5, (finger,)),))
    observation = FrameObservation(index, time_ns, 1280, 720, (touching, HOST), gate, (patch,), (estimate,))
    return FrameResult(observation, (estimate,), (HostPoint(Surface.PALM, 0.0, 50.0, 0.7, 0.0),), events)
