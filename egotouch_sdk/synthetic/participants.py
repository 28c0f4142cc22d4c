"""The study's fifteen simulated participants: skin type, hair, hands, nails and what they wear, as data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.study_data import Hair
from egotouch_sdk.synthetic.skin import SkinIdentity, bake_person
from egotouch_sdk.synthetic.skin_traits import SkinTraits, draw_traits
from egotouch_sdk.synthetic.srgb import srgb_to_linear
from egotouch_sdk.synthetic.wearables import Ring, Watch

#: Seeds of study participants start here: training's skins are 0, 1, ..., so nobody is in both.
FIRST_SEED = 1000
#: `SkinTraits.hair` of the paper's four steps (hairs per area in units of 0.03 / mm^2; looked at in renders, our choice).
HAIR_DENSITY: dict[Hair, tuple[float, float]] = {
    Hair.NIL: (0.0, 0.05),
    Hair.SPARSE: (0.3, 0.7),
    Hair.MODERATE: (1.1, 1.6),
    Hair.DENSE: (2.4, 3.0),
}


class HandSize(StrEnum):
    """Size of a participant's hands."""

    SMALL = "small"
    LARGE = "large"


#: Scale of the whole hand relative to the asset, whose hand is 19 cm long.
HAND_SCALE: dict[HandSize, tuple[float, float]] = {HandSize.SMALL: (0.88, 0.97), HandSize.LARGE: (0.99, 1.1)}


@dataclass(frozen=True, slots=True)
class Participant:
    """One participant: skin type 1..6, hair on the arms, hand size, the hand that touches, sRGB nail polish or None, and jewellery."""

    fitzpatrick: int
    hair: Hair
    size: HandSize
    touching_hand: Handedness = Handedness.RIGHT
    polish_srgb: tuple[int, int, int] | None = None
    rings: tuple[Ring, ...] = ()
    watch: Watch | None = None


_L, _S = HandSize.LARGE, HandSize.SMALL
_GOLD, _SILVER, _BLACK, _LEATHER = (196, 158, 88), (186, 186, 184), (28, 28, 30), (96, 62, 40)
_WEDDING = Ring(Handedness.LEFT, Finger.RING, 3.0, _GOLD)

#: The paper's mix: skin 3 x II, 8 x III, 1 x IV, 2 x V, 1 x VI; hair 4 nil, 6 sparse, 2 moderate, 3 dense (EgoTouch, UIST'24).
#: Which goes with which, hand sizes, polish (2 of 15) and jewellery (rings on 5, watch or band on 5) are our choice.
PARTICIPANTS: tuple[Participant, ...] = (
    Participant(3, Hair.SPARSE, _L, rings=(_WEDDING,)),
    Participant(2, Hair.DENSE, _L, watch=Watch(_BLACK, (20, 20, 22), 38)),
    Participant(3, Hair.NIL, _S, polish_srgb=(150, 24, 44)),
    Participant(5, Hair.SPARSE, _L),
    Participant(3, Hair.MODERATE, _L, watch=Watch(_LEATHER, (205, 200, 190), 36)),
    Participant(
        2, Hair.SPARSE, _S, rings=(Ring(Handedness.RIGHT, Finger.RING, 2.2, _SILVER), Ring(Handedness.LEFT, Finger.MIDDLE, 3.5, _SILVER))
    ),
    Participant(3, Hair.DENSE, _L, touching_hand=Handedness.LEFT),
    Participant(6, Hair.NIL, _L, watch=Watch((60, 66, 74), (18, 20, 26), 40)),
    Participant(3, Hair.SPARSE, _S, rings=(Ring(Handedness.LEFT, Finger.INDEX, 2.6, _GOLD),)),
    Participant(3, Hair.NIL, _S),
    Participant(4, Hair.SPARSE, _L, rings=(_WEDDING,), watch=Watch(_SILVER, (230, 230, 226), 40)),
    Participant(2, Hair.NIL, _S, touching_hand=Handedness.LEFT, polish_srgb=(226, 170, 178)),
    Participant(3, Hair.MODERATE, _L),
    Participant(5, Hair.DENSE, _L, watch=Watch((40, 92, 120), None, 0)),
    Participant(3, Hair.SPARSE, _S, rings=(Ring(Handedness.RIGHT, Finger.THUMB, 4.0, _SILVER), _WEDDING)),
)


def traits_of(number: int) -> SkinTraits:
    """Skin of participant `number` (0..14): what the table states, the rest drawn from its seed."""
    stated = PARTICIPANTS[number]
    seed = FIRST_SEED + number
    rng = np.random.default_rng([seed, 4])
    return replace(
        draw_traits(seed, float(stated.fitzpatrick)),
        hair=float(rng.uniform(*HAIR_DENSITY[stated.hair])),
        scale=float(rng.uniform(*HAND_SCALE[stated.size])),
        polish=_linear(stated.polish_srgb),
    )


def study_skin(number: int, level: int = 4) -> SkinIdentity:
    """Bare skin of participant `number` (0..14), baked once (about 10 s), then read from the cache."""
    return bake_person(FIRST_SEED + number, traits_of(number), level)


def _linear(srgb: tuple[int, int, int] | None) -> tuple[float, float, float] | None:
    if srgb is None:
        return None
    r, g, b = srgb_to_linear(srgb).tolist()
    return r, g, b
