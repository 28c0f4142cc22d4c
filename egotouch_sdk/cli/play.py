"""Running a source through the pipeline or the event engine, frame by frame, until it ends or the user stops it."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeVar

from egotouch_sdk.clock import Pacer, now_ns
from egotouch_sdk.errors import SourceError
from egotouch_sdk.touch_event import CancelReason, TouchEvent

if TYPE_CHECKING:
    from egotouch_sdk.frame_result import FrameResult

EventSink = Callable[[TouchEvent], None]


class Timed(Protocol):
    """A camera frame, or what was observed in one."""

    @property
    def timestamp_ns(self) -> int:
        """Capture time."""


Item = TypeVar("Item", bound=Timed)
Taken = TypeVar("Taken", bound=Timed, contravariant=True)


class Engine(Protocol[Taken]):
    """What turns a source's items into events: a `TouchPipeline` for frames, an `EventEngine` for observations."""

    def process(self, item: Taken, /) -> FrameResult:
        """Take the next item."""

    def finish(self, timestamp_ns: int, reason: CancelReason = ...) -> tuple[TouchEvent, ...]:
        """End every touch."""


@dataclass(frozen=True, slots=True)
class Run:
    """What came of playing a source: frames done, capture time of the last one, time it took, whether Ctrl-C ended it."""

    frames: int
    last_timestamp_ns: int
    wall_s: float
    interrupted: bool

    @property
    def fps(self) -> float:
        """Frames per second that were worked through."""
        return self.frames / self.wall_s if self.wall_s > 0 else 0.0


def play(
    items: Iterable[Item],
    engine: Engine[Item],
    on_event: EventSink,
    on_frame: Callable[[Item, FrameResult], None] | None = None,
    *,
    paced: bool = False,
) -> Run:
    """Process every frame or observation; touches still open at the end are cancelled, and their events handed on, whatever the reason.

    Ctrl-C ends the run cleanly. A source that fails cancels with `SOURCE_STALLED` before its `SourceError` goes on.
    `paced` holds each frame back until its presentation time.
    """
    pacer = Pacer() if paced else None
    start_ns = now_ns()
    count = 0
    last_ns = 0
    interrupted = False
    reason = CancelReason.SOURCE_ENDED
    try:
        for item in items:
            if pacer:
                pacer.wait(item.timestamp_ns)
            last_ns = item.timestamp_ns
            result = engine.process(item)
            count += 1
            for event in result.events:
                on_event(event)
            if on_frame:
                on_frame(item, result)
    except KeyboardInterrupt:
        ignore_interrupts()
        interrupted = True
    except SourceError:
        reason = CancelReason.SOURCE_STALLED
        raise
    finally:
        for event in engine.finish(last_ns, reason):
            on_event(event)
    return Run(count, last_ns, (now_ns() - start_ns) / 1e9, interrupted)


def ignore_interrupts() -> None:
    """After a first Ctrl-C: files are being closed, which a second one must not break."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.SIG_IGN)
