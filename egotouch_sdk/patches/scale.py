"""How many image pixels one millimetre of skin is, at one fingertip."""

from __future__ import annotations

from math import dist

from egotouch_sdk import hand_geometry
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import HandObservation

#: Length DIP to TIP landmark in millimetres (thumb: IP to TIP): on the generic WebXR hand (MIT), with the tip landmark where
#: MediaPipe puts it on renders of that hand (our measurement). The four fingers agree within 5 % with the distal phalanges of
#: 66 adults (Buryanov and Kotiuk, Int. J. Morphol. 28(3), 2010: 15.8, 17.4, 17.3, 16.0 mm).
DIP_TO_TIP_MM = {Finger.THUMB: 18.0, Finger.INDEX: 16.0, Finger.MIDDLE: 17.6, Finger.RING: 16.7, Finger.PINKY: 15.3}
#: The fingertip's own scale may differ from the whole hand's by this factor: a finger 5 cm nearer than the palm at 45 cm. More is
#: landmark noise: on 14 rendered frames the palm was right within 6 %, while DIP to TIP was up to 23 % short on fingers that dip
#: towards the skin, since MediaPipe's z makes up for too little of the foreshortening (our measurement).
MAX_SCALE_RATIO = 1.12


def tip_px_per_mm(hand: HandObservation, finger: Finger) -> float:
    """Image scale at a fingertip in pixels per millimetre, positive.

    The DIP-TIP distance in pixels, corrected for foreshortening by the landmarks' z, over the finger's usual length, kept
    within 0.89 .. 1.12 of the whole hand's scale.
    """
    own = dist(hand.landmarks_px[finger.tip].tolist(), hand.landmarks_px[finger.dip].tolist()) / DIP_TO_TIP_MM[finger]
    whole = hand_geometry.px_per_mm(hand)
    return min(max(own, whole / MAX_SCALE_RATIO), whole * MAX_SCALE_RATIO)
