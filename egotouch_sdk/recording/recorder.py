"""Writing a recording, frame by frame."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Generic, Protocol, Self, TypeVar

from google.protobuf.message import Message

from egotouch_sdk import clock
from egotouch_sdk.errors import RecordingError
from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.recording import topics
from egotouch_sdk.recording.container import ContainerWriter
from egotouch_sdk.recording.header import Header
from egotouch_sdk.recording.image import SCHEMA_NAME, encode_image, image_schema
from egotouch_sdk.touch_event import CancelReason, TouchEvent
from egotouch_sdk.wire import enums, event_to_proto, observation_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: Data reach the file at least this often, in capture time or in the machine's, whichever runs faster; a killed program loses no
#: more (our choice, half of the second that is promised).
FLUSH_NS = 500_000_000

Item = TypeVar("Item", contravariant=True)


class Recorder:
    """Records frame results into an MCAP file; works in a `with` statement.

    Below the recogniser: what perception found in every frame and the events that came of it, never a picture unless `write` is
    given one. A crash loses the last second at most. `overwrite` replaces an existing file.
    Raises `RecordingError` when the file exists, cannot be made, or cannot be written any more; what was written stays readable.
    Raises `MissingExtraError` without the extra `recording`. `now_ns` decides when to flush and nothing else.
    """

    def __init__(self, path: str | Path, header: Header, *, overwrite: bool = False, now_ns: Callable[[], int] = clock.now_ns) -> None:
        self.path = Path(path)
        self.header = header
        self.frames = 0
        self.events = 0
        self._now_ns = now_ns
        self._container = ContainerWriter(self.path, overwrite=overwrite, library=f"egotouch-sdk {header.sdk_version}")
        self._flushed_ns = now_ns()
        self._flushed_capture_ns = 0
        self._is_open = True

    @property
    def size_bytes(self) -> int:
        """Bytes in the file so far."""
        return self._container.size_bytes

    def write(self, result: FrameResult, frame: Frame | None = None) -> None:
        """Record one frame; call it for every frame, in order. `frame` adds its picture as a JPEG."""
        if not self._is_open:
            raise RecordingError(f"the recording {self.path} is closed", hint="Make a new Recorder")
        image = encode_image(frame) if frame else None
        timestamp_ns = result.timestamp_ns
        try:
            if self.frames == 0:
                self._add(topics.HEADER, timestamp_ns, self.header.to_proto())
            self._add(topics.OBSERVATION, timestamp_ns, observation_to_proto(result.observation))
            self._add_events(timestamp_ns, result.events)
            if image:
                self._container.add(topics.IMAGE, SCHEMA_NAME, image_schema(), timestamp_ns, image)
            self._flush_when_due(timestamp_ns)
        except BaseException:
            # A frame that was written by half must not be followed by another.
            self._is_open = False
            self._container.abandon()
            raise
        self.frames += 1

    def end(self, timestamp_ns: int, events: tuple[TouchEvent, ...] = (), reason: CancelReason = CancelReason.SOURCE_ENDED) -> None:
        """Record what an engine's `finish` was given and gave; nothing follows. Does nothing after a failed write or without frames."""
        if not self._is_open or not self.frames:
            return
        self._add(topics.END, timestamp_ns, pb.RecordingEnd(timestamp_ns=timestamp_ns, reason=enums.CANCEL_REASONS.number(reason)))
        self._add_events(timestamp_ns, events)
        self.close()

    def close(self) -> None:
        """Write what is pending and the index, and close the file; may be called twice."""
        was_open, self._is_open = self._is_open, False
        if was_open:
            self._container.close()

    def _add(self, topic: str, timestamp_ns: int, message: Message) -> None:
        kind = message.DESCRIPTOR
        self._container.add(topic, kind.full_name, topics.schema_of(kind.name), timestamp_ns, message.SerializeToString())

    def _add_events(self, timestamp_ns: int, events: tuple[TouchEvent, ...]) -> None:
        if events:
            messages = [event_to_proto(event) for event in events]
            self._add(topics.EVENTS, timestamp_ns, pb.RecordedEvents(timestamp_ns=timestamp_ns, events=messages))
            self.events += len(events)

    def _flush_when_due(self, timestamp_ns: int) -> None:
        now_ns = self._now_ns()
        if self.frames == 0 or max(now_ns - self._flushed_ns, timestamp_ns - self._flushed_capture_ns) >= FLUSH_NS:
            self._container.flush()
            self._flushed_ns, self._flushed_capture_ns = now_ns, timestamp_ns

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()


class _Engine(Protocol[Item]):
    def process(self, item: Item, /) -> FrameResult: ...

    def finish(self, timestamp_ns: int, reason: CancelReason = ...) -> tuple[TouchEvent, ...]: ...


class RecordedEngine(Generic[Item]):
    """A `TouchPipeline` or `EventEngine` of which everything is recorded; use it in the other's place.

    `with_video` records the pictures too, where there are any.
    """

    def __init__(self, engine: _Engine[Item], recorder: Recorder, *, with_video: bool = False) -> None:
        self._engine = engine
        self._recorder = recorder
        self._with_video = with_video

    def process(self, item: Item, /) -> FrameResult:
        """Let the engine take the next frame or observation, and record it."""
        result = self._engine.process(item)
        self._recorder.write(result, item if self._with_video and isinstance(item, Frame) else None)
        return result

    def finish(self, timestamp_ns: int, reason: CancelReason = CancelReason.SOURCE_ENDED) -> tuple[TouchEvent, ...]:
        """Let the engine end every touch, and end the recording."""
        events = self._engine.finish(timestamp_ns, reason)
        self._recorder.end(timestamp_ns, events, reason)
        return events
