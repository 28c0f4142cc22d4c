"""A scripted fingertip: the verbs of a finger in, events out."""

from __future__ import annotations

from collections import deque

from egotouch_sdk.config import GestureConfig, StateConfig
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.gestures import GestureRecognizer
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.state import FingertipSample, Thresholds, TouchStateMachine
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

FRAME_NS = 33_333_333
DOWN, UP = 0.6, 0.4


class ScriptedFinger:
    """One right index finger over a still host, driven frame by frame through the state machine and, if asked for, the gestures."""

    def __init__(self, config: StateConfig | None = None, gestures: GestureConfig | None = None, fps: float = 30.0) -> None:
        self.frame_ns = int(1e9 / fps)
        self.gestures = GestureRecognizer(gestures) if gestures else None
        self.machine = TouchStateMachine(config or StateConfig(), Thresholds(DOWN, UP))
        self.verifier = GrammarVerifier()
        self.time_ns = 0
        self.x_mm, self.y_mm = 0.0, 0.0
        self.hand_id, self.handedness = 1, Handedness.RIGHT
        self.events: deque[TouchEvent] = deque()

    def hover(self, frames: int = 1) -> None:
        """Be seen above the skin."""
        self._frames(frames, self.sample(0.1))

    def touch_down(self, force_n: float = 1.0) -> None:
        """Be seen touching for one frame."""
        self._frames(1, self.sample(0.9, force_n))

    def waver(self, frames: int = 1) -> None:
        """Be seen with a probability between the two thresholds."""
        self._frames(frames, self.sample((DOWN + UP) / 2, 0.5))

    def move(self, dx_mm: float = 0.0, dy_mm: float = 0.0, force_n: float = 1.0) -> None:
        """Be seen touching somewhere else one frame later."""
        self.x_mm, self.y_mm = self.x_mm + dx_mm, self.y_mm + dy_mm
        self._frames(1, self.sample(0.9, force_n))

    def hold(self, duration_ms: float, force_n: float = 1.0) -> None:
        """Be seen touching in the same place in every frame of this duration."""
        self._frames(round(duration_ms * 1e6 / self.frame_ns), self.sample(0.9, force_n))

    def tap(self) -> None:
        """Touch for three frames and be seen lifted in the next."""
        self.touch_down()
        self._frames(2, self.sample(0.9, 1.0))
        self.lift()

    def lift(self) -> None:
        """Be seen above the skin again for one frame."""
        self.hover()

    def vanish(self, frames: int = 1) -> None:
        """Not be seen while the camera goes on."""
        self._frames(frames, None)

    def stall(self, gap_ns: int) -> None:
        """Let the camera deliver nothing for longer than one frame: the next frame comes `gap_ns` after the last."""
        self.time_ns += gap_ns - self.frame_ns

    def end(self, reason: CancelReason = CancelReason.SOURCE_ENDED) -> None:
        """End the source."""
        self._note(self.machine.finish(self.time_ns, reason))

    def sample(self, probability: float, force_n: float = 0.0) -> FingertipSample:
        """What this finger looks like now, at 2 px per mm in a 1000 x 1000 px image."""
        x_px, y_px = 500.0 + 2 * self.x_mm, 500.0 + 2 * self.y_mm
        return FingertipSample(
            self.hand_id,
            self.handedness,
            Finger.INDEX,
            probability,
            force_n,
            (x_px, y_px),
            2.0,
            (x_px / 1000, y_px / 1000),
            HostPoint(Surface.PALM, self.x_mm, self.y_mm, 0.7, 0.0),
        )

    def expect(self, *types: EventType) -> TouchEvent:
        """The next events have these types; gives the last of them."""
        for event_type in types:
            assert self.events, f"expected {event_type}, but nothing happened"
            event = self.events.popleft()
            assert event.type is event_type, f"expected {event_type}, got {event}"
        return event

    def skip(self, *types: EventType) -> None:
        """Leave out the next events as long as they have one of these types."""
        while self.events and self.events[0].type in types:
            self.events.popleft()

    def expect_nothing_else(self) -> None:
        """No event is left, and the grammar was kept so far."""
        assert not self.events, f"unexpected {list(self.events)}"
        assert self.verifier.violations == []

    def _frames(self, count: int, sample: FingertipSample | None) -> None:
        for _ in range(count):
            self.time_ns += self.frame_ns
            self._note(self.machine.step([] if sample is None else [sample], self.time_ns))

    def _note(self, events: tuple[TouchEvent, ...]) -> None:
        if self.gestures:
            events = self.gestures.feed(events)
        self.verifier.feed(events)
        self.events += events
