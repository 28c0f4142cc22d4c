"""Two stream events into one, for consumers that are slower than the camera."""

from __future__ import annotations

from dataclasses import replace

from egotouch_sdk.errors import FrameError
from egotouch_sdk.touch_event import TouchEvent

#: Older events that a merged one keeps: a quarter of a second at 30 fps (our choice).
MAX_COALESCED = 8


def merge(older: TouchEvent, newer: TouchEvent) -> TouchEvent:
    """`newer` with `older` and its history in `coalesced`, oldest first; of more than 8 the oldest are forgotten.

    Events in the history have none of their own. Raises `FrameError` for edges, and for events of different type, pointer or contact.
    """
    if newer.type.is_edge or (older.type, older.pointer_id, older.contact_id) != (newer.type, newer.pointer_id, newer.contact_id):
        raise FrameError(
            f"{older.type} of pointer {older.pointer_id} and {newer.type} of pointer {newer.pointer_id} cannot be merged",
            hint="Merge only stream events of one type, pointer and contact",
        )
    last = replace(older, coalesced=()) if older.coalesced else older
    return replace(newer, coalesced=(*older.coalesced, last, *newer.coalesced)[-MAX_COALESCED:])
