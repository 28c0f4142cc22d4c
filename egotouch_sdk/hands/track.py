"""One hand followed from frame to frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from egotouch_sdk.hands.association import hand_baseline_px
from egotouch_sdk.hands.boxes import bounding_box, overlaps
from egotouch_sdk.hands.identity import log_odds, updated
from egotouch_sdk.hands.landmarker import LocatedHand
from egotouch_sdk.hands.roi import Roi, roi_from_landmarks
from egotouch_sdk.joints import HandJoint as J

FloatArray = npt.NDArray[np.floating]

#: A hand is carried through a gap only after this many frames in sequence (our choice: a one-frame mistake must not live on).
_MIN_AGE_TO_COAST = 3
#: Weight of disagreeing handedness beside a jump in palm lengths when two tracks claim one hand (our measurement on composed overlaps).
_SIDE_WEIGHT = 0.25
#: Distrust of a hand that was not known before this frame, in the same unit.
NEW_HAND_DISTRUST = 1.0
#: Share of the newest step in the running velocity (our choice).
_VELOCITY_GAIN = 0.5
#: Score of a carried hand, before it fades with time; below the presence threshold so that it cannot pass for a seen one.
_COAST_SCORE = 0.49


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """A hand as last seen, and where to look for it next.

    `evidence` is the log-odds that it is the right hand; `age` counts frames seen in sequence. A `coasting` track was not seen
    since `seen_ns` and is carried along by `shift_px`, from the palm's `velocity_px_per_s` (x, y).
    """

    hand_id: int
    seen: LocatedHand
    evidence: float
    seen_ns: int
    age: int = 1
    coasting: bool = False
    shift_px: tuple[float, float] = (0.0, 0.0)
    velocity_px_per_s: tuple[float, float] = (0.0, 0.0)

    @property
    def landmarks_px(self) -> npt.NDArray[np.float32]:
        """(21, 3) in pixels; a carried hand's are moved along."""
        return np.asarray(self.seen.landmarks_px + np.array([*self.shift_px, 0.0], np.float32), np.float32)

    @property
    def roi(self) -> Roi:
        """Where the landmark network should look next."""
        return roi_from_landmarks(self.landmarks_px)

    def score(self, now_ns: int, coast_ns: int) -> float:
        """Presence 0..1; a carried hand's starts below 0.5 and fades to 0 at the end of its time."""
        if not self.coasting:
            return min(max(self.seen.presence, 0.0), 1.0)
        return _COAST_SCORE * max(0.0, 1 - (now_ns - self.seen_ns) / max(coast_ns, 1))

    def distrust(self, found: LocatedHand, right_log_odds: float) -> float:
        """How unlikely it is that `found` is still this hand: its jump in palm lengths plus disagreement about the side."""
        jump = float(np.linalg.norm((found.landmarks_px - self.landmarks_px)[:, :2], axis=1).mean())
        return jump / max(hand_baseline_px(self.landmarks_px), 1e-6) + max(0.0, -right_log_odds * self.evidence) * _SIDE_WEIGHT

    def followed(self, found: LocatedHand, right_log_odds: float, now_ns: int) -> Track:
        """The track after it was seen again."""
        step = (found.landmarks_px - self.seen.landmarks_px)[J.MIDDLE_FINGER_MCP, :2] / max((now_ns - self.seen_ns) * 1e-9, 1e-6)
        old = np.asarray(self.velocity_px_per_s)
        velocity = step if self.age == 1 else old + _VELOCITY_GAIN * (step - old)
        return Track(
            self.hand_id,
            found,
            updated(self.evidence, right_log_odds),
            now_ns,
            self.age + 1,
            velocity_px_per_s=(float(velocity[0]), float(velocity[1])),
        )

    def coasted(self, now_ns: int, coast_ns: int, covering: Sequence[FloatArray]) -> Track | None:
        """The track carried along at constant velocity under one of the `covering` hands (each (21, 3) in pixels).

        None when its time is up, when it is too young, or when no other hand is over it: a hand that nothing covers has left.
        """
        gap_ns = now_ns - self.seen_ns
        if gap_ns > coast_ns or self.age < _MIN_AGE_TO_COAST:
            return None
        vx, vy = self.velocity_px_per_s
        moved = replace(self, coasting=True, shift_px=(vx * gap_ns * 1e-9, vy * gap_ns * 1e-9))
        box = bounding_box(moved.landmarks_px)
        return moved if any(overlaps(box, bounding_box(other)[None])[0] > 0 for other in covering) else None


def frame_evidence(found: LocatedHand, mirrored: bool) -> float:
    """Log-odds of one frame that the wearer's right hand was seen; a mirrored image shows it as a left one."""
    value = log_odds(found.right_probability)
    return -value if mirrored else value
