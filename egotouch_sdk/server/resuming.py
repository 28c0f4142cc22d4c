"""A client that comes back: what it holds, and whether all that it missed is still there."""

from __future__ import annotations

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.pointer_view import Pointer
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: More pointers than two hands have; a Resume that names more is malformed.
MAX_HELD = 64


def held_pointers(resume: pb.Resume) -> dict[int, Pointer]:
    """The pointers that are open at the client, by their id; raises `ProtocolError` for more than there can be."""
    if len(resume.held) > MAX_HELD:
        raise ProtocolError(f"a Resume holds {len(resume.held)} pointers", hint=f"Name at most {MAX_HELD}")
    return {held.pointer_id: _pointer(held) for held in resume.held}


def missed_batches(journal: Journal, resume: pb.Resume, held: dict[int, Pointer], now_ns: int) -> tuple[Batch, ...] | None:
    """What the client missed; None when it cannot go on, also because a contact it holds ended before what is remembered."""
    missed = journal.since(resume.epoch, resume.offset, now_ns)
    if missed is None:
        return None
    open_now = {event.pointer_id for event in journal.pointers}
    contacts_now = {(event.pointer_id, event.contact_id) for event in journal.contacts.values()}
    in_gap = {event.pointer_id for batch in missed for event in batch.events}
    for pointer_id, pointer in held.items():
        goes_on = (pointer_id, pointer.contact_id) in contacts_now if pointer.is_down else pointer_id in open_now
        if not goes_on and pointer_id not in in_gap:
            return None
    return missed


def _pointer(held: pb.HeldPointer) -> Pointer:
    return Pointer(held.contact_id, True, held.dragging, held.pressing) if held.contact_id else Pointer()
