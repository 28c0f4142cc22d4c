"""The paper's three-frame median (EgoTouch, UIST'24, section 4), run causally.

The output for a frame is the median of that frame and the two before it, which is the centred median of the frame before: a
touch and a lift both show one frame late, and a single wrong frame never shows. Scores are therefore taken against the
frame's own ground truth, with that one frame of delay included.
The standard error of the force stays that of the newest frame: the errors of neighbouring frames are alike and do not average out.
Before its first frame a finger counts as not touching (probability 0, force 0), so a single frame is no touch either.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate

#: Frames in the median's window.
WINDOW = 3


@dataclass(slots=True)
class _History:
    """The last samples of one finger, and for how many frames it has been missing."""

    probabilities: deque[float] = field(default_factory=lambda: deque([0.0] * WINDOW, WINDOW))
    forces_n: deque[float] = field(default_factory=lambda: deque([0.0] * WINDOW, WINDOW))
    missing_frames: int = 0


class MedianFilter:
    """Three-frame median of probability and force, each finger of each hand for itself.

    `max_gap_frames`: a finger that is missing from more consecutive frames than this starts afresh.
    """

    def __init__(self, max_gap_frames: int = 2) -> None:
        self._max_gap_frames = max_gap_frames
        self._histories: dict[tuple[int, Finger], _History] = {}

    def apply(self, estimates: Sequence[TouchEstimate]) -> tuple[TouchEstimate, ...]:
        """Filter one frame's estimates; call it once per frame, also with none, in which case only the gaps grow."""
        for history in self._histories.values():
            history.missing_frames += 1
        filtered = tuple(self._filter(estimate) for estimate in estimates)
        self._histories = {key: history for key, history in self._histories.items() if history.missing_frames <= self._max_gap_frames}
        return filtered

    def _filter(self, estimate: TouchEstimate) -> TouchEstimate:
        key = estimate.hand_id, estimate.finger
        history = self._histories.get(key)
        if history is None:
            history = self._histories[key] = _History()
        history.probabilities.append(estimate.touch_probability)
        history.forces_n.append(estimate.force_n)
        history.missing_frames = 0
        middle = WINDOW // 2
        return TouchEstimate(*key, sorted(history.probabilities)[middle], sorted(history.forces_n)[middle], estimate.force_sigma_n)

    def reset(self) -> None:
        """Forget every finger; afterwards the filter behaves like a new one."""
        self._histories.clear()
