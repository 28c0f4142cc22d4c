"""Fingers that are played live, by any number of pages at once, as one imaginary scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.joints import Handedness
from egotouch_sdk.simulator.observe import observe
from egotouch_sdk.simulator.scene import SimulatedFinger, SimulatedScene, SimulatedView

#: Fingers that are not played again within this time vanish, so that a page that hangs leaves no touch behind (our choice: pages
#: play at least ten times a second).
STALE_NS: Final = 500_000_000


@dataclass(slots=True)
class _Player:
    fingers: tuple[SimulatedFinger, ...]
    #: Time of the first observation after the fingers were played; None before it.
    seen_ns: int | None = None


class LiveSimulation:
    """What everybody plays now, and the observations that a camera would give of it. No clock, no threads.

    Where two players are at odds the one who began first counts: a finger of a hand is there once, and a limb shows one side. Fingers that
    vanish are a hand that tracking has lost: a touch of theirs is cancelled.
    """

    def __init__(self, view: SimulatedView | None = None) -> None:
        self._view = view or SimulatedView()
        self._players: dict[object, _Player] = {}
        self._hosts: tuple[Handedness, ...] = (Handedness.LEFT,)
        self._palm_side = True
        self._index = 0

    def play(self, player: object, fingers: tuple[SimulatedFinger, ...]) -> None:
        """All fingers that `player` plays from now on, in place of those before."""
        if not fingers:
            self.leave(player)
            return
        known = self._players.setdefault(player, _Player(fingers))
        known.fingers, known.seen_ns = fingers, None

    def leave(self, player: object) -> None:
        """`player` is gone, and its fingers with it; unknown ones may leave too."""
        self._players.pop(player, None)

    def observe(self, timestamp_ns: int) -> FrameObservation:
        """The next observation; times must rise."""
        for name, player in tuple(self._players.items()):
            player.seen_ns = timestamp_ns if player.seen_ns is None else player.seen_ns
            if timestamp_ns - player.seen_ns > STALE_NS:
                self.leave(name)
        fingers = self._fingers()
        if fingers:
            self._hosts = tuple(dict.fromkeys(finger.hand.other for finger in fingers))
            self._palm_side = fingers[0].on_palm_side
        scene = SimulatedScene(fingers, self._view, self._hosts, self._palm_side)
        observation = observe(scene, self._index, timestamp_ns)
        self._index += 1
        return observation

    def _fingers(self) -> tuple[SimulatedFinger, ...]:
        """Everybody's fingers, without those that cannot be in one scene with earlier ones."""
        chosen: list[SimulatedFinger] = []
        for finger in (finger for player in self._players.values() for finger in player.fingers):
            same_hand = [other for other in chosen if other.hand is finger.hand]
            if all(other.finger is not finger.finger and other.on_palm_side is finger.on_palm_side for other in same_hand):
                chosen.append(finger)
        return tuple(chosen)
