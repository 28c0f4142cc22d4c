"""The newest picture of a client as a source, and the pipeline that works on it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from threading import Condition
from types import TracebackType
from typing import Self

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import FrameError
from egotouch_sdk.frame import MIN_SIDE_PX, Frame
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.server.headset_hands import Hands, HeadsetHands
from egotouch_sdk.server.jpeg import decode_jpeg
from egotouch_sdk.touch_event import CancelReason, TouchEvent


@dataclass(frozen=True, slots=True)
class Picture:
    """A JPEG that waits to be decoded, its capture time on the server's clock, and the hands in it where the client brought them."""

    jpeg: bytes
    timestamp_ns: int
    hands: Hands | None = None


@dataclass(frozen=True, slots=True)
class PusherLeft:
    """The client whose frames these were has gone; `timestamp_ns` is that of its last frame."""

    timestamp_ns: int


class HeadsetSource:
    """Frames that one client pushes: a single picture waits, a newer one takes its place.

    `put` and `leave` may be called from any thread; pictures are decoded by whoever iterates. `hands` are those that came with the
    frame given last. `counts` has the fate of the pictures: "taken", "replaced" by a newer one while waiting, "damaged".
    """

    is_live = True
    width_px: int | None = None
    height_px: int | None = None
    fps: float | None = None
    frame_count: int | None = None

    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()
        self.hands: Hands | None = None
        self._changed = Condition()
        self._waiting: Picture | None = None
        self._left_ns: int | None = None
        self._damage = ""
        self._closed = False

    def put(self, picture: Picture) -> None:
        """Hand over the newest picture; times must rise."""
        with self._changed:
            self.counts["replaced"] += self._waiting is not None
            self._waiting = picture
            self._changed.notify_all()

    def leave(self, timestamp_ns: int) -> None:
        """The client has gone: what waits is dropped, what it touched is cancelled with DISCONNECTED."""
        with self._changed:
            self.counts["replaced"] += self._waiting is not None
            self._waiting, self._left_ns = None, timestamp_ns
            self._changed.notify_all()

    def pop_damage(self) -> str:
        """What was wrong with a picture since the last call, or nothing."""
        with self._changed:
            damage, self._damage = self._damage, ""
            return damage

    def __iter__(self) -> Iterator[Frame | PusherLeft]:
        """Yield frames in capture order, and `PusherLeft` between two clients."""
        index = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._waiting is not None or self._left_ns is not None)
                if self._closed:
                    return
                left_ns, self._left_ns = self._left_ns, None
                picture = self._waiting if left_ns is None else None
                if picture is not None:
                    self._waiting = None
            if left_ns is not None:
                yield PusherLeft(left_ns)
            elif picture is not None and (frame := self._decode(picture, index)) is not None:
                self.hands = picture.hands
                index += 1
                yield frame

    def close(self) -> None:
        """End the iteration; may be called twice, from any thread."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def _decode(self, picture: Picture, index: int) -> Frame | None:
        try:
            frame = Frame(decode_jpeg(picture.jpeg), picture.timestamp_ns, index)
        except FrameError as error:
            with self._changed:
                self.counts["damaged"] += 1
                self._damage = str(error)
            return None
        self.counts["taken"] += 1
        return frame


class HeadsetPipeline:
    """A `TouchPipeline` that takes the hands which came with a frame, and cancels what is open when the client leaves."""

    def __init__(self, pipeline: TouchPipeline, source: HeadsetSource) -> None:
        self._pipeline = pipeline
        self._source = source
        self._hands = HeadsetHands(pipeline.hands)
        pipeline.hands = self._hands
        self._last = (0, MIN_SIDE_PX, MIN_SIDE_PX)

    @property
    def config(self) -> TouchConfig:
        """Settings of every stage."""
        return self._pipeline.config

    def process(self, item: Frame | PusherLeft, /) -> FrameResult:
        """Take one frame, or the end of a client."""
        if isinstance(item, PusherLeft):
            events = self._pipeline.finish(item.timestamp_ns, CancelReason.DISCONNECTED)
            index, width_px, height_px = self._last
            return FrameResult(FrameObservation(index, item.timestamp_ns, width_px, height_px), events=events)
        self._last = item.index, item.width_px, item.height_px
        self._hands.own = self._source.hands
        return self._pipeline.process(item)

    def finish(self, timestamp_ns: int, reason: CancelReason, /) -> tuple[TouchEvent, ...]:
        """Cancel what is open."""
        return self._pipeline.finish(timestamp_ns, reason)
