"""The trace as plain lines, for pipes, files and continuous integration."""

from __future__ import annotations

from egotouch_sdk.cli.trace.entries import Entry, rounded


def _columns(time: str, pointer: str, finger: str, change: str, surface: str, place: str, angles: str, cause: str) -> str:
    return f"{time:>8}  {pointer:>3}  {finger:<12}  {change:<48}  {surface:<13}  {place:<14}  {angles:<9}  {cause}".rstrip()


HEADER = _columns("time s", "#", "finger", "state -> EVENT -> state", "surface", "x, y mm", "pitch yaw", "cause")


def plain_line(entry: Entry) -> str:
    """One entry: time since the first frame, pointer, state -> EVENT -> state, place, angles in degrees and cause."""
    event = entry.event
    return _columns(
        f"{entry.elapsed_ns / 1e9:.3f}",
        str(event.pointer_id),
        f"{event.hand.value} {event.finger.value}",
        f"{entry.before} -> {event.type.value.upper()} -> {entry.after}",
        event.surface.value,
        f"{rounded(event.x_mm)}, {rounded(event.y_mm)}",
        f"{event.pitch_deg:5.0f} {event.yaw_deg:3.0f}",
        entry.cause,
    )
