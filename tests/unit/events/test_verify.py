from __future__ import annotations

from dataclasses import replace

import pytest

from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.events.order import RAW
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event

GOOD = ("hover_enter", "hover_move", "down", "move", "up", "down", "cancel", "hover_exit")


def stream(*types: str) -> list[TouchEvent]:
    """Events of pointer 1 with the right contact ids."""
    contact_id, down_ns, time_ns, events = 0, 0, 0, []
    for name in types:
        event_type = EventType(name)
        time_ns += event_type in RAW
        contact_id += event_type is EventType.DOWN
        down_ns = time_ns if event_type is EventType.DOWN else down_ns
        events.append(make_event(event_type, time_ns, contact_id=contact_id, down_time_ns=None if event_type.is_hover else down_ns))
    return events


def rules(events: list[TouchEvent]) -> list[str]:
    verifier = GrammarVerifier()
    verifier.feed(events)
    verifier.close()
    return [violation.rule for violation in verifier.violations]


def test_a_good_stream_passes() -> None:
    assert rules(stream(*GOOD)) == []


@pytest.mark.parametrize(
    ("types", "rule"),
    [
        (("down",), "begins with down"),
        (("hover_enter", "move"), "move after hover_enter"),
        (("hover_enter", "up"), "up after hover_enter"),
        (("hover_enter", "down", "down"), "down after down"),
        (("hover_enter", "down", "hover_move"), "hover_move after down"),
        (("hover_enter", "down", "hover_exit"), "hover_exit after down"),
        (("hover_enter", "down", "up", "move"), "move after up"),
        (("hover_enter", "down", "up", "cancel"), "cancel after up"),
        (("hover_enter", "down", "cancel", "up"), "up after cancel"),
        (("hover_enter", "hover_exit", "hover_move"), "begins with hover_move"),
        (("hover_enter", "hover_exit", "hover_enter"), "used again"),
        (("hover_enter", "down"), "left open after down"),
    ],
)
def test_a_broken_order_is_named(types: tuple[str, ...], rule: str) -> None:
    assert any(rule in found for found in rules(stream(*types)))


@pytest.mark.parametrize(
    ("position", "change", "rule"),
    [
        (3, {"timestamp_ns": 0}, "time goes back"),
        (1, {"force_n": 1.0}, "has a force"),
        (2, {"contact_id": 5}, "contact_id goes from 0 to 5"),
        (3, {"finger": Finger.RING}, "changes from right index to right ring"),
        (0, {"contact_id": 1}, "begins with contact_id 1"),
    ],
)
def test_a_broken_field_is_named(position: int, change: dict[str, object], rule: str) -> None:
    events = stream(*GOOD)
    events[position] = replace(events[position], **change)  # type: ignore[arg-type]
    assert any(rule in found for found in rules(events))


def test_two_pointers_for_one_finger_are_named() -> None:
    enter = stream("hover_enter")[0]
    assert any("already is pointer 1" in rule for rule in rules([enter, replace(enter, pointer_id=2)]))


def test_feed_returns_only_what_is_new() -> None:
    verifier = GrammarVerifier()
    broken = stream("hover_enter", "move", "up")
    assert [violation.event for violation in verifier.feed(broken[:2])] == [broken[1]]
    assert verifier.feed(broken[2:]) == ()
    assert len(verifier.violations) == 1
