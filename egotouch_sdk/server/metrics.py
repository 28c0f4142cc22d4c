"""What the server measures about itself, in Prometheus' text format."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence

#: Upper bounds of the latency buckets in seconds.
BUCKETS_S = (0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)

#: Classes of what does not go out as it came in. Edges that are in time are in none of them: they are never dropped.
DROPS = ("frame", "move", "late_edge", "status")
DROPPED = (
    "Frames nobody had time for, batches of moves that became part of a later one for one client, edges that came too late for one "
    "client to act upon, statuses and landmarks left out for one client while others waited."
)


class Histogram:
    """Counts of values up to each bound, as Prometheus has them."""

    def __init__(self, bounds: Sequence[float] = BUCKETS_S) -> None:
        self._bounds = tuple(bounds)
        self._counts = [0] * (len(self._bounds) + 1)
        self._sum = 0.0

    def add(self, value: float, times: int = 1) -> None:
        """Count a value, or the same one `times` times."""
        self._counts[bisect_left(self._bounds, value)] += times
        self._sum += value * times

    def lines(self, name: str) -> Iterator[str]:
        """The histogram as text."""
        total = 0
        for bound, count in zip((*self._bounds, float("inf")), self._counts, strict=True):
            total += count
            yield f'{name}_bucket{{le="{"+Inf" if bound == float("inf") else bound}"}} {total}'
        yield f"{name}_sum {self._sum}"
        yield f"{name}_count {total}"


class Metrics:
    """Counters since the server started; an object of its own, so that two servers in one process do not mix.

    `more` gives the lines of what else is measured.
    """

    def __init__(self) -> None:
        self.frames = 0
        self.messages = 0
        self.clients = 0
        self.events: Counter[str] = Counter()
        self.dropped: Counter[str] = Counter(dict.fromkeys(DROPS, 0))
        self.closed: Counter[int] = Counter()
        self.added_latency = Histogram()
        self.capture_latency = Histogram()
        self.more: list[Callable[[], Iterator[str]]] = []

    def text(self) -> str:
        """Everything in Prometheus' text format, version 0.0.4."""
        return "\n".join((*self._lines(), ""))

    def _lines(self) -> Iterator[str]:
        yield from family("egotouch_frames_total", "counter", "Frames worked through.", [("", self.frames)])
        yield from family("egotouch_events_total", "counter", "Events published.", labelled("type", self.events))
        yield from family("egotouch_messages_sent_total", "counter", "Messages sent to clients.", [("", self.messages)])
        yield from family("egotouch_dropped_total", "counter", DROPPED, labelled("class", self.dropped))
        yield from family("egotouch_clients", "gauge", "Clients that are connected.", [("", self.clients)])
        yield from family("egotouch_connections_closed_total", "counter", "Connections closed, by code.", labelled("code", self.closed))
        name, text = "egotouch_added_latency_seconds", "From the end of inference to the socket, for each message with events."
        yield from (f"# HELP {name} {text}", f"# TYPE {name} histogram", *self.added_latency.lines(name))
        name, text = "egotouch_capture_latency_seconds", "From capture to the end of inference, for each frame with events."
        yield from (f"# HELP {name} {text}", f"# TYPE {name} histogram", *self.capture_latency.lines(name))
        for lines in self.more:
            yield from lines()


def labelled(label: str, counts: Mapping[str, int] | Mapping[int, int]) -> list[tuple[str, int]]:
    """One sample for each of the label's values."""
    return [(f'{{{label}="{value}"}}', count) for value, count in sorted(counts.items(), key=str)]


def family(name: str, kind: str, text: str, samples: list[tuple[str, int]]) -> Iterator[str]:
    """A metric with its help and its samples."""
    yield f"# HELP {name} {text}"
    yield f"# TYPE {name} {kind}"
    yield from (f"{name}{labels} {value}" for labels, value in samples)
