from __future__ import annotations

import re

import pytest

from egotouch_sdk.listeners import TouchListener
from egotouch_sdk.state import PointerState
from egotouch_sdk.state.table import TABLE
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.view import diagrams

PAGE = diagrams.PAGE.read_text(encoding="utf-8")


def test_the_page_is_current() -> None:
    assert diagrams.filled(PAGE) == PAGE, "run python -m egotouch_sdk.view.diagrams --write"


def test_every_block_is_on_the_page() -> None:
    assert set(re.findall(r"<!-- generated: ([a-z ]+) -->", PAGE)) == set(diagrams.blocks())


def test_a_block_that_is_out_of_date_is_replaced() -> None:
    assert diagrams.filled(PAGE.replace("--> touch", "--> elsewhere")) == PAGE


def test_a_block_that_nothing_generates_is_refused() -> None:
    with pytest.raises(KeyError, match="weather"):
        diagrams.filled("<!-- generated: weather -->\n<!-- end -->")


def test_every_transition_is_on_an_arrow() -> None:
    diagram = diagrams.mermaid(TABLE, PointerState.ABSENT, is_outside=True)
    inputs = sum(len(re.split(r",\s*(?:<br>)?", line.split(": ")[1].split(" / ")[0])) for line in diagram.splitlines() if ": " in line)
    assert inputs == len(TABLE)
    assert "    hover --> touch: contact / down" in diagram
    assert "    touch --> [*]: lost, swapped, stalled, ended / cancel + hover_exit" in diagram


def test_the_table_of_events_is_true() -> None:
    rows = dict(re.findall(r"^\| `(\w+)` \| `(\w+)` \|", PAGE, re.MULTILINE))
    merged = dict(re.findall(r"^\| `(\w+)` .* \| (yes|never) \|$", PAGE, re.MULTILINE))
    assert set(rows) == set(EventType)
    assert all(hasattr(TouchListener, listener) for listener in rows.values())
    assert merged == {kind.value: "never" if kind.is_edge else "yes" for kind in EventType}
