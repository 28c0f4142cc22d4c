"""Left or right over time: evidence per hand, one left and one right per wearer."""

from __future__ import annotations

import math
from collections.abc import Sequence

from egotouch_sdk.joints import Handedness

#: Evidence kept from frame to frame, share of the new frame's, and its limit (our measurement on composed overlaps).
_KEEP, _GAIN, _LIMIT = 0.9, 0.3, 8.0
#: One frame's probability is taken no nearer to 0 or 1 than this.
_MIN_PROBABILITY = 0.01


def log_odds(right_probability: float) -> float:
    """Evidence of one frame that a hand is the right one: ln(p / (1 - p)), within about +-4.6."""
    p = min(max(right_probability, _MIN_PROBABILITY), 1 - _MIN_PROBABILITY)
    return math.log(p / (1 - p))


def updated(evidence: float, frame_log_odds: float) -> float:
    """Leaky sum of a hand's evidence; a covered hand whose look flips for a few frames keeps its side."""
    return min(max(_KEEP * evidence + _GAIN * frame_log_odds, -_LIMIT), _LIMIT)


def assign_sides(evidence: Sequence[float]) -> tuple[Handedness, ...]:
    """Side of each hand: with two, the one with more evidence for right is the right hand, whatever the signs.

    Raises `ValueError` for more than two: one wearer has two hands.
    """
    if len(evidence) > 2:
        raise ValueError(f"one wearer has at most two hands, got {len(evidence)}")
    if len(evidence) == 2:
        first_is_right = evidence[0] > evidence[1] or (evidence[0] == evidence[1] and evidence[0] > 0)
        return (Handedness.RIGHT, Handedness.LEFT) if first_is_right else (Handedness.LEFT, Handedness.RIGHT)
    return tuple(Handedness.RIGHT if value > 0 else Handedness.LEFT for value in evidence)


class HandIds:
    """Two lasting numbers, one per side of the wearer.

    A hand that comes back gets the number of its side again. A hand whose side was mistaken at first keeps its number, and the
    numbers of the two sides change places.
    """

    def __init__(self) -> None:
        self._of_side = {Handedness.LEFT: 0, Handedness.RIGHT: 1}

    def new(self, side: Handedness, taken: Sequence[int]) -> int:
        """Number for a hand that was just found; `taken` are those of the hands in view."""
        wanted = self._of_side[side]
        return wanted if wanted not in taken else 1 - wanted

    def confirm(self, hand_id: int, side: Handedness) -> None:
        """Record that this hand is now taken for this side."""
        self._of_side = {side: hand_id, side.other: 1 - hand_id}
