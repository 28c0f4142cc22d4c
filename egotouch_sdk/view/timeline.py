"""The last seconds of every fingertip, gathered from frame results. No drawing, no clock."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from enum import StrEnum

from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import Fingertip, FingertipPatch, TouchEstimate
from egotouch_sdk.touch_event import EventType, TouchEvent

#: A fingertip as people name it: whose hand, which finger.
Tip = tuple[Handedness, Finger]

#: Event lines that are kept for the ticker.
TICKER_LINES = 15


class TipState(StrEnum):
    """What a fingertip does as far as events have told."""

    AWAY = "away"
    HOVER = "hover"
    DOWN = "down"


STATE_AFTER: dict[EventType, TipState] = {
    EventType.HOVER_ENTER: TipState.HOVER,
    EventType.HOVER_MOVE: TipState.HOVER,
    EventType.HOVER_EXIT: TipState.AWAY,
    EventType.DOWN: TipState.DOWN,
    EventType.MOVE: TipState.DOWN,
    EventType.UP: TipState.HOVER,
    EventType.CANCEL: TipState.HOVER,
}

@dataclass(frozen=True, slots=True)
class Sample:
    """One fingertip in one frame."""

    timestamp_ns: int
    touch_probability: float
    force_n: float
    state: TipState


@dataclass(slots=True)
class Track:
    """One fingertip over the last seconds, with its newest patch."""

    samples: deque[Sample] = field(default_factory=deque)
    patch: FingertipPatch | None = None
    state: TipState = TipState.AWAY


class Timeline:
    """Keeps `window_s` seconds of samples per fingertip, and the newest events."""

    def __init__(self, window_s: float = 4.0) -> None:
        self.window_ns = round(window_s * 1e9)
        self.tracks: dict[Tip, Track] = {}
        self.ticker: deque[TouchEvent] = deque(maxlen=TICKER_LINES)
        self.true_forces: deque[tuple[int, float]] = deque()
        self.touches = 0
        self.now_ns = 0

    def add(self, result: FrameResult, true_force_n: float | None = None) -> None:
        """Take in one frame's patches, estimates and events, and the true force where it is known."""
        self.now_ns = result.timestamp_ns
        if true_force_n is not None:
            self.true_forces.append((self.now_ns, true_force_n))
        for event in result.events:
            track = self._track((event.hand, event.finger))
            track.state = STATE_AFTER.get(event.type, track.state)
            self.touches += event.type is EventType.DOWN
            if event.type.is_edge:
                self.ticker.append(event)
        estimates = {(estimate.hand_id, estimate.finger): estimate for estimate in result.filtered}
        for tip in result.fingertips:
            self._add_sample(tip, estimates.get((tip.hand_id, tip.finger)))
        self._forget()

    def newest(self, limit: int) -> list[tuple[Tip, Track]]:
        """The fingertips seen last, touching ones first."""

        def rank(item: tuple[Tip, Track]) -> tuple[bool, int]:
            return item[1].state is TipState.DOWN, item[1].samples[-1].timestamp_ns

        return sorted(self.tracks.items(), key=rank, reverse=True)[:limit]

    def _track(self, tip: Tip) -> Track:
        return self.tracks.setdefault(tip, Track())

    def _add_sample(self, tip: Fingertip, estimate: TouchEstimate | None) -> None:
        track = self._track((tip.handedness, tip.finger))
        track.patch = tip if isinstance(tip, FingertipPatch) else None
        probability, force_n = (estimate.touch_probability, estimate.force_n) if estimate else (0.0, 0.0)
        track.samples.append(Sample(self.now_ns, probability, force_n, track.state))

    def _forget(self) -> None:
        start_ns = self.now_ns - self.window_ns
        while self.true_forces and self.true_forces[0][0] < start_ns:
            self.true_forces.popleft()
        for track in self.tracks.values():
            while track.samples and track.samples[0].timestamp_ns < start_ns:
                track.samples.popleft()
        self.tracks = {tip: track for tip, track in self.tracks.items() if track.samples}
