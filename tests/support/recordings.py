"""Recordings of a scripted finger, made on the spot."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from pathlib import Path

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.recording import Header, RecordedEngine, Recorder
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, observe
from egotouch_sdk.surface import Surface

FPS = 30
FRAME_NS = 1_000_000_000 // FPS


def taps(frames: int) -> Iterator[FrameObservation]:
    """An index finger that touches the palm for three frames out of ten."""
    for index in range(frames):
        pressing = index % 10 in (4, 5, 6)
        finger = SimulatedFinger(Surface.PALM, 0.0, 50.0, hover_mm=0.0 if pressing else 15.0, force_n=1.0 if pressing else 0.0)
        yield observe(SimulatedScene((finger,)), index, index * FRAME_NS)


def record_taps(path: Path, frames: int = 60, *, config: TouchConfig | None = None, finished: bool = True) -> Recorder:
    """A recording of `taps`, flushed twice a second of its own time; without its end unless `finished`."""
    engine = EventEngine(config)
    still = count()
    header = Header(engine.config, engine.thresholds, {"touch.onnx": "0" * 64}, source="taps", fps=FPS, created_unix_ms=1)
    recorder = Recorder(path, header, now_ns=lambda: next(still))
    recorded = RecordedEngine(engine, recorder)
    for observation in taps(frames):
        recorded.process(observation)
    if finished:
        recorded.finish(frames * FRAME_NS)
    return recorder
