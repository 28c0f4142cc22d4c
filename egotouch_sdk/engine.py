"""The event engine: what perception found in one frame after another goes in, touch events come out. No I/O, no clock."""

from __future__ import annotations

from dataclasses import dataclass

from egotouch_sdk.capture_time import CaptureTime
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import GrammarError
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.events.order import RAW
from egotouch_sdk.filters import HostPointFilter, MedianFilter
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.gestures import GestureRecognizer, GestureStates
from egotouch_sdk.host_frame import locate
from egotouch_sdk.host_frame.exact import has_exact_landmarks, locate_exact
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import Fingertip, HostPoint
from egotouch_sdk.state import FingertipSample, PointerState, Thresholds, TouchStateMachine
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

#: Touch thresholds where neither the settings nor a model give any (a simulator's probabilities are near 0 or 1).
THRESHOLDS = Thresholds(0.6, 0.4)


@dataclass(frozen=True, slots=True)
class PointerSnapshot:
    """Where one open pointer is in the state machines.

    `touch` is hover or touch, `unseen_frames` counts the frames it was not seen (0: seen in the last one), `gestures` are the
    states of its contact. `last_event` is the last raw event (HOVER_*, DOWN, MOVE or UP): all that a newcomer needs to know.
    """

    touch: PointerState
    unseen_frames: int
    gestures: GestureStates
    last_event: TouchEvent

    @property
    def pointer_id(self) -> int:
        """The pointer's number."""
        return self.last_event.pointer_id

    @property
    def contact_id(self) -> int:
        """Number of its current or last touch, 0 before the first."""
        return self.last_event.contact_id

    @property
    def hand(self) -> Handedness:
        """The touching hand."""
        return self.last_event.hand

    @property
    def finger(self) -> Finger:
        """The finger."""
        return self.last_event.finger


class EventEngine:
    """Turns observations into events: filter, host frame, touch state, gestures.

    The same observations and settings give the same events, at any speed and on any machine. `thresholds` are a touch model's own;
    those that `config.state` sets come before them. Not safe to call from two threads at once.
    Raises `ConfigError` when the two contradict each other and, with `config.debug`, `GrammarError` for events against the grammar.
    """

    def __init__(self, config: TouchConfig | None = None, thresholds: Thresholds = THRESHOLDS) -> None:
        self.config = config or TouchConfig()
        self.thresholds = thresholds.overridden_by(self.config.state)
        self._filter = MedianFilter(self.config.state.coast_frames)
        self._points = HostPointFilter(self.config.host)
        self._machine = TouchStateMachine(self.config.state, self.thresholds)
        self._gestures = GestureRecognizer(self.config.gestures)
        self._last_events: dict[int, TouchEvent] = {}
        self._verifier = (
            GrammarVerifier(self.config.state.max_speed_mm_s, self.config.state.jump_slack_mm) if self.config.debug else None
        )
        self._time = CaptureTime(self.config.state.stall_ms)

    def process(self, observation: FrameObservation) -> FrameResult:
        """Take one frame's observation; call it for every frame, also when nothing was seen.

        Raises `FrameError` when its time is not after that of the frame before; nothing changes then.
        """
        if not self._time.advance(observation.timestamp_ns):
            self._forget()
        filtered = self._filter.apply(observation.estimates)
        points = tuple(self._locate(observation, tip) for tip in observation.fingertips)
        size_px = observation.width_px, observation.height_px
        samples = [
            FingertipSample.join(size_px, tip, estimate, point)
            for tip, estimate, point in zip(observation.fingertips, filtered, points, strict=True)
            if point is not None
        ]
        events = self._recognize(self._machine.step(samples, observation.timestamp_ns))
        return FrameResult(observation, filtered, points, events)

    def finish(self, timestamp_ns: int, reason: CancelReason = CancelReason.SOURCE_ENDED) -> tuple[TouchEvent, ...]:
        """Cancel what is still touching, let every pointer leave and forget the past; afterwards another source may follow.

        `timestamp_ns` is the capture time to stamp the events with; they are never stamped before the last frame.
        """
        events = self._recognize(self._machine.finish(timestamp_ns, reason))
        self._forget()
        self._time.reset()
        return events

    @property
    def pointers(self) -> tuple[PointerSnapshot, ...]:
        """Every open pointer after the last frame, for a debug view or for a client that joins late."""
        return tuple(
            PointerSnapshot(touch, unseen, self._gestures.states(number), self._last_events[number])
            for number, (touch, unseen) in self._machine.pointers.items()
        )

    def _locate(self, observation: FrameObservation, tip: Fingertip) -> HostPoint | None:
        pair = next(pair for pair in observation.gate.pairs if pair.touching.hand_id == tip.hand_id)
        host, mirrored = self.config.host, self.config.hands.mirrored
        if has_exact_landmarks(pair):
            return locate_exact(pair, tip.finger, host, mirrored=mirrored)
        point = locate(pair, tip.finger, host, mirrored=mirrored)
        return point and self._points.apply(tip.hand_id, tip.finger, point, observation.timestamp_ns)

    def _recognize(self, raw: tuple[TouchEvent, ...]) -> tuple[TouchEvent, ...]:
        events = self._gestures.feed(raw)
        for event in events:
            if event.type is EventType.HOVER_EXIT:
                self._last_events.pop(event.pointer_id, None)
            elif event.type in RAW:
                self._last_events[event.pointer_id] = event
        if self._verifier and (violations := self._verifier.feed(events)):
            raise GrammarError("; ".join(violation.rule for violation in violations))
        return events

    def _forget(self) -> None:
        self._filter.reset()
        self._points.reset()
        self._gestures.forget_clicks()
