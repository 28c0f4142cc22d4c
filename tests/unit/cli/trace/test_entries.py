"""Every event of the trace says what state it leads from and to, and why."""

from __future__ import annotations

import pytest

from egotouch_sdk.cli.trace.entries import Entry, Trace, rounded
from egotouch_sdk.cli.trace.lines import HEADER, plain_line
from egotouch_sdk.config import GestureConfig, TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.simulator import ScriptSource, shipped_script, shipped_scripts
from egotouch_sdk.state import Thresholds
from egotouch_sdk.touch_event import EventType
from tests.support.events import make_event


def trace_of(name: str) -> tuple[list[Entry], Trace]:
    engine = EventEngine(TouchConfig(debug=True))
    trace = Trace(engine.thresholds, engine.config.gestures)
    entries = [trace.note(event, 0) for observation in ScriptSource(shipped_script(name)) for event in engine.process(observation).events]
    return entries + [trace.note(event, 0) for event in engine.finish(10**12)], trace


@pytest.mark.parametrize("name", shipped_scripts())
def test_each_pointer_goes_on_where_it_was_and_ends_absent(name: str) -> None:
    entries, trace = trace_of(name)
    for pointer_id in {entry.event.pointer_id for entry in entries}:
        own = [entry for entry in entries if entry.event.pointer_id == pointer_id]
        assert own[0].before == own[-1].after == "absent"
        assert [entry.before for entry in own[1:]] == [entry.after for entry in own[:-1]]
        contacts = [entry for entry in own if entry.event.down_time_ns is not None]
        assert all(entry.before.startswith(("touch", "hover")) for entry in contacts)
    assert sum(trace.counts.values()) == len(entries)


def test_a_hard_long_press_in_words() -> None:
    entries, _ = trace_of("taps")
    long = next(entry for entry in entries if entry.event.type is EventType.LONG_CLICK)
    assert (long.before, long.after) == ("touch+force", "touch+force+long")
    down = next(entry for entry in entries if entry.event.type is EventType.DOWN)
    assert (down.before, down.after) == ("hover", "touch")
    assert down.cause.endswith(">= 0.60")
    up = next(entry for entry in entries if entry.event.type is EventType.UP and entry.before == "touch+long")
    assert up.after == "hover"


def test_a_cancel_gives_its_reason() -> None:
    entries, _ = trace_of("faults")
    causes = [entry.cause for entry in entries if entry.event.type is EventType.CANCEL]
    assert causes == ["tracking_lost", "hand_swapped", "source_stalled"]


def test_a_line_stands_under_its_header() -> None:
    trace = Trace(Thresholds(0.6, 0.4), GestureConfig())
    trace.note(make_event(EventType.HOVER_ENTER, 0), 0)
    line = plain_line(trace.note(make_event(EventType.DOWN, 1_500_000_000, x_mm=-0.01), 0))
    assert " ".join(line.split()) == "1.500 1 right index hover -> DOWN -> touch palm 0.0, 50.0 40 0 p 0.90 >= 0.60"
    for name, word in (("finger", "right"), ("state", "hover"), ("surface", "palm"), ("x, y", "0.0"), ("cause", "p 0.9")):
        assert line.index(word) == HEADER.index(name)


def test_no_minus_before_zero() -> None:
    assert [rounded(value) for value in (-0.04, 0.04, -0.06)] == ["0.0", "0.0", "-0.1"]
