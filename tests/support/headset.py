"""A headset that pushes the demo clip's frames, and a server whose source it is."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import cache
from pathlib import Path

import cv2

from egotouch_sdk.frame import Frame
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.server import EventServer
from egotouch_sdk.server.feed import Feed
from egotouch_sdk.server.headset_source import HeadsetPipeline, HeadsetSource
from egotouch_sdk.server.headset_target import HeadsetTarget
from egotouch_sdk.server.jpeg import decode_jpeg
from egotouch_sdk.sources import VideoFileSource
from egotouch_sdk.touch_event import EventType, TouchEvent
from egotouch_sdk.wire.codec import hand_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.socket_client import SocketClient, running_server

DEMO = Path(__file__).parents[2] / "egotouch_sdk" / "assets" / "demo.mp4"
FRAME_NS = 33_333_333
#: A headset's clock has nothing to do with the server's.
CLOCK_NS = 5_000_000_000_000
#: Frames of the demo clip around its first touch.
FIRST, LAST = 10, 33


@cache
def jpegs() -> tuple[bytes, ...]:
    """The frames around the demo clip's first touch as a headset would code them."""
    with VideoFileSource(DEMO) as clip:
        frames = [frame for frame in clip if frame.index < LAST][FIRST:]
    return tuple(cv2.imencode(".jpg", frame.image, [cv2.IMWRITE_JPEG_QUALITY, 90])[1].tobytes() for frame in frames)


@cache
def local_run() -> tuple[tuple[TouchEvent, ...], tuple[pb.ClientHands, ...]]:
    """What a local pipeline makes of the same pictures: its events, and the hands that it found."""
    pipeline = TouchPipeline()
    results = [pipeline.process(Frame(decode_jpeg(jpeg), index * FRAME_NS, index)) for index, jpeg in enumerate(jpegs())]
    hands = tuple(
        pb.ClientHands(timestamp_ns=CLOCK_NS + result.timestamp_ns, hands=[hand_to_proto(hand) for hand in result.hands])
        for result in results
    )
    return tuple(event for result in results for event in result.events), hands


def frames_until(event_type: EventType) -> int:
    """How many frames it takes until the first event of this type."""
    return next(event.timestamp_ns for event in local_run()[0] if event.type is event_type) // FRAME_NS + 1


@asynccontextmanager
async def headset_server(*, stall_ms: float = 10_000.0) -> AsyncIterator[EventServer]:
    """A server with the real pipeline that waits for a headset; patient, so that a busy machine changes nothing."""
    source = HeadsetSource()
    target = HeadsetTarget(source)
    async with running_server(push=target) as server:
        server.metrics.more.append(target.lines)
        engine = HeadsetPipeline(TouchPipeline(), source)
        feed = Feed(server, source, engine, stall_ms=stall_ms)
        feed.start()
        try:
            yield server
        finally:
            await feed.stop()


class Headset(SocketClient):
    """A client whose camera sees the demo clip."""

    async def push(self, jpeg: bytes, timestamp_ns: int) -> None:
        """Push one frame."""
        await self.send(pb.ClientMessage(frame=pb.ClientFrame(jpeg=jpeg, timestamp_ns=timestamp_ns)))

    async def show(self, first: int = 0, last: int | None = None, *, hands: tuple[pb.ClientHands, ...] = ()) -> None:
        """Push frames of the clip, each when the server has worked through the one before."""
        for index, jpeg in list(enumerate(jpegs()))[first:last]:
            done = self.server.metrics.frames
            await self.push(jpeg, CLOCK_NS + index * FRAME_NS)
            if hands:
                await self.send(pb.ClientMessage(hands=hands[index]))
            await frames_done(self.server, done + 1)

    async def warned(self) -> str:
        """The code of the next warning."""
        while not (message := await self.receive()).HasField("warning"):
            pass
        return message.warning.code


async def frames_done(server: EventServer, count: int) -> None:
    """Wait until the server has worked through so many frames."""
    async with asyncio.timeout(60):
        while server.metrics.frames < count:
            await asyncio.sleep(0.001)


def fates(server: EventServer) -> dict[str, int]:
    """What became of everything pushed, as /metrics says."""
    lines = (line for line in server.metrics.text().splitlines() if line.startswith("egotouch_pushed_total{"))
    found = {line.split('"')[1]: int(line.rsplit(" ", 1)[1]) for line in lines}
    return {name: count for name, count in found.items() if count}
