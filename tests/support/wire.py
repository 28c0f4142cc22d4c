"""What must be equal after a way over the wire, as plain values."""

from __future__ import annotations

from typing import Any

import numpy as np

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.touch_event import TouchEvent
from egotouch_sdk.wire import event_from_proto, event_to_proto


def rounded(event: TouchEvent) -> TouchEvent:
    """The event as a reader of the wire sees it, its numbers in 32 bits."""
    return event_from_proto(event_to_proto(event))


def float32_fields(event: TouchEvent) -> dict[str, Any]:
    """All fields, numbers rounded to the nearest 32-bit float by numpy."""
    values = event.to_dict() | {"coalesced": [float32_fields(older) for older in event.coalesced]}
    return {name: float(np.float32(value)) if isinstance(value, float) else value for name, value in values.items()}


def exact(observation: FrameObservation) -> tuple[Any, ...]:
    """Every bit of an observation, the pictures of its fingertips aside."""
    tips = [(t.hand_id, t.handedness, t.finger, t.tip_px, t.px_per_mm, t.r_palms, t.theta_rad) for t in observation.fingertips]
    return (
        observation.index,
        observation.timestamp_ns,
        (observation.width_px, observation.height_px),
        [_hand(hand) for hand in observation.hands],
        observation.gate.reason,
        [_pair(pair) for pair in observation.gate.pairs],
        tips,
        observation.estimates,
    )


def _hand(hand: HandObservation) -> tuple[Any, ...]:
    return hand.hand_id, hand.handedness, hand.score, hand.landmarks_px.tobytes(), hand.world_mm.tobytes()


def _pair(pair: TouchPair) -> tuple[Any, ...]:
    return _hand(pair.touching), _hand(pair.host), pair.distance_palms, pair.active_fingers
