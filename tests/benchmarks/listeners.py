"""Time from an event to the code that listens to it, and how many events get through.

PYTHONPATH=. python tests/benchmarks/listeners.py     prints one JSON object; wall time in microseconds, events per second
"""

from __future__ import annotations

import asyncio
import json
import statistics
import threading
import time
from collections.abc import Callable

from egotouch_sdk.clock import now_ns
from egotouch_sdk.listeners import Delivery, Dispatcher, Listeners, merge
from egotouch_sdk.listeners.stream import EventStream
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

#: Ten seconds of two touching fingers seen at 90 Hz: a MOVE and a DRAG of each in every frame.
FRAMES, RATE_HZ, FINGERS = 900, 90, 2
MANY, CHUNK = 100_000, 500


class Bench(Listeners):
    """Listeners with a dispatcher of their own."""

    def __init__(self) -> None:
        super().__init__()
        self.delivery = Delivery(self._registry, now_ns)
        self.dispatcher = Dispatcher(self.delivery.deliver)


def frame(timestamp_ns: int) -> list[TouchEvent]:
    kinds = (EventType.MOVE, EventType.DRAG)
    return [make_event(kind, timestamp_ns, pointer_id=finger) for finger in range(FINGERS) for kind in kinds]


def summary(latencies_ns: list[int]) -> dict[str, float]:
    cuts = statistics.quantiles(latencies_ns, n=100)
    return {"median_us": round(cuts[49] / 1e3, 1), "p99_us": round(cuts[98] / 1e3, 1), "max_us": round(max(latencies_ns) / 1e3, 1)}


def at_camera_rate(take: Callable[[list[TouchEvent]], None]) -> None:
    """Hand over frames at 90 Hz; every event carries the time at which it was handed over."""
    start_ns = now_ns()
    for index in range(FRAMES):
        time.sleep(max(0.0, (start_ns + index * 10**9 / RATE_HZ - now_ns()) / 1e9))
        take(frame(now_ns()))


def listener_latency() -> dict[str, float]:
    bench, latencies_ns = Bench(), list[int]()
    for register in (bench.onTouchMove, bench.onDrag):
        register(lambda event: latencies_ns.append(now_ns() - event.timestamp_ns))
    bench.dispatcher.start()
    at_camera_rate(bench.dispatcher.post)
    bench.dispatcher.stop()
    return {**summary(latencies_ns), "merged": bench.dispatcher.merged, "events": len(latencies_ns)}


def stream_latency() -> dict[str, float]:
    async def started() -> None:
        pass

    async def consume() -> dict[str, float]:
        stream = EventStream(None, 256, "coalesce", started)
        thread = threading.Thread(target=lambda: (at_camera_rate(stream.push), stream.end()))
        thread.start()
        latencies_ns = [now_ns() - event.timestamp_ns async for event in stream]
        thread.join()
        return summary(latencies_ns)

    return asyncio.run(consume())


def deliveries_per_second() -> int:
    """Edges, which never merge, from `post` to one filtered listener."""
    bench = Bench()
    bench.onTouchDown(lambda event: None, finger="index", surface="palm")
    events = [make_event(EventType.DOWN)] * CHUNK
    bench.dispatcher.start()
    start_ns = now_ns()
    for _ in range(MANY // CHUNK):
        bench.dispatcher.post(events)
        bench.dispatcher.flush()
    bench.dispatcher.stop()
    return round(MANY / (now_ns() - start_ns) * 1e9)


def merges_per_second() -> int:
    older, newer = frame(1)[0], frame(2)[0]
    start_ns = now_ns()
    for _ in range(MANY // 10):
        older = merge(older, newer)
    return round(MANY / 10 / (now_ns() - start_ns) * 1e9)


if __name__ == "__main__":
    report = {
        "listener_latency": listener_latency(),
        "async_latency": stream_latency(),
        "deliveries_per_second": deliveries_per_second(),
        "merges_per_second": merges_per_second(),
    }
    print(json.dumps(report, indent=2))
