"""The only place that joins the stages: a frame goes in, touch events come out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from egotouch_sdk import clock
from egotouch_sdk.capture_time import CaptureTime
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_observation import CLOSED, FrameObservation
from egotouch_sdk.frame_result import STAGES, FrameResult
from egotouch_sdk.gate import HostMemory, find_pairs
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.hands.tracker import HandTracker
from egotouch_sdk.observation import FingertipPatch, GateResult, HandObservation
from egotouch_sdk.patches import extract
from egotouch_sdk.state import Thresholds
from egotouch_sdk.touch import TouchModel, TouchStream
from egotouch_sdk.touch_event import CancelReason, TouchEvent

__all__ = ["STAGES", "FrameResult", "TouchPipeline"]



class TouchPipeline:
    """Finds touches on bare skin in one stream of frames.

    `config` has the settings of every stage. `hands` replaces the built-in tracker, for example by a headset's own joints;
    `touch` replaces the model that `config.touch` names. `now_ns` times the stages and nothing else.
    Not safe to call from two threads at once. Raises `ModelError` when a model cannot be loaded, `ConfigError` when the
    configured thresholds contradict the model's.
    """

    def __init__(
        self,
        config: TouchConfig | None = None,
        hands: HandSource | None = None,
        touch: TouchModel | None = None,
        *,
        now_ns: Callable[[], int] = clock.now_ns,
    ) -> None:
        self.config = config = config or TouchConfig()
        self.hands: HandSource = hands or HandTracker(**config.hands.model_dump())
        self.touch = touch or TouchModel(config.touch.model_path, config.touch.threads)
        manifest = self.touch.manifest
        self.engine = EventEngine(config, Thresholds(manifest.down_probability, manifest.up_probability))
        self._stream = TouchStream(self.touch, config.touch.memory_ms)
        self._host_memory = HostMemory(round(config.gate.host_memory_ms * 1e6))
        self._time = CaptureTime(config.state.stall_ms)
        self._gate = CLOSED
        self._now_ns = now_ns

    def process(self, frame: Frame) -> FrameResult:
        """Run one frame through every stage; call it for each frame of the source, in order.

        Raises `FrameError` when the frame's time is not after that of the frame before.
        """
        if not self._time.advance(frame.timestamp_ns):
            self._forget()
        laps = _Laps(self._now_ns)
        hands = self.hands.track(frame)
        laps.end("hands")
        gate = self._find_pairs(hands, frame.timestamp_ns)
        laps.end("gate")
        patches = self._extract(frame, gate)
        laps.end("patches")
        estimates = self._stream.estimate(patches, frame.timestamp_ns)
        laps.end("touch")
        observation = FrameObservation(
            frame.index, frame.timestamp_ns, frame.width_px, frame.height_px, hands, gate, patches, estimates
        )
        result = self.engine.process(observation)
        laps.end("events")
        return replace(result, stage_ms=laps.stage_ms)

    def finish(self, timestamp_ns: int, reason: CancelReason = CancelReason.SOURCE_ENDED) -> tuple[TouchEvent, ...]:
        """Cancel what is still touching, let every pointer leave and forget the past; afterwards another source may follow.

        `timestamp_ns` is the capture time to stamp the events with; they are never stamped before the last frame.
        """
        events = self.engine.finish(timestamp_ns, reason)
        self._forget()
        self.hands.reset()
        self._time.reset()
        return events

    def _find_pairs(self, hands: tuple[HandObservation, ...], timestamp_ns: int) -> GateResult:
        complete = self._host_memory.complete(hands, timestamp_ns)
        self._gate = find_pairs(complete, self.config.gate, self._gate)
        self._host_memory.note(self._gate, timestamp_ns)
        return self._gate

    def _extract(self, frame: Frame, gate: GateResult) -> tuple[FingertipPatch, ...]:
        mirrored = self.config.hands.mirrored
        return tuple(patch for pair in gate.pairs for patch in extract(frame, pair, self.config.patches, mirrored=mirrored))

    def _forget(self) -> None:
        self._stream.reset()
        self._host_memory.reset()
        self._gate = CLOSED


class _Laps:
    """Milliseconds between one call of `end` and the next."""

    def __init__(self, now_ns: Callable[[], int]) -> None:
        self._now_ns = now_ns
        self._start_ns = now_ns()
        self.stage_ms: dict[str, float] = {}

    def end(self, stage: str) -> None:
        """Book the time since the last lap on `stage`."""
        end_ns = self._now_ns()
        self.stage_ms[stage] = (end_ns - self._start_ns) / 1e6
        self._start_ns = end_ns
