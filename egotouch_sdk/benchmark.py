"""How fast the whole pipeline runs on this machine, stage by stage, and how much of it the networks take."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import fmean, median
from threading import Lock
from typing import Any

import cv2
import numpy as np

from egotouch_sdk.clock import now_ns
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.frame import Frame
from egotouch_sdk.inference import create_session
from egotouch_sdk.pipeline import STAGES, TouchPipeline
from egotouch_sdk.touch.model import SHIPPED_MODEL

#: The size at which frame rates are compared (1280x720).
BENCH_WIDTH_PX = 1280
BENCH_HEIGHT_PX = 720


@dataclass(frozen=True, slots=True)
class BenchReport:
    """Times are means per frame unless they say otherwise.

    `fps` is frames per second of the whole pipeline, decoding left out; `outside_networks` the share of the pipeline's time
    that no network call covers; `two_hands_share` the share of frames in which both hands were found.
    """

    frames: int
    width_px: int
    height_px: int
    fps: float
    frame_ms_mean: float
    frame_ms_median: float
    frame_ms_p95: float
    stage_ms: dict[str, float]
    networks_ms: float
    outside_networks: float
    two_hands_share: float
    patches_per_frame: float
    threads: dict[str, int]
    machine: str

    def to_dict(self) -> dict[str, Any]:
        """The fields by name, rounded to three digits after the point."""
        return {key: _rounded(value) for key, value in asdict(self).items()}


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return round(value, 3) if isinstance(value, float) else value


def fit_720p(frame: Frame) -> Frame:
    """The frame at 1280x720: scaled to fit, the rest filled with its border."""
    scale = min(BENCH_WIDTH_PX / frame.width_px, BENCH_HEIGHT_PX / frame.height_px)
    width, height = round(frame.width_px * scale), round(frame.height_px * scale)
    image = cv2.resize(frame.image, (width, height), interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
    left, top = (BENCH_WIDTH_PX - width) // 2, (BENCH_HEIGHT_PX - height) // 2
    right, bottom = BENCH_WIDTH_PX - width - left, BENCH_HEIGHT_PX - height - top
    padded = cv2.copyMakeBorder(image, top, bottom, left, right, cv2.BORDER_REPLICATE)
    return Frame(np.asarray(padded, np.uint8), frame.timestamp_ns, frame.index)


class NetworkTime:
    """Nanoseconds in which at least one network ran, since the last `reset`; calls side by side count once."""

    def __init__(self) -> None:
        self.total_ns = 0
        self._running = 0
        self._since_ns = 0
        self._lock = Lock()

    def reset(self) -> None:
        """Start again from zero; only between two calls."""
        self.total_ns = 0

    def begin(self) -> None:
        """A network call starts."""
        with self._lock:
            if self._running == 0:
                self._since_ns = now_ns()
            self._running += 1

    def end(self) -> None:
        """A network call is over."""
        with self._lock:
            self._running -= 1
            if self._running == 0:
                self.total_ns += now_ns() - self._since_ns


@contextmanager
def network_time() -> Iterator[NetworkTime]:
    """Time every network call of every session while the block runs."""
    session_type: Any = type(create_session(SHIPPED_MODEL))
    plain_run = session_type.run
    spent = NetworkTime()

    def timed_run(*args: Any, **kwargs: Any) -> Any:
        spent.begin()
        try:
            return plain_run(*args, **kwargs)
        finally:
            spent.end()

    session_type.run = timed_run
    try:
        yield spent
    finally:
        session_type.run = plain_run


def machine_name() -> str:
    """Processor, number of cores this process may use, operating system, Python."""
    cpu = platform.processor() or platform.machine()
    cpu_info = Path("/proc/cpuinfo")
    if cpu_info.is_file():
        fields = (line.partition(":") for line in cpu_info.read_text(encoding="utf-8").splitlines())
        cpu = next((value.strip() for name, _, value in fields if name.startswith("model name")), cpu)
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{cpu}, {cores} cores, {platform.system()} {platform.release()}, Python {platform.python_version()}"


def measure(frames: Sequence[Frame], config: TouchConfig, *, warm_up: int = 10) -> BenchReport:
    """Run `frames` through a fresh pipeline and time it; the first `warm_up` frames are not counted."""
    pipeline = TouchPipeline(config)
    frame_ms: list[float] = []
    stages: list[Mapping[str, float]] = []
    two_hands = patches = 0
    with network_time() as spent:
        for position, frame in enumerate(frames):
            if position == warm_up:
                spent.reset()
            start_ns = now_ns()
            result = pipeline.process(frame)
            elapsed_ms = (now_ns() - start_ns) / 1e6
            if position >= warm_up:
                frame_ms.append(elapsed_ms)
                stages.append(result.stage_ms)
                two_hands += len(result.hands) >= 2
                patches += len(result.fingertips)
    count = len(frame_ms)
    networks_ms = spent.total_ns / 1e6 / count
    return BenchReport(
        frames=count,
        width_px=frames[0].width_px,
        height_px=frames[0].height_px,
        fps=1000.0 / fmean(frame_ms),
        frame_ms_mean=fmean(frame_ms),
        frame_ms_median=median(frame_ms),
        frame_ms_p95=float(np.percentile(frame_ms, 95)),
        stage_ms={stage: fmean(lap[stage] for lap in stages) for stage in STAGES},
        networks_ms=networks_ms,
        outside_networks=1.0 - networks_ms / fmean(frame_ms),
        two_hands_share=two_hands / count,
        patches_per_frame=patches / count,
        threads={"hands": config.hands.threads, "touch": config.touch.threads, "opencv": cv2.getNumThreads()},
        machine=machine_name(),
    )
