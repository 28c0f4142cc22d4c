"""Plays a source in its own thread, so that the screen stays alive."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from threading import Event, Thread
from typing import Any, Final

from egotouch_sdk.cli.play import Engine, Timed, play
from egotouch_sdk.clock import Pacer
from egotouch_sdk.engine import EventEngine, PointerSnapshot
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import Handedness
from egotouch_sdk.observation import GateReason
from egotouch_sdk.sources import FrameSource, ObservationSource
from egotouch_sdk.touch_event import TouchEvent

#: A source that is stuck in a driver is left behind after this long (our choice).
STOP_TIMEOUT_S: Final = 2.0


@dataclass(frozen=True, slots=True)
class Step:
    """What one frame did: its events, and where all pointers are after it. No picture."""

    index: int
    timestamp_ns: int
    gate: GateReason
    hands: tuple[tuple[Handedness, str], ...]
    events: tuple[TouchEvent, ...]
    pointers: tuple[PointerSnapshot, ...]
    total_ms: float


class Player:
    """Runs a source through its engine and keeps what each frame did until `take` is called.

    `paced` plays a source that is not live at the speed at which it was captured. `until_ns` stops before the first frame that is
    later than this after the first one; touches stay open then. `error` is why the source failed, None while it has not.
    """

    def __init__(
        self, source: FrameSource | ObservationSource, engine: Engine[Any], core: EventEngine, *, paced: bool, until_ns: int | None = None
    ) -> None:
        self.is_live = source.is_live
        self.error: Exception | None = None
        self.held = Event()
        self.ended = Event()
        self._source = source
        self._engine = engine
        self._core = core
        self._paced = paced and not source.is_live
        self._until_ns = until_ns
        self._steps: deque[Step] = deque()
        self._last_events: deque[TouchEvent] = deque()
        self._going = Event()
        self._going.set()
        self._stopping = Event()
        self._thread = Thread(target=self._run, name="egotouch-debug-events", daemon=True)

    @property
    def is_running(self) -> bool:
        """True while the source is being played."""
        return self._thread.is_alive()

    def start(self) -> None:
        """Begin to play."""
        self._thread.start()

    def pause(self, paused: bool) -> None:
        """Hold the source or let it go on; a live one goes on all the same."""
        if paused:
            self._going.clear()
        else:
            self._going.set()

    def take(self) -> list[Step]:
        """What happened since the last call, oldest first."""
        return [self._steps.popleft() for _ in range(len(self._steps))]

    def take_last_events(self) -> list[TouchEvent]:
        """The events with which the source ended."""
        return [self._last_events.popleft() for _ in range(len(self._last_events))]

    def stop(self) -> None:
        """End the thread; a live source is closed, so that nobody waits for its next picture."""
        self._stopping.set()
        self._going.set()
        if self.is_live:
            self._source.close()
        if self._thread.is_alive():
            self._thread.join(timeout=STOP_TIMEOUT_S)

    def _run(self) -> None:
        pending: list[TouchEvent] = []

        def on_frame(_: Timed, result: FrameResult) -> None:
            pending.clear()
            self._steps.append(_step(result, self._core))

        try:
            play(self._items(), self._engine, pending.append, on_frame)
        except Exception as error:
            self.error = error
        finally:
            self._last_events.extend(pending)
            self.ended.set()

    def _items(self) -> Iterator[Any]:
        pacer = Pacer()
        start_ns: int | None = None
        for item in self._source:
            start_ns = item.timestamp_ns if start_ns is None else start_ns
            if self._until_ns is not None and item.timestamp_ns - start_ns > self._until_ns:
                self.held.set()
                self._stopping.wait()
            if not self.is_live and not self._going.is_set():
                self._going.wait()
                pacer = Pacer()
            if self._paced:
                pacer.wait(item.timestamp_ns)
            if self._stopping.is_set():
                return
            yield item


def _step(result: FrameResult, core: EventEngine) -> Step:
    touching = {pair.touching.hand_id for pair in result.gate.pairs}
    hosts = {pair.host.hand_id for pair in result.gate.pairs}
    roles = [
        (hand.handedness, "touching" if hand.hand_id in touching else "host" if hand.hand_id in hosts else "seen") for hand in result.hands
    ]
    return Step(result.index, result.timestamp_ns, result.gate.reason, tuple(roles), result.events, core.pointers, result.total_ms)
