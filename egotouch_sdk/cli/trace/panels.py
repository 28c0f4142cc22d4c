"""The trace in colour: what the parts of the screen show."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rich import box
from rich.table import Table
from rich.text import Text

from egotouch_sdk.cli.trace.entries import Entry, rounded
from egotouch_sdk.cli.trace.player import Step
from egotouch_sdk.engine import PointerSnapshot
from egotouch_sdk.gestures import DragState, ForceState, PressState
from egotouch_sdk.observation import FORCE_MAX_N, GateReason
from egotouch_sdk.state import PointerState
from egotouch_sdk.touch_event import EventType, TouchEvent

_BAR_CELLS = 10
_PARTS = " ▏▎▍▌▋▊▉█"
_DIM = "#7d8590"
_TRACK = "#21262d"

#: Colours by kind of event: what is lost is red, touches are green, their meaning is bright, what comes with every frame is grey.
STYLES = {
    EventType.HOVER_ENTER: "#79c0ff",
    EventType.HOVER_MOVE: _DIM,
    EventType.HOVER_EXIT: "#79c0ff",
    EventType.DOWN: "bold #56d364",
    EventType.MOVE: _DIM,
    EventType.UP: "#56d364",
    EventType.CANCEL: "bold #ff7b72",
    EventType.CLICK: "bold #39c5cf",
    EventType.DOUBLE_CLICK: "bold #39c5cf",
    EventType.LONG_CLICK: "bold #39c5cf",
    EventType.DRAG_START: "bold #e3b341",
    EventType.DRAG: _DIM,
    EventType.DRAG_END: "#e3b341",
    EventType.FORCE_ENTER: "bold #d2a8ff",
    EventType.FORCE_CHANGE: _DIM,
    EventType.FORCE_EXIT: "#d2a8ff",
    EventType.FLING: "bold #ffa657",
}
#: Counted in the headline, with the words shown there.
_COUNTED = {
    EventType.DOWN: "down",
    EventType.UP: "up",
    EventType.CANCEL: "cancel",
    EventType.CLICK: "click",
    EventType.DOUBLE_CLICK: "double",
    EventType.LONG_CLICK: "long",
    EventType.DRAG_START: "drag",
    EventType.FORCE_ENTER: "force",
    EventType.FLING: "fling",
}


def bar(share: float, style: str, cells: int = _BAR_CELLS) -> Text:
    """A bar of `cells` characters on a dark track, filled in eighths of a character up to `share` 0..1."""
    eighths = round(min(max(share, 0.0), 1.0) * cells * 8)
    full, part = divmod(eighths, 8)
    return Text(("█" * full + (_PARTS[part] if part else "")).ljust(cells), f"{style} on {_TRACK}")


def log_header(wide: bool) -> str:
    """Above the log's columns."""
    if not wide:
        return f"{'time s':>8}  {'#':>3}  {'finger':<8}  {'event':<12}  {'x':>6} {'y mm':>7}   cause"
    return f"{'time s':>8}  {'#':>3}  {'finger':<12}  {'event':<12}  {'state':<34}  {'surface':<13} {'x':>6} {'y mm':>7}   cause"


def entry_text(entry: Entry, wide: bool) -> Text:
    """One line of the log; a narrow one leaves out state and surface."""
    event = entry.event
    change = entry.after if entry.before == entry.after else f"{entry.before} → {entry.after}"
    return Text.assemble(
        (f"{entry.elapsed_ns / 1e9:8.3f}  ", _DIM),
        (f"{event.pointer_id:>3}  ", "bold"),
        f"{event.hand.value} {event.finger.value}".ljust(14) if wide else _short(event).ljust(10),
        (f"{event.type.value.upper():<12}  ", STYLES[event.type]),
        (f"{change:<34}  " if wide else "", _DIM),
        f"{event.surface.value:<13} " if wide else "",
        f"{rounded(event.x_mm):>6} {rounded(event.y_mm):>7}   ",
        (entry.cause, STYLES[EventType.CANCEL] if event.reason else ""),
    )


