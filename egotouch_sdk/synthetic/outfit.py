"""What a participant wears in one round: their jewellery, and a sleeve in some rounds, never over the contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from egotouch_sdk.joints import Handedness
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Array
from egotouch_sdk.synthetic.participants import FIRST_SEED, PARTICIPANTS
from egotouch_sdk.synthetic.skin import SkinIdentity
from egotouch_sdk.synthetic.wearables import Item, Sleeve, Srgb, covers, dress

#: Share of rounds with sleeves, indoors and outdoors, and how far from the contact anything worn stays: a drag goes 10 mm, a fingertip
#: covers 6 (all our choice).
SLEEVE_ODDS = {False: 0.45, True: 0.65}
MARGIN_M = 0.018
#: A sleeve that would be in the way is pushed up at most this much farther than the margin.
_SPARE_M = 0.04
#: Where sleeves end: pushed up or down, from the wrist joint towards the elbow.
_SLEEVE_END_M, _STRIPED = (0.0, 0.24), 0.3


def draw_outfit(rng: np.random.Generator, number: int, outdoors: bool, on_arm_m: Array) -> tuple[tuple[Item, ...], tuple[Item, ...]]:
    """What participant `number` wears on the receiving and on the touching arm in a round.

    `on_arm_m` (3,) is the contact in the receiving hand's wrist frame. A watch that would be touched is taken off, a sleeve that would
    be is pushed up.
    """
    stated = PARTICIPANTS[number]
    left: list[Item] = [ring for ring in stated.rings if ring.hand is Handedness.LEFT]
    right: list[Item] = [ring for ring in stated.rings if ring.hand is Handedness.RIGHT]
    if stated.watch is not None and not covers((stated.watch,), on_arm_m, MARGIN_M):
        left.append(stated.watch)
    sleeved = rng.random() < SLEEVE_ODDS[outdoors]
    ends = rng.uniform(*_SLEEVE_END_M, 2)
    if sleeved:
        both = _sleeves(rng, ends, _garment(np.random.default_rng([FIRST_SEED + number, 5, int(outdoors)])), on_arm_m)
        left.append(both[0])
        right.append(both[1])
    return tuple(left), tuple(right)


def draw_sleeves(rng: np.random.Generator, on_arm_m: Array) -> tuple[tuple[Item, ...], tuple[Item, ...]]:
    """Sleeves of any colour on the receiving and on the touching arm; `on_arm_m` (3,) as in `draw_outfit`."""
    left, right = _sleeves(rng, rng.uniform(*_SLEEVE_END_M, 2), _garment(rng), on_arm_m)
    return (left,), (right,)


def _sleeves(rng: np.random.Generator, ends_m: Array, garment: tuple[Srgb, Srgb, float], on_arm_m: Array) -> tuple[Sleeve, Sleeve]:
    """The receiving arm's, pushed up beyond the contact, and the touching arm's."""
    free_m = float(on_arm_m[2]) + MARGIN_M + float(rng.uniform(0.002, _SPARE_M))
    return Sleeve(max(float(ends_m[0]), free_m), *garment), Sleeve(float(ends_m[1]), *garment)


def dress_both(skin: SkinIdentity, outfit: tuple[tuple[Item, ...], tuple[Item, ...]]) -> SkinIdentity:
    """The participant's skin with what is worn on the receiving (left) and touching (right) arm."""
    sides = {
        side: dress(HandRig(side, skin.level), skin.sides[side], items, skin.seed) if items else skin.sides[side]
        for side, items in zip(("left", "right"), outfit, strict=True)
    }
    return replace(skin, sides=sides)


def _garment(rng: np.random.Generator) -> tuple[Srgb, Srgb, float]:
    """Colours of a shirt or jacket and the width of its stripes in millimetres."""
    base, second = (rng.uniform(20, 235) + rng.normal(0, 25, 3) for _ in range(2))
    stripe_mm = float(rng.uniform(3, 14)) if rng.random() < _STRIPED else 0.0
    return _srgb(base), _srgb(second), stripe_mm


def _srgb(values: Array) -> Srgb:
    r, g, b = (int(v) for v in np.clip(values, 8, 245))
    return r, g, b
