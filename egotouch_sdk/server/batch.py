"""All events of one frame, as the server keeps them while they wait."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import NamedTuple

from egotouch_sdk.listeners import merge
from egotouch_sdk.touch_event import EventType, TouchEvent

#: What one event counts for in an outbox: its size as protobuf, rounded up (our measurement: 95 bytes).
EVENT_BYTES = 128


class Encoded(NamedTuple):
    """A finished message, when it was made, and the events in it, whose identities are its key: they must live as long as it does."""

    sent_ns: int
    events: tuple[TouchEvent, ...]
    data: bytes | str


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """The events of one frame; they happen together.

    `timestamp_ns` is the frame's capture time, `published_ns` when the server learned of it, both on the server's clock.
    `offset` is the number of edges in the epoch up to and including this batch. A `replay` is sent again to a client that came back.
    `has_edges` tells whether an event is in it that must not be lost.
    `encoded` keeps the finished messages, so that clients that get the same share them.
    """

    frame_index: int
    timestamp_ns: int
    published_ns: int
    offset: int
    events: tuple[TouchEvent, ...]
    replay: bool = False
    encoded: dict[Hashable, Encoded] = field(default_factory=dict, repr=False)
    has_edges: bool = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "has_edges", any(event.type.is_edge for event in self.events))

    @property
    def size_bytes(self) -> int:
        """What it counts for in an outbox, an estimate."""
        return EVENT_BYTES * sum(1 + len(event.coalesced) for event in self.events)

    def merged_with(self, newer: Batch) -> Batch:
        """This batch and a newer one as one; neither may have edges. Events stay in the order of their times."""
        events: dict[tuple[int, int, EventType], TouchEvent] = {_key(event): event for event in self.events}
        for event in newer.events:
            older = events.pop(_key(event), None)
            events[_key(event)] = event if older is None else merge(older, event)
        return Batch(newer.frame_index, newer.timestamp_ns, newer.published_ns, newer.offset, tuple(events.values()))


def _key(event: TouchEvent) -> tuple[int, int, EventType]:
    return event.pointer_id, event.contact_id, event.type
