"""The live trace in the terminal."""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import Any, ClassVar, Final

from textual.app import App, ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Vertical
from textual.widgets import Footer, RichLog, Static

from egotouch_sdk.cli.trace.entries import Entry, Trace
from egotouch_sdk.cli.trace.lines import HEADER, plain_line
from egotouch_sdk.cli.trace.panels import count_text, entry_text, log_header, pointer_table, status_text
from egotouch_sdk.cli.trace.player import Player, Step

#: The screen is drawn again this often; events are never lost in between.
REFRESH_HZ: Final = 20.0
#: A screen of so many columns has room for everything.
WIDE_FROM: Final = 130
#: So many entries are kept for saving and for showing the moves again.
MAX_ENTRIES: Final = 20_000
#: The rate shown is measured over so many frames.
FPS_FRAMES: Final = 30
#: A short clip may end before the screen has its log and keys: then its picture waits this long and looks again.
LAYOUT_S: Final = 0.05

MOVES_HIDDEN: Final = "moves hidden, f shows them"


class TraceApp(App[int]):
    """Pointers and events of a source that a `Player` plays; the return value is the exit code."""

    TITLE = "egotouch debug-events"
    ENABLE_COMMAND_PALETTE = False
    CSS = """
    Screen { background: #0d1117; color: #e6edf3; }
    #status, #counts { height: 1; padding: 0 2; background: #161b22; }
    #pointers { height: auto; min-height: 6; max-height: 16; border: round #30363d; border-title-color: #79c0ff; padding: 0 1; }
    #events { height: 1fr; border: round #30363d; border-title-color: #79c0ff; border-subtitle-color: #7d8590; padding: 0 1; }
    #head { height: 1; color: #7d8590; }
    #log, #log:focus { background: #0d1117; background-tint: #0d1117 0%; scrollbar-size: 1 1; scrollbar-background: #0d1117;
                       scrollbar-color: #30363d; }
    Footer { background: #161b22; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        ("space", "pause", "Pause"),
        ("f", "moves", "Moves on/off"),
        ("s", "save", "Save log"),
        ("q", "quit_with(0)", "Quit"),
        Binding("ctrl+c", "quit_with(130)", show=False, priority=True),
    ]

    def __init__(
        self,
        source_name: str,
        player: Player,
        trace: Trace,
        *,
        frame_count: int | None = None,
        log_file: Path,
        screenshot_file: Path | None = None,
    ) -> None:
        super().__init__()
        self.entries: deque[Entry] = deque(maxlen=MAX_ENTRIES)
        self.shows_moves = False
        self.is_paused = False
        self._source_name = source_name
        self._player = player
        self._trace = trace
        self._frame_count = frame_count
        self._log_file = log_file
        self._screenshot_file = screenshot_file
        self._start_ns: int | None = None
        self._step: Step | None = None
        self._times_ns: deque[int] = deque(maxlen=FPS_FRAMES)

    def compose(self) -> ComposeResult:
        """Headline, counts, pointers, log and keys, from top to bottom."""
        yield Static(id="status")
        yield Static(id="counts")
        yield Static(id="pointers")
        with Vertical(id="events"):
            yield Static(id="head", markup=False)
            yield RichLog(id="log", max_lines=MAX_ENTRIES)
        yield Footer(show_command_palette=False)

    def on_mount(self) -> None:
        """Begin to play."""
        self.query_one("#pointers").border_title = "Pointers"
        events = self.query_one("#events")
        events.border_title, events.border_subtitle = f"Events of {self._source_name}", MOVES_HIDDEN
        self._player.start()
        self.set_interval(1.0 / REFRESH_HZ, self.refresh_trace)

    def refresh_trace(self) -> None:
        """Show what has happened since the last time."""
        if len(self.query("#status, #counts, #pointers, #log")) < 4:  # the screen is being taken down
            return
        ended = self._player.ended.is_set() or self._player.held.is_set()
        if not self.is_paused:
            for step in self._player.take():
                self._note(step)
            for event in self._player.take_last_events():
                self._write(self._trace.note(event, self._start_ns or event.timestamp_ns))
        self._draw()
        if self._player.error:
            self.exit(1)
        elif ended and self._screenshot_file:
            screenshot, self._screenshot_file = self._screenshot_file, None
            self.call_after_refresh(self._save_screenshot, screenshot)

    def action_pause(self) -> None:
        """Hold the source, or, where it is live, only the screen."""
        self.is_paused = not self.is_paused
        self._player.pause(self.is_paused)
        self._draw()

    def action_moves(self) -> None:
        """Show or hide what comes with every frame."""
        self.shows_moves = not self.shows_moves
        self.query_one("#events").border_subtitle = "" if self.shows_moves else MOVES_HIDDEN
        self._rewrite()

    def action_save(self) -> None:
        """Write every entry, moves too, as plain lines."""
        lines = [HEADER, *map(plain_line, self.entries)]
        try:
            self._log_file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        except OSError as error:
            self.notify(f"cannot write {self._log_file} ({error.strerror})", severity="error")
            return
        self.notify(f"{len(self.entries)} events saved to {self._log_file}")

    def on_resize(self) -> None:
        """Show what fits."""
        self.call_after_refresh(self._rewrite)

    def action_quit_with(self, code: int) -> None:
        """Leave."""
        self.exit(code)

    def on_unmount(self) -> None:
        """Stop playing."""
        self._player.stop()

    def _note(self, step: Step) -> None:
        self._start_ns = step.timestamp_ns if self._start_ns is None else self._start_ns
        self._step = step
        self._times_ns.append(step.timestamp_ns)
        for event in step.events:
            self._write(self._trace.note(event, self._start_ns))

    def _write(self, entry: Entry) -> None:
        self.entries.append(entry)
        self._show(entry)

    def _rewrite(self) -> None:
        self.query_one("#head", Static).update(log_header(self._is_wide))
        self.query_one("#log", RichLog).clear()
        for entry in self.entries:
            self._show(entry)

    @property
    def _is_wide(self) -> bool:
        return self.size.width >= WIDE_FROM

    def _show(self, entry: Entry) -> None:
        if self.shows_moves or entry.event.type.is_edge:
            line = entry_text(entry, self._is_wide)
            self.query_one("#log", RichLog).write(line, width=line.cell_len)

    def _draw(self) -> None:
        step = self._step
        has_ended = self._player.ended.is_set() and not self.is_paused
        playing = "⏸ paused " if self.is_paused else "■ ended  " if has_ended else "▶ playing"
        elapsed_s = (step.timestamp_ns - self._start_ns) / 1e9 if step and self._start_ns is not None else 0.0
        pointers = () if step is None or has_ended else step.pointers
        self._update("#status", status_text(step, playing, self._fps(), elapsed_s, self._frame_count, self._is_wide))
        self._update("#counts", count_text(self._trace.counts))
        self._update("#pointers", pointer_table(pointers, step.timestamp_ns if step else 0, self._is_wide))

    def _update(self, selector: str, content: Any) -> None:
        self.query_one(selector, Static).update(content)

    def _fps(self) -> float | None:
        if len(self._times_ns) < 2:
            return None
        return (len(self._times_ns) - 1) * 1e9 / (self._times_ns[-1] - self._times_ns[0])

    def _save_screenshot(self, path: Path) -> None:
        if not (self.query_one("#log").size.width and self.query("FooterKey")):
            self.set_timer(LAYOUT_S, lambda: self.call_after_refresh(self._save_screenshot, path))
            return
        path.write_text(self.export_screenshot(title=f"egotouch debug-events {self._source_name}"), encoding="utf-8")
        self.exit(0)
