"""What is republished elsewhere: subjects, payloads, and what happens while nobody can be reached. No sockets, no clock."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace

from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.limits import Limits
from egotouch_sdk.server.metrics import family, labelled
from egotouch_sdk.server.outbox import Outbox
from egotouch_sdk.server.pointer_view import PointerView
from egotouch_sdk.server.subscription import Subscription
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from egotouch_sdk.wire import event_to_proto, to_json

#: All subjects begin with it.
ROOT = "egotouch.v1"
_NO_CONTACT = frozenset({EventType.UP, EventType.CANCEL, EventType.CLICK, EventType.DOUBLE_CLICK, EventType.FLING})


def subject_token(name: str) -> str:
    """`name` as one token of a subject: whatever is no ASCII letter, digit, `-` or `_` becomes `_`."""
    return re.sub(r"[^A-Za-z0-9_-]", "_", name) or "_"


class Publication:
    """The events of one server as messages, each `egotouch.v1.<session>.<surface>.<type>` with a TouchEvent (protobuf, or JSON).

    While the other side is away moves merge, and what is older than the time to live is dropped: nothing acts late. Whoever listens
    is never left with an open contact: what was down when the link broke is cancelled (DISCONNECTED) as soon as it is back, since
    nobody knows what still arrived (so a CANCEL may come after its UP, where it changes nothing), and pointers that left meanwhile
    leave then. A contact that begins while the link is away is left
    out to its end. `counts` has events "sent" and "too_old", and contacts "cancelled".
    """

    def __init__(self, session: str, limits: Limits | None = None, *, as_json: bool = False) -> None:
        self.session = subject_token(session)
        self.connected = False
        self.counts = Counter(sent=0, too_old=0, cancelled=0)
        self._limits = limits or Limits()
        self._as_json = as_json
        self._outbox = Outbox(self._limits)
        self._view = PointerView(Subscription())
        self._known: set[int] = set()
        self._down: dict[int, TouchEvent] = {}
        self._down_before: dict[int, TouchEvent] = {}
        self._in_doubt: list[TouchEvent] = []
        self._owed: list[TouchEvent] = []

    def offer(self, batch: Batch) -> None:
        """Take the newest batch; while the other side is away, what is too old is forgotten."""
        self._outbox.push(batch)
        if not self.connected:
            self._forget(batch.published_ns)

    def connect(self, now_ns: int) -> None:
        """The other side is there, for the first time or again."""
        self._forget(now_ns)
        self.connected = True

    def confirm(self) -> None:
        """All that was taken has arrived."""
        self._in_doubt, self._down_before = [], dict(self._down)

    def disconnect(self) -> None:
        """The link broke; what is down, and what may have ended unheard, is ended again when it is back."""
        self.connected = False
        for event in self._down.values():
            self._owed += self._view.apply((_cancelling(event),), stale=True)[1]
        ended = self._down_before | {event.pointer_id: event for event in self._in_doubt if not event.type.is_hover}
        self._owed += [_cancelling(event) for pointer_id, event in ended.items() if pointer_id not in self._down]
        self._owed += [event for event in self._in_doubt if event.type is EventType.HOVER_EXIT]
        self.counts["cancelled"] += len(self._down)
        self._down.clear()
        self.confirm()

    def take(self, now_ns: int) -> list[tuple[str, bytes]]:
        """Subjects and payloads to send now, in order."""
        events, self._owed = self._owed, []
        while len(self._outbox):
            batch = self._outbox.pop()
            stale = self._is_stale(batch, now_ns)
            shown = self._view.apply(batch.events, stale=stale)[1]
            self.counts["too_old"] += max(len(batch.events) - len(shown), 0) if stale else 0
            events.extend(shown)
        self._note(events)
        self._in_doubt += events
        self.counts["sent"] += len(events)
        return [(self._subject(event), self._payload(event)) for event in events]

    def lines(self) -> Iterator[str]:
        """The counts in Prometheus' text format."""
        text = "Events for NATS that were sent or dropped as too old, and contacts cancelled by a broken link."
        yield from family("egotouch_published_total", "counter", text, labelled("result", self.counts))
        yield from family("egotouch_publisher_connected", "gauge", "1 while NATS can be reached.", [("", int(self.connected))])

    def _forget(self, now_ns: int) -> None:
        while (head := self._outbox.head) is not None and (self._is_stale(head, now_ns) or self._outbox.is_overfull):
            for event in self._outbox.pop().events:
                if event.type is EventType.HOVER_EXIT and event.pointer_id in self._known:
                    self._known.discard(event.pointer_id)
                    self._owed += self._view.apply((event,))[1]
                else:
                    self.counts["too_old"] += 1

    def _is_stale(self, batch: Batch, now_ns: int) -> bool:
        return now_ns - batch.published_ns > self._limits.input_ttl_ns

    def _note(self, events: Iterable[TouchEvent]) -> None:
        for event in events:
            if event.type is EventType.HOVER_EXIT:
                self._known.discard(event.pointer_id)
            else:
                self._known.add(event.pointer_id)
            if event.type.is_hover or event.type in _NO_CONTACT:
                self._down.pop(event.pointer_id, None)
            else:
                self._down[event.pointer_id] = event

    def _subject(self, event: TouchEvent) -> str:
        return f"{ROOT}.{self.session}.{event.surface.value}.{event.type.value}"

    def _payload(self, event: TouchEvent) -> bytes:
        message = event_to_proto(event)
        data: bytes = to_json(message).encode() if self._as_json else message.SerializeToString()
        return data


def _cancelling(event: TouchEvent) -> TouchEvent:
    """The CANCEL of an event's contact."""
    return replace(
        event, type=EventType.CANCEL, reason=CancelReason.DISCONNECTED, force_n=0.0, force_sigma_n=None, click_count=0, coalesced=()
    )
