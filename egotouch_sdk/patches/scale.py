"""How many image pixels one millimetre of skin is, at one fingertip."""

from __future__ import annotations

import numpy as np

from egotouch_sdk import hand_geometry
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HandObservation

#: Length DIP to TIP landmark in millimetres (thumb: IP to TIP). Bone length of the distal phalanx, mean of 66 adults
#: (Buryanov and Kotiuk, "Proportions of hand segments", Int. J. Morphol. 28(3), 2010); the TIP landmark lies about where the
#: bone ends, some 4 mm short of the finger's end.
DIP_TO_TIP_MM = {Finger.THUMB: 21.7, Finger.INDEX: 15.8, Finger.MIDDLE: 17.4, Finger.RING: 17.3, Finger.PINKY: 16.0}
#: The fingertip's own scale may differ from the whole hand's by this factor (our choice: a finger 10 cm nearer than the
#: hand's centre at 45 cm looks 1.25 times as large; beyond that it is landmark noise).
MAX_SCALE_RATIO = 1.25


def tip_px_per_mm(hand: HandObservation, finger: Finger) -> float | None:
    """Image scale at a fingertip in pixels per millimetre.

    The DIP-TIP distance in pixels, corrected for foreshortening by the landmarks' z, over the finger's usual length, kept
    within 0.8 .. 1.25 of the hand's weak-perspective scale. None when neither can be measured.
    """
    segment = hand.landmarks_px[finger.tip] - hand.landmarks_px[finger.dip]
    own = float(np.sqrt((segment * segment).sum())) / DIP_TO_TIP_MM[finger]
    whole = hand_geometry.px_per_mm(hand)
    if whole is None:
        return own if own > 0.0 else None
    return min(max(own, whole / MAX_SCALE_RATIO), whole * MAX_SCALE_RATIO)
