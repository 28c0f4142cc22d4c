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

    @property
    def rounding(self) -> float | None:
        """Largest difference of a number, where the events are otherwise the same; None where they are not.

        Processors add in different orders and round differently, so that another machine's numbers may differ in the last digits.
        """
        if len(self.recorded) != len(self.replayed):
            return None
        return _largest_difference([event.to_dict() for event in self.recorded], [event.to_dict() for event in self.replayed])


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


def _largest_difference(before: object, now: object) -> float | None:
    """The largest difference between two numbers at the same place of two nested values; None when anything else differs."""
    if isinstance(before, float) and isinstance(now, float):
        return abs(before - now)
    if isinstance(before, dict) and isinstance(now, dict) and before.keys() == now.keys():
        before, now = list(before.values()), list(now.values())
    if isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        inner = [_largest_difference(*pair) for pair in zip(before, now, strict=True)]
        return None if None in inner else max((value for value in inner if value is not None), default=0.0)
    return 0.0 if before == now else None
