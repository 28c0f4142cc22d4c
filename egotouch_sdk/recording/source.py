"""Reading a recording."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import Self, TypeVar

from google.protobuf.message import Message

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import ProtocolError, RecordingError, SourceWarning
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.recording import topics
from egotouch_sdk.recording.container import DamagedError, Record, message_count, read_records
from egotouch_sdk.recording.header import Header
from egotouch_sdk.state import Thresholds
from egotouch_sdk.touch_event import CancelReason, TouchEvent
from egotouch_sdk.wire import decode, enums, events_from_proto, observation_from_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

M = TypeVar("M", bound=Message)

_HINT = "Give a file that `egotouch record` wrote"


@dataclass(frozen=True, slots=True)
class RecordedFrame:
    """One frame of a recording and the events that it caused then, their numbers rounded to float32."""

    observation: FrameObservation
    events: tuple[TouchEvent, ...] = ()

    @property
    def timestamp_ns(self) -> int:
        """Capture time of the frame."""
        return self.observation.timestamp_ns


@dataclass(frozen=True, slots=True)
class RecordedEnd:
    """How a recording ended: what the engine's `finish` was given, and the events that it gave."""

    timestamp_ns: int
    reason: CancelReason
    events: tuple[TouchEvent, ...] = ()


class RecordingSource:
    """A recording as a source of observations; every iteration starts at its beginning.

    A recording whose program was killed, or that was cut off, gives all that is whole, and then a `SourceWarning`.
    Raises `RecordingError` for a file that is no recording, holds no frames, or was made by an incompatible version, and
    `MissingExtraError` without the extra `recording`.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        records = read_records(self.path)
        try:
            first = next(records, None)
            if first is None or first.topic != topics.HEADER:
                raise RecordingError(f"{self.path} is no egotouch recording, or one without frames", hint=_HINT)
            self.header = Header.from_proto(self._decode(pb.RecordingHeader, first))
            second = next(records, None)
            self._first = self._frame(second).observation if second and second.topic == topics.OBSERVATION else None
        except DamagedError as error:
            raise RecordingError(f"{self.path} is no recording, or nothing of it is whole ({error})", hint=_HINT) from error
        finally:
            records.close()
        self._frame_count = message_count(self.path, topics.OBSERVATION)

    @property
    def config(self) -> TouchConfig:
        """The settings that the recorded events were made with."""
        return self.header.config

    @property
    def thresholds(self) -> Thresholds:
        """The touch thresholds that the recorded events were made with."""
        return self.header.thresholds

    @property
    def is_live(self) -> bool:
        """False: a file waits."""
        return False

    @property
    def width_px(self) -> int | None:
        """Width in pixels of the first image that was observed."""
        return self._first.width_px if self._first else None

    @property
    def height_px(self) -> int | None:
        """Height in pixels of the first image that was observed."""
        return self._first.height_px if self._first else None

    @property
    def fps(self) -> float | None:
        """Rate that the recorded source announced."""
        return self.header.fps

    @property
    def frame_count(self) -> int | None:
        """Number of observations; None when the recording has no index because its program was killed."""
        return self._frame_count

    def __iter__(self) -> Iterator[FrameObservation]:
        """Yield the observations in capture order."""
        return (entry.observation for entry in self.entries() if isinstance(entry, RecordedFrame))

    def entries(self) -> Iterator[RecordedFrame | RecordedEnd]:
        """Yield every frame with its recorded events and then the end, which a recording has not when its program was killed."""
        entry: RecordedFrame | RecordedEnd | None = None
        damage: DamagedError | None = None
        try:
            for record in read_records(self.path):
                if record.topic == topics.EVENTS and entry is not None:
                    entry = replace(entry, events=self._events(record))
                elif record.topic in (topics.OBSERVATION, topics.END):
                    if entry is not None:
                        yield entry
                    entry = self._frame(record) if record.topic == topics.OBSERVATION else self._end(record)
        except DamagedError as error:
            damage = error
        if entry is not None:
            yield entry
        if damage is not None:
            until = f" at {entry.timestamp_ns / 1e9:.3f} s" if entry else ""
            warnings.warn(f"the recording {self.path} was cut off{until} ({damage}); all before that is sound", SourceWarning, stacklevel=2)

    def _frame(self, record: Record) -> RecordedFrame:
        message = self._decode(pb.FrameObservation, record)
        with self._named():
            return RecordedFrame(observation_from_proto(message))

    def _end(self, record: Record) -> RecordedEnd:
        message = self._decode(pb.RecordingEnd, record)
        with self._named():
            return RecordedEnd(message.timestamp_ns, enums.CANCEL_REASONS.member(message.reason))

    def _events(self, record: Record) -> tuple[TouchEvent, ...]:
        message = self._decode(pb.RecordedEvents, record)
        with self._named():
            return events_from_proto(message.events)

    def _decode(self, kind: type[M], record: Record) -> M:
        with self._named():
            return decode(kind, record.data)

    @contextmanager
    def _named(self) -> Iterator[None]:
        try:
            yield
        except ProtocolError as error:
            raise RecordingError(f"{self.path} holds what no recorder writes: {error.message}", hint=_HINT) from error

    def close(self) -> None:
        """Nothing is left open between two iterations."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
