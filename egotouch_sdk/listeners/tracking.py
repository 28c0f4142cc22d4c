"""What the camera sees of the wearer's hands, for `onTrackingChanged`."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import Handedness
from egotouch_sdk.observation import GateReason


@dataclass(frozen=True, slots=True)
class TrackingState:
    """Which hands are seen and whether they could touch, as of the capture time `timestamp_ns`.

    `hands` are the wearer's hands in view, left before right. `gate` says why no touch is possible, or `GateReason.OPEN`.
    """

    timestamp_ns: int
    hands: tuple[Handedness, ...]
    gate: GateReason

    @classmethod
    def of(cls, observation: FrameObservation) -> TrackingState:
        """The state that one frame shows."""
        seen = {hand.handedness for hand in observation.hands}
        return cls(observation.timestamp_ns, tuple(hand for hand in Handedness if hand in seen), observation.gate.reason)

    def differs_from(self, other: TrackingState | None) -> bool:
        """True when hands or gate have changed, whatever the time."""
        return other is None or (self.hands, self.gate) != (other.hands, other.gate)
