"""A frame's events as the message that goes to a client."""

from __future__ import annotations

from egotouch_sdk.server.batch import Batch, Encoded
from egotouch_sdk.server.limits import MILLISECOND_NS
from egotouch_sdk.server.pointer_view import Shown
from egotouch_sdk.server.subprotocol import Subprotocol
from egotouch_sdk.touch_event import TouchEvent
from egotouch_sdk.wire import event_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: A message that is older when it is sent is made anew, so that `sent_ns` is true to this.
SHARED_NS = 2 * MILLISECOND_NS


def batch_message(batch: Batch, shown: Shown, offset: int, now_ns: int, subprotocol: Subprotocol, *, latest_only: bool) -> bytes | str:
    """What of a batch is shown to a client, as one message; clients that are shown the same share it.

    `latest_only` leaves out what was merged into an event.
    """
    late, events = shown
    key = (subprotocol.name, latest_only, late, offset, tuple(map(id, events)))
    shared = batch.encoded.get(key)
    if shared is not None and now_ns - shared.sent_ns <= SHARED_NS:
        return shared.data
    content = pb.EventBatch(
        frame_index=batch.frame_index,
        timestamp_ns=batch.timestamp_ns,
        sent_ns=now_ns,
        events=[_message(event, latest_only) for event in events],
        late=late,
    )
    data = subprotocol.encode(pb.ServerMessage(offset=offset, batch=content))
    batch.encoded[key] = Encoded(now_ns, events, data)
    return data


def _message(event: TouchEvent, latest_only: bool) -> pb.TouchEvent:
    message = event_to_proto(event)
    if latest_only:
        del message.coalesced[:]
    return message
