"""Any event and any observation that the SDK's own types allow."""

from __future__ import annotations

from math import pi

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.observation import Fingertip, GateReason, GateResult, HandObservation, TouchEstimate, TouchPair
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

TIMES_NS = st.integers(0, 2**63 - 1)
MILLIMETRES = st.floats(-1e6, 1e6)
_REASONS = {
    EventType.CANCEL: st.sampled_from(CancelReason),
    EventType.DRAG_END: st.none() | st.sampled_from(CancelReason),
    EventType.FORCE_EXIT: st.none() | st.sampled_from(CancelReason),
}
_COUNTS = {EventType.CLICK: st.integers(1, 2), EventType.DOUBLE_CLICK: st.just(2)}


@st.composite
def touch_events(draw: st.DrawFn, max_coalesced: int = 2) -> TouchEvent:
    """One event with any values its type may have."""
    kind = draw(st.sampled_from(EventType))
    return TouchEvent(
        type=kind,
        pointer_id=draw(st.integers(0, 2**32 - 1)),
        contact_id=draw(st.integers(0, 2**32 - 1)),
        timestamp_ns=draw(TIMES_NS),
        hand=draw(st.sampled_from(Handedness)),
        finger=draw(st.sampled_from(FINGERS)),
        surface=draw(st.sampled_from(Surface)),
        touch_probability=draw(st.floats(0, 1)),
        force_n=draw(st.floats(0, 3.5)),
        x_mm=draw(MILLIMETRES),
        y_mm=draw(MILLIMETRES),
        pitch_rad=draw(st.floats(0, pi / 2)),
        yaw_rad=draw(st.floats(-pi, pi)),
        image_x=draw(MILLIMETRES),
        image_y=draw(MILLIMETRES),
        down_time_ns=None if kind.is_hover else draw(TIMES_NS),
        force_sigma_n=draw(st.none() | st.floats(0, 10)),
        dx_mm=draw(MILLIMETRES),
        dy_mm=draw(MILLIMETRES),
        velocity_x_mm_s=draw(MILLIMETRES),
        velocity_y_mm_s=draw(MILLIMETRES),
        click_count=draw(_COUNTS.get(kind, st.just(0))),
        reason=draw(_REASONS.get(kind, st.none())),
        coalesced=tuple(draw(st.lists(touch_events(0), max_size=max_coalesced))) if max_coalesced else (),
    )


_LANDMARKS = arrays(np.float32, (21, 3), elements=st.floats(-1e5, 1e5, width=32), fill=st.floats(0, 1000, width=32))


@st.composite
def hands(draw: st.DrawFn) -> HandObservation:
    """One hand anywhere."""
    hand_id = draw(st.integers(-(2**63), 2**63 - 1))
    return HandObservation(hand_id, draw(st.sampled_from(Handedness)), draw(st.floats(0, 1)), draw(_LANDMARKS), draw(_LANDMARKS))


@st.composite
def observations(draw: st.DrawFn) -> FrameObservation:
    """One frame with any hands, pairs and fingertips."""
    seen = draw(st.lists(hands(), max_size=2))
    fingers = st.lists(st.sampled_from(FINGERS), unique=True).map(tuple)
    pairs = tuple(TouchPair(a, draw(hands()), draw(st.floats(0, 1e6)), draw(fingers)) for a in seen)
    tips, estimates = [], []
    for pair in pairs:
        for finger in pair.active_fingers:
            hand = pair.touching
            place = draw(st.tuples(st.floats(allow_nan=False), st.floats(allow_nan=False)))
            scale, r, theta = draw(st.tuples(st.floats(1e-300, 1e300), st.floats(0, 1e300), st.floats(-pi, pi)))
            at = {"tip_px": place, "px_per_mm": scale, "r_palms": r, "theta_rad": theta}
            tips.append(Fingertip(hand_id=hand.hand_id, handedness=hand.handedness, finger=finger, **at))
            sigma_n = draw(st.none() | st.floats(0, 10))
            estimates.append(TouchEstimate(hand.hand_id, finger, draw(st.floats(0, 1)), draw(st.floats(0, 3.5)), sigma_n))
    gate = GateResult(draw(st.sampled_from(GateReason)), pairs)
    size = draw(st.integers(32, 2**32 - 1)), draw(st.integers(32, 2**32 - 1))
    return FrameObservation(draw(st.integers(0, 2**64 - 1)), draw(TIMES_NS), *size, tuple(seen), gate, tuple(tips), tuple(estimates))