def pointer_table(pointers: Sequence[PointerSnapshot], timestamp_ns: int, wide: bool) -> Table:
    """All open pointers after a frame; a narrow one leaves out gestures, the bar and the time since the DOWN."""
    padding = (0, 2 if wide else 1, 0, 0)
    table = Table(box=box.SIMPLE_HEAD, expand=True, padding=padding, show_edge=False, header_style=_DIM, border_style=_TRACK)
    for name in _WIDE if wide else _NARROW:
        table.add_column(name, justify="right" if name in _NUMBERS else "left", no_wrap=True)
    for pointer in pointers:
        cells = _cells(pointer, timestamp_ns, wide)
        table.add_row(*(cells[name] for name in (_WIDE if wide else _NARROW)))
    if not pointers:
        table.add_row("", Text("no pointer", style=_DIM))
    return table


_WIDE = ("#", "state", "gesture", "finger", "surface", "x mm", "y mm", "force", "p", "pitch", "yaw", "down")
_NARROW = ("#", "state", "finger", "surface", "x mm", "y mm", "force", "p", "pitch", "yaw")
_NUMBERS = frozenset({"#", "x mm", "y mm", "p", "pitch", "yaw", "down"})


def _cells(pointer: PointerSnapshot, timestamp_ns: int, wide: bool) -> dict[str, Text]:
    event = pointer.last_event
    touching = pointer.touch is PointerState.TOUCH
    down_ms = 0.0 if event.down_time_ns is None else (timestamp_ns - event.down_time_ns) / 1e6
    unseen = f" unseen {pointer.unseen_frames}" if pointer.unseen_frames else ""
    force_style = "#d2a8ff" if pointer.gestures.force is ForceState.HARD else "#56d364"
    return {
        "#": Text(str(pointer.pointer_id), "bold"),
        "state": Text.assemble(
            (f"● {pointer.touch.value}" if touching else f"○ {pointer.touch.value}", _state_style(touching)), (unseen, "#ff7b72")
        ),
        "gesture": Text(_gesture(pointer), "#e3b341"),
        "finger": Text(f"{event.hand.value} {event.finger.value}" if wide else _short(event)),
        "surface": Text(event.surface.value),
        "x mm": Text(rounded(event.x_mm)),
        "y mm": Text(rounded(event.y_mm)),
        "force": Text.assemble(bar(event.force_n / FORCE_MAX_N, force_style) if wide else "", (f" {event.force_n:.2f} N", force_style)),
        "p": Text(f"{event.touch_probability:.2f}"),
        "pitch": Text(f"{event.pitch_deg:.0f}°"),
        "yaw": Text(f"{event.yaw_deg:.0f}°"),
        "down": Text(f"{down_ms:.0f} ms" if touching else ""),
    }


def _short(event: TouchEvent) -> str:
    return f"{event.hand.value[0].upper()} {event.finger.value}"


def _state_style(touching: bool) -> str:
    return "bold #56d364" if touching else "#79c0ff"


def _gesture(pointer: PointerSnapshot) -> str:
    states = pointer.gestures
    words = [
        "" if states.press in (PressState.NONE, PressState.SPENT) else states.press.value.replace("_", " "),
        states.drag.value if states.drag is DragState.DRAGGING else "",
        "hard" if states.force is ForceState.HARD else "",
    ]
    return ", ".join(word for word in words if word)


def status_text(step: Step | None, playing: str, fps: float | None, elapsed_s: float, frame_count: int | None, wide: bool) -> Text:
    """The headline: play state, time, rate, gate and hands; a narrow one leaves out frames and the time they take."""
    if step is None:
        return Text(f"{playing}   waiting for the first frame", _DIM)
    frames = f"   frame {step.index + 1}{f'/{frame_count}' if frame_count else ''}" if wide else ""
    work = f"   {step.total_ms:.1f} ms a frame" if step.total_ms and wide else ""
    hands = ", ".join(f"{side.value} {role}" for side, role in step.hands) or "no hands"
    gate_style = "bold #56d364" if step.gate is GateReason.OPEN else "bold #e3b341"
    return Text.assemble(
        (f"{playing} {elapsed_s:8.3f} s{frames}   {fps or 0.0:5.1f} fps{work}   ", "bold"),
        ("gate ", _DIM),
        (step.gate.value.replace("_", " "), gate_style),
        f"   {hands}",
        no_wrap=True,
        overflow="ellipsis",
    )


def count_text(counts: Counter[EventType]) -> Text:
    """How often what has happened so far."""
    parts: list[tuple[str, str]] = []
    for event_type, word in _COUNTED.items():
        parts += [(f"{word} ", _DIM), (f"{counts[event_type]}  ", STYLES[event_type] if counts[event_type] else _DIM)]
    return Text.assemble(*parts, no_wrap=True, overflow="ellipsis")
