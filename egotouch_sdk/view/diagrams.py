"""Draws the state machines from their tables and copies the timing cases from their modules into `events/EVENTS.md`.

    python -m egotouch_sdk.view.diagrams            say whether the page is current
    python -m egotouch_sdk.view.diagrams --write    bring it up to date
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from types import ModuleType
from typing import TypeVar

from egotouch_sdk.gestures import DragState, ForceState, PressState
from egotouch_sdk.gestures import recognizer as gestures
from egotouch_sdk.gestures.table import DRAG, FORCE, PRESS
from egotouch_sdk.state import PointerState
from egotouch_sdk.state import machine as touch
from egotouch_sdk.state.table import TABLE
from egotouch_sdk.touch_event import EventType

State = TypeVar("State", bound=StrEnum)
Input = TypeVar("Input", bound=StrEnum)

PAGE = Path(__file__).parent.parent / "events" / "EVENTS.md"
#: Inputs beyond this many are written on a second line of an arrow.
INPUTS_PER_LINE = 4


def mermaid(table: Mapping[tuple[State, Input], tuple[State, tuple[EventType, ...]]], first: State, *, is_outside: bool) -> str:
    """A Mermaid state diagram of a table: one arrow for each way between two states, "inputs / events" on it.

    `first` is where everything begins; `is_outside` draws it as the black dot rather than as a state.
    """
    arrows: dict[tuple[State, State, tuple[EventType, ...]], list[str]] = {}
    for (state, cause), (after, events) in table.items():
        arrows.setdefault((state, after, events), []).append(cause.value)
    lines = ["stateDiagram-v2"] if is_outside else ["stateDiagram-v2", f"    [*] --> {first.value}"]
    for (state, after, events), causes in arrows.items():
        ends = ["[*]" if is_outside and end is first else end.value for end in (state, after)]
        rows = [", ".join(causes[start : start + INPUTS_PER_LINE]) for start in range(0, len(causes), INPUTS_PER_LINE)]
        told = " + ".join(event.value for event in events) or "-"
        lines.append(f"    {ends[0]} --> {ends[1]}: {',<br>'.join(rows)} / {told}")
    return "\n".join(lines)


def timing_cases(module: ModuleType) -> str:
    """What a module's description says after its title: its timing cases, as they are written there."""
    return inspect.cleandoc(module.__doc__ or "").split("\n\n", 1)[1]


def blocks() -> dict[str, str]:
    """Every generated block of the page, by name."""
    return {
        "touch diagram": _fenced("mermaid", mermaid(TABLE, PointerState.ABSENT, is_outside=True)),
        "press diagram": _fenced("mermaid", mermaid(PRESS, PressState.NONE, is_outside=True)),
        "drag diagram": _fenced("mermaid", mermaid(DRAG, DragState.STILL, is_outside=False)),
        "force diagram": _fenced("mermaid", mermaid(FORCE, ForceState.SOFT, is_outside=False)),
        "touch timing": _fenced("text", timing_cases(touch)),
        "gesture timing": _fenced("text", timing_cases(gestures)),
    }


def filled(page: str) -> str:
    """The page with every block as generated now; `KeyError` for a block that nothing generates."""
    generated = blocks()

    def fill(match: re.Match[str]) -> str:
        return f"<!-- generated: {match[1]} -->\n{generated[match[1]]}\n<!-- end -->"

    return re.sub(r"<!-- generated: ([a-z ]+) -->\n.*?<!-- end -->", fill, page, flags=re.DOTALL)


def _fenced(language: str, text: str) -> str:
    return f"```{language}\n{text}\n```"


def main(arguments: list[str]) -> int:
    """Check the page, or write it; exit code 1 when it is out of date."""
    page = PAGE.read_text(encoding="utf-8")
    current = filled(page)
    if "--write" in arguments:
        PAGE.write_text(current, encoding="utf-8")
    elif page != current:
        sys.stderr.write(f"{PAGE.name} is out of date: run python -m egotouch_sdk.view.diagrams --write\n")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
