"""The live trace, driven by its keys without a terminal."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest
from textual.pilot import Pilot
from textual.widgets import RichLog, Static

from egotouch_sdk.cli.trace.app import TraceApp
from egotouch_sdk.cli.trace.entries import Trace
from egotouch_sdk.cli.trace.player import Player
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.errors import SourceError
from egotouch_sdk.touch_event import EventType
from tests.unit.cli.trace.conftest import HandFedSource

HOVER_ENTER, HOVER_EXIT, DOWN, UP, CANCEL = (
    EventType.HOVER_ENTER,
    EventType.HOVER_EXIT,
    EventType.DOWN,
    EventType.UP,
    EventType.CANCEL,
)


def app_of(source: HandFedSource, log_file: Path = Path("unused.txt")) -> TraceApp:
    engine = EventEngine(TouchConfig(debug=True))
    player = Player(source, engine, engine, paced=False)
    return TraceApp("fed", player, Trace(engine.thresholds, engine.config.gestures), log_file=log_file)


def drive(app: TraceApp, steps: Callable[[Pilot[int]], Awaitable[None]], columns: int = 140) -> int | None:
    """Run the app on a screen of 40 lines and let `steps` press its keys; gives what it returned."""

    async def run() -> None:
        async with app.run_test(size=(columns, 40)) as pilot:
            await steps(pilot)

    asyncio.run(run())
    return app.return_value


async def until(pilot: Pilot[int], condition: Callable[[], bool]) -> None:
    """Let the app go on until something is so."""
    async with asyncio.timeout(60.0):
        while not condition():
            await pilot.pause(0.01)


def edges(app: TraceApp) -> list[EventType]:
    return [entry.event.type for entry in app.entries if entry.event.type.is_edge]


def shown(app: TraceApp, selector: str) -> str:
    """The text of one part of the screen."""
    part = app.query_one(selector, Static)
    lines = part.render_lines(part.region.reset_offset)
    return "\n".join(strip.text for strip in lines)


def log_lines(app: TraceApp) -> list[str]:
    return [strip.text.rstrip() for strip in app.query_one("#log", RichLog).lines]


def test_pointers_events_and_counts_are_shown(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.touch()
        await until(pilot, lambda: DOWN in edges(app) and len(app.entries) >= 9)
        await until(pilot, lambda: "2.00 N" in shown(app, "#pointers"))
        row = shown(app, "#pointers")
        assert all(words in row for words in ("● touch", "held, hard", "right index", "palm", "40.0", "45°"))
        assert "gate open" in shown(app, "#status")
        assert "right touching, left host" in shown(app, "#status")
        source.hover()
        await until(pilot, lambda: UP in edges(app))
        await until(pilot, lambda: "down 1  up 1  cancel 0  click 1" in shown(app, "#counts"))
        source.end()
        await until(pilot, lambda: "■ ended" in shown(app, "#status"))
        assert "no pointer" in shown(app, "#pointers")

    drive(app, steps)
    assert edges(app) == [HOVER_ENTER, DOWN, EventType.FORCE_ENTER, EventType.FORCE_EXIT, UP, EventType.CLICK, HOVER_EXIT]


def test_f_shows_and_hides_what_comes_with_every_frame(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.touch()
        source.end()
        await until(pilot, lambda: edges(app)[-1:] == [HOVER_EXIT])
        await pilot.pause()
        assert not any("MOVE" in line for line in log_lines(app))
        assert len(log_lines(app)) == len(edges(app))
        await pilot.press("f")
        await until(pilot, lambda: len(log_lines(app)) == len(app.entries))
        assert any("HOVER_MOVE" in line for line in log_lines(app))
        await pilot.press("f")
        await until(pilot, lambda: len(log_lines(app)) == len(edges(app)))

    drive(app, steps)


def test_space_holds_a_source_and_lets_it_go_on(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        await until(pilot, lambda: edges(app) == [HOVER_ENTER])
        await pilot.press("space")
        await until(pilot, lambda: "paused" in shown(app, "#status"))
        source.touch()
        source.end()
        app.refresh_trace()
        assert edges(app) == [HOVER_ENTER]
        assert not app._player.ended.is_set()
        await pilot.press("space")
        await until(pilot, lambda: HOVER_EXIT in edges(app))
        assert edges(app)[:2] == [HOVER_ENTER, DOWN]

    drive(app, steps)


def test_a_live_source_goes_on_behind_a_paused_screen_and_nothing_is_lost(live_source: HandFedSource) -> None:
    app = app_of(live_source)

    async def steps(pilot: Pilot[int]) -> None:
        await pilot.press("space")
        live_source.hover()
        live_source.touch()
        live_source.end()
        await until(pilot, app._player.ended.is_set)
        app.refresh_trace()
        assert not app.entries
        await pilot.press("space")
        await until(pilot, lambda: HOVER_EXIT in edges(app))

    drive(app, steps)
    assert edges(app)[0] is HOVER_ENTER
    assert [entry.cause for entry in app.entries if entry.event.type is CANCEL] == ["source_ended"]


def test_s_saves_every_event_as_a_line(source: HandFedSource, tmp_path: Path) -> None:
    app = app_of(source, tmp_path / "log.txt")

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.end()
        await until(pilot, lambda: edges(app)[-1:] == [HOVER_EXIT])
        await pilot.press("s")
        await until(pilot, (tmp_path / "log.txt").exists)

    drive(app, steps)
    header, *lines = (tmp_path / "log.txt").read_text(encoding="utf-8").splitlines()
    assert header.split()[:2] == ["time", "s"]
    assert len(lines) == len(app.entries)
    assert lines[0].split()[4:9] == ["absent", "->", "HOVER_ENTER", "->", "hover"]


def test_a_log_that_cannot_be_written_is_said(source: HandFedSource, tmp_path: Path) -> None:
    app = app_of(source, tmp_path)

    async def steps(pilot: Pilot[int]) -> None:
        source.end()
        await pilot.press("s")
        await until(pilot, lambda: any("cannot write" in note.message for note in app._notifications))

    drive(app, steps)


@pytest.mark.parametrize(("key", "code"), [("q", 0), ("ctrl+c", 130)])
def test_keys_that_leave(source: HandFedSource, key: str, code: int) -> None:
    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.end()
        await pilot.press(key)

    assert drive(app_of(source), steps) == code


def test_a_source_that_fails_ends_the_app_with_its_error(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.end(SourceError("unplugged"))
        await until(pilot, lambda: app.return_value is not None)

    assert drive(app, steps) == 1
    assert str(app._player.error) == "unplugged"


def test_leaving_a_live_source_does_not_wait_for_its_next_picture(live_source: HandFedSource) -> None:
    app = app_of(live_source)

    async def steps(pilot: Pilot[int]) -> None:
        live_source.hover()
        await until(pilot, lambda: edges(app) == [HOVER_ENTER])
        await pilot.press("q")

    assert drive(app, steps) == 0
    assert not app._player.is_running


def test_on_80_columns_nothing_is_cut_off(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.touch()
        await until(pilot, lambda: "2.00 N" in shown(app, "#pointers"))
        assert all(words in shown(app, "#pointers") for words in ("● touch", "R index", "palm", "40.0", "0.98", "45°"))
        for part in ("#status", "#counts", "#pointers"):
            assert "…" not in shown(app, part)
        source.end()
        await until(pilot, lambda: HOVER_EXIT in edges(app))
        await until(pilot, lambda: any("source_ended" in line for line in log_lines(app)))
        assert max(len(line) for line in log_lines(app)) <= 75

    drive(app, steps, columns=80)


def test_a_wider_screen_shows_more(source: HandFedSource) -> None:
    app = app_of(source)

    async def steps(pilot: Pilot[int]) -> None:
        source.hover()
        source.end()
        await until(pilot, lambda: HOVER_EXIT in edges(app))
        assert not any("absent" in line for line in log_lines(app))
        await pilot.resize_terminal(140, 40)
        await until(pilot, lambda: any("absent → hover" in line for line in log_lines(app)))

    drive(app, steps, columns=80)
