"""Video in which nothing is touched: every DOWN is a false one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import exp, inf, lgamma, log, sqrt
from typing import TYPE_CHECKING

import numpy as np

from egotouch_sdk.capture_time import CaptureTime
from egotouch_sdk.evaluation.study_run import StillFingers
from egotouch_sdk.gate import active_fingers
from egotouch_sdk.joints import NUM_JOINTS, Handedness
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.patches import extract
from egotouch_sdk.state import Thresholds
from egotouch_sdk.touch import TouchStream
from egotouch_sdk.touch_event import CancelReason, EventType

if TYPE_CHECKING:
    from egotouch_sdk.config import TouchConfig
    from egotouch_sdk.frame import Frame
    from egotouch_sdk.hands.base import HandSource
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.touch import TouchModel


@dataclass(frozen=True, slots=True)
class FalseTouches:
    """What the pipeline made of one clip without touches. `patches` counts fingertips that the gate let through."""

    frames: int
    duration_s: float
    downs: int
    patches: int
    frames_with_hands: int
    frames_with_open_gate: int

    def __add__(self, other: FalseTouches) -> FalseTouches:
        return FalseTouches(
            self.frames + other.frames,
            self.duration_s + other.duration_s,
            self.downs + other.downs,
            self.patches + other.patches,
            self.frames_with_hands + other.frames_with_hands,
            self.frames_with_open_gate + other.frames_with_open_gate,
        )

    @property
    def downs_per_minute(self) -> float:
        """False touches per minute of video, 0 for an empty clip."""
        return self.downs / self.duration_s * 60 if self.duration_s > 0 else 0.0

    @property
    def interval_per_minute(self) -> tuple[float, float]:
        """95 % interval of the true rate, taking false touches as a Poisson process; (0, inf) for an empty clip."""
        if self.duration_s <= 0:
            return 0.0, inf
        low, high = poisson_interval(self.downs)
        return low / self.duration_s * 60, high / self.duration_s * 60

    @property
    def open_gate_s(self) -> float:
        """Time with an open gate: only then can a touch be told."""
        return self.duration_s * self.frames_with_open_gate / self.frames if self.frames else 0.0


def poisson_interval(count: int, level: float = 0.95) -> tuple[float, float]:
    """Exact (Garwood 1936) interval of a Poisson mean after `count` events, by bisection."""
    tail = (1 - level) / 2

    def at_most(events: int, mean: float) -> float:
        return sum(exp(number * log(mean) - mean - lgamma(number + 1)) for number in range(events + 1)) if mean > 0 else 1.0

    def solve(is_above: Callable[[float], bool]) -> float:
        low, high = 0.0, count + 10 * sqrt(count + 1) + 10
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (low, middle) if is_above(middle) else (middle, high)
        return (low + high) / 2

    lower = solve(lambda mean: 1 - at_most(count - 1, mean) > tail) if count else 0.0
    return lower, solve(lambda mean: at_most(count, mean) < tail)


def count_false_touches(frames: Iterable[Frame], pipeline: TouchPipeline) -> FalseTouches:
    """Run frames through the pipeline and count every DOWN; duration runs from the first frame to one frame after the last."""
    times: list[int] = []
    downs = patches = with_hands = gate_open = 0
    for frame in frames:
        result = pipeline.process(frame)
        times.append(frame.timestamp_ns)
        downs += sum(event.type is EventType.DOWN for event in result.events)
        patches += len(result.fingertips)
        with_hands += bool(result.hands)
        gate_open += result.gate.is_open
    if times:
        pipeline.finish(times[-1], CancelReason.SOURCE_ENDED)
    return FalseTouches(len(times), _duration_s(times), downs, patches, with_hands, gate_open)


def count_without_gate(frames: Iterable[Frame], hands: HandSource, model: TouchModel, config: TouchConfig) -> FalseTouches:
    """The same with no gate before the model: every finger that could touch is shown to it, host unknown, and counts as open.

    Harder than live use: a single hand in the air never gets that far there.
    """
    own = Thresholds(model.manifest.down_probability, model.manifest.up_probability).overridden_by(config.state)
    chain, stream, time = StillFingers(own, config.state), TouchStream(model, config.touch.memory_ms), CaptureTime(config.state.stall_ms)
    times: list[int] = []
    downs = patches = with_hands = shown = 0
    for frame in frames:
        if not time.advance(frame.timestamp_ns):
            stream.reset()
        seen = [hand for hand in hands.track(frame) if hand.score >= config.gate.min_touching_score]
        pairs = [TouchPair(hand, nobody(hand), 0.0, active_fingers(hand, config.gate)) for hand in seen]
        cut = [patch for pair in pairs for patch in extract(frame, pair, config.patches, mirrored=config.hands.mirrored)]
        sides = {hand.hand_id: hand.handedness for hand in seen}
        _, events = chain.step(stream.estimate(cut, frame.timestamp_ns), frame.timestamp_ns, sides)
        times.append(frame.timestamp_ns)
        downs += sum(event.type is EventType.DOWN for event in events)
        patches, with_hands, shown = patches + len(cut), with_hands + bool(seen), shown + bool(cut)
    hands.reset()
    return FalseTouches(len(times), _duration_s(times), downs, patches, with_hands, shown)


def nobody(hand: HandObservation) -> HandObservation:
    """A host without an axis for a hand that is alone: (R, theta) of its fingers stays unknown."""
    nowhere = np.zeros((NUM_JOINTS, 3), np.float32)
    side = Handedness.LEFT if hand.handedness is Handedness.RIGHT else Handedness.RIGHT
    return HandObservation(hand.hand_id + 1, side, 0.0, nowhere, nowhere)


def _duration_s(times_ns: Sequence[int]) -> float:
    span_ns = times_ns[-1] - times_ns[0] if len(times_ns) > 1 else 0
    return span_ns / 1e9 * (len(times_ns) / max(len(times_ns) - 1, 1))
