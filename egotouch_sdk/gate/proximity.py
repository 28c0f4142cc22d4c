"""Which hand touches which, and with which fingers: the cheap test before any patch is cut."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations

from egotouch_sdk.config import GateConfig
from egotouch_sdk.gate.fingers import active_fingers
from egotouch_sdk.gate.limb import Limb
from egotouch_sdk.joints import FINGERS, Finger
from egotouch_sdk.observation import GateReason, GateResult, HandObservation, TouchPair

#: A fingertip deeper inside the host's outline than this says no more about who touches whom (our choice, in palms).
DEEP_PALMS = 0.3
#: Each further stretched finger makes a hand less likely to be the touching one: the touched hand is usually flat (our choice, in palms).
OPENNESS_PALMS = 0.1

_TIPS = [finger.tip for finger in FINGERS]
_CLOSED = GateResult(GateReason.NO_HANDS)


@dataclass(frozen=True, slots=True)
class _Candidate:
    """One assignment of the two roles; the lower `cost_palms`, the better it fits."""

    touching: HandObservation
    host: HandObservation
    distance_palms: float
    is_near: bool
    active: tuple[Finger, ...]
    over: tuple[Finger, ...]
    cost_palms: float

    @property
    def is_open(self) -> bool:
        return self.is_near and bool(self.over)


def find_pairs(hands: Sequence[HandObservation], config: GateConfig, previous: GateResult = _CLOSED) -> GateResult:
    """Choose the touching hand, its host and the fingers to look at.

    The gate is open when the hands are within 3 palm lengths (EgoTouch, UIST'24, section 4), and a finger that points
    away from its wrist and is not tucked in ends over the other limb, forearm included. Both assignments of the roles are
    tried; the one whose fingertip lies deeper in the other limb, and whose hand is less open, is taken. `previous` is the
    result for the frame before: every decision has a second, wider threshold for what already held there.

    Returns at most one pair; it depends on nothing but the arguments.
    """
    if not hands:
        return _CLOSED
    if len(hands) < 2:
        return GateResult(GateReason.NO_HOST)
    candidates = [_candidate(touching, host, config, previous) for touching, host in permutations(hands, 2)]
    fitting = [candidate for candidate in candidates if candidate.is_open]
    if fitting:
        best = min(fitting, key=lambda candidate: (candidate.cost_palms, candidate.touching.hand_id, candidate.host.hand_id))
        return GateResult(GateReason.OPEN, (TouchPair(best.touching, best.host, best.distance_palms, best.over),))
    near = [candidate for candidate in candidates if candidate.is_near]
    if near and not any(candidate.active for candidate in near):
        return GateResult(GateReason.NO_ACTIVE_FINGER)
    return GateResult(GateReason.TOO_FAR)


def _candidate(touching: HandObservation, host: HandObservation, config: GateConfig, previous: GateResult) -> _Candidate:
    held = next((pair for pair in previous.pairs if (pair.touching.hand_id, pair.host.hand_id) == (touching.hand_id, host.hand_id)), None)
    already = held.active_fingers if held else ()
    limb = Limb(host, config)
    distance = limb.hand_distance_palms(touching.landmarks_px[_TIPS, :2])
    is_near = touching.score >= config.min_touching_score and distance <= (config.near_exit_palms if held else config.near_enter_palms)
    active = active_fingers(touching, config, already) if is_near else ()
    gaps = {finger: limb.gap_palms(*touching.xy_px(finger.tip).tolist()) for finger in active}
    over = tuple(
        finger for finger, gap in gaps.items() if gap <= (config.over_exit_palms if finger in already else config.over_enter_palms)
    )
    cost = max(min((gaps[finger] for finger in over), default=0.0), -DEEP_PALMS) + OPENNESS_PALMS * len(active)
    return _Candidate(touching, host, distance, is_near, active, over, cost - (config.swap_margin_palms if held else 0.0))
