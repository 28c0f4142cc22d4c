"""Running the event engine over a recording again, and comparing what comes of it with what was recorded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.recording import RecordedEnd, RecordingSource
from egotouch_sdk.touch_event import TouchEvent
from egotouch_sdk.wire import event_from_proto, event_to_proto


@dataclass(frozen=True, slots=True)
class ReplayedFrame:
    """One frame of a replay: its number in the recording from 0, and the events then and now, all as on the wire.

    `index` is None for the events of the recording's end.
    """

    index: int | None
    timestamp_ns: int
    recorded: tuple[TouchEvent, ...]
    replayed: tuple[TouchEvent, ...]

    @property
    def is_identical(self) -> bool:
        """True when both are the same byte for byte."""
        return _as_bytes(self.recorded) == _as_bytes(self.replayed)


def replay(recording: RecordingSource, config: TouchConfig | None = None) -> Iterator[ReplayedFrame]:
    """Yield every frame with its events then and now; `config` replaces the recorded settings.

    A recording that was cut off has no end, and touches that were open then stay open.
    """
    engine = EventEngine(config or recording.config, recording.thresholds)
    for count, entry in enumerate(recording.entries()):
        if isinstance(entry, RecordedEnd):
            now = engine.finish(entry.timestamp_ns, entry.reason)
            yield ReplayedFrame(None, entry.timestamp_ns, entry.events, _on_wire(now))
        else:
            now = engine.process(entry.observation).events
            yield ReplayedFrame(count, entry.timestamp_ns, entry.events, _on_wire(now))


def _on_wire(events: tuple[TouchEvent, ...]) -> tuple[TouchEvent, ...]:
    return tuple(event_from_proto(event_to_proto(event)) for event in events)


def _as_bytes(events: tuple[TouchEvent, ...]) -> list[bytes]:
    return [event_to_proto(event).SerializeToString(deterministic=True) for event in events]
