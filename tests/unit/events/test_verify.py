from __future__ import annotations

from dataclasses import replace

import pytest

from egotouch_sdk.events import GrammarVerifier, verify_events
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.events import make_event

FRAME_NS = 33_000_000
GOOD = "hover_enter | hover_move | down | move | up | down | cancel | hover_exit"
#: Every kind of event: a hard drag with a fling, a long click, a double click, a hard drag that is cancelled.
FULL = """
    hover_enter | hover_move
    | down force_enter | move drag_start force_change | move drag | drag_end force_exit up fling | hover_move
    | down | move long_click | up click | hover_move | down | up click double_click
    | down | move drag_start force_enter | move drag force_exit | drag_end cancel hover_exit
"""


def stream(text: str) -> list[TouchEvent]:
    """Events of pointer 1: frames apart by "|", with the right contact ids, click counts, reasons and times."""
    contact_id, down_ns, events = 0, 0, []
    for number, frame in enumerate(text.split("|")):
        kinds = [EventType(name) for name in frame.split()]
        is_cancel, is_double = EventType.CANCEL in kinds, EventType.DOUBLE_CLICK in kinds
        for kind in kinds:
            time_ns = number * FRAME_NS
            if kind is EventType.DOWN:
                contact_id, down_ns = contact_id + 1, time_ns
            fields: dict[str, object] = {"contact_id": contact_id, "down_time_ns": None if kind.is_hover else down_ns}
            if kind is EventType.CLICK and is_double:
                fields["click_count"] = 2
            if is_cancel and kind in (EventType.CANCEL, EventType.DRAG_END, EventType.FORCE_EXIT):
                fields["reason"] = CancelReason.TRACKING_LOST
            events.append(make_event(kind, time_ns, **fields))
    return events


def rules(events: list[TouchEvent]) -> list[str]:
    return [violation.rule for violation in verify_events(events)]


def change(events: list[TouchEvent], kind: str, **fields: object) -> list[TouchEvent]:
    """The same events, the first of one kind with other fields."""
    index = next(index for index, event in enumerate(events) if event.type == kind)
    return [*events[:index], replace(events[index], **fields), *events[index + 1 :]]  # type: ignore[arg-type]


@pytest.mark.parametrize("text", [GOOD, FULL])
def test_a_good_stream_passes(text: str) -> None:
    assert rules(stream(text)) == []


def test_the_full_stream_has_every_kind_of_event() -> None:
    assert {event.type for event in stream(FULL)} == set(EventType)


def test_the_order_within_a_frame_is_fixed() -> None:
    """Swapping any two neighbours of one frame breaks a rule."""
    events = stream(FULL)
    for index in range(len(events) - 1):
        one, other = events[index : index + 2]
        if one.timestamp_ns == other.timestamp_ns:
            swapped = [*events[:index], other, one, *events[index + 2 :]]
            assert rules(swapped), f"{other.type} may come before {one.type}"


@pytest.mark.parametrize(
    "kind", ["hover_enter", "hover_exit", "down", "up", "cancel", "drag_start", "drag_end", "force_enter", "force_exit"]
)
def test_nothing_that_begins_or_ends_something_may_be_lost(kind: str) -> None:
    events = stream(FULL)
    for index, event in enumerate(events):
        if event.type == kind:
            assert rules(events[:index] + events[index + 1 :])


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("down", "begins with down"),
        ("hover_enter | move", "move after hover_enter"),
        ("hover_enter | up", "up after hover_enter"),
        ("hover_enter | down | down", "down after down"),
        ("hover_enter | down | hover_move", "hover_move after down"),
        ("hover_enter | down | hover_exit", "hover_exit after down"),
        ("hover_enter | down | up | move", "move after up"),
        ("hover_enter | down | up | cancel", "cancel after up"),
        ("hover_enter | down | cancel | up", "up after cancel"),
        ("hover_enter | down | cancel click", "click after cancel"),
        ("hover_enter | down click | up", "click after down"),
        ("hover_enter | hover_exit | hover_move", "begins with hover_move"),
        ("hover_enter | hover_exit | hover_enter", "used again"),
        ("hover_enter | down", "left open after down"),
        ("hover_enter | down drag_start", "drag_start after down"),
        ("hover_enter | down | drag_start", "drag_start comes 33.0 ms after the down before it"),
        ("hover_enter | down | move drag", "drag outside of a drag"),
        ("hover_enter | down | move drag_start | up", "up before drag_end"),
        ("hover_enter | down | drag_end up", "drag_end outside of a drag"),
        ("hover_enter | down | move drag_start | move drag_start", "second drag_start"),
        ("hover_enter | down | move drag_start | drag_end | up", "drag_end has another time or reason than the up"),
        ("hover_enter | down | move drag_start | drag_end | move", "move after drag_end"),
        ("hover_enter | down | move drag_start | move long_click", "long_click in a drag"),
        ("hover_enter | down | move drag_start | drag_end up click", "click after a drag"),
        ("hover_enter | down | move long_click | move long_click", "long_click for the second time"),
        ("hover_enter | down | up fling", "fling without a drag"),
        ("hover_enter | down force_enter | up", "up before force_exit"),
        ("hover_enter | down force_enter | move force_enter", "force_enter inside of a force press"),
        ("hover_enter | down | move force_change", "force_change outside of a force press"),
        ("hover_enter | down | move force_exit", "force_exit outside of a force press"),
        ("hover_enter | down force_enter | force_exit | move", "move comes between force_exit and the end"),
        ("hover_enter | down force_enter | force_exit | up", "force_exit has another time or reason than the up"),
        ("hover_enter | down | move force_enter drag_start", "drag_start after force_enter"),
        ("hover_enter | down force_enter long_click | force_exit up", "long_click is caused by down"),
        ("hover_enter | down | up click double_click", "no single click of the right index"),
        ("hover_enter | down | up click | down | cancel | down | up click double_click", "no single click of the right index"),
    ],
)
def test_a_broken_order_is_named(text: str, rule: str) -> None:
    found = rules(stream(text))
    assert any(rule in each for each in found), found
    assert all(each.startswith("pointer 1: ") for each in found)


@pytest.mark.parametrize(
    ("kind", "fields", "rule"),
    [
        ("move", {"timestamp_ns": 0}, "time goes back"),
        ("hover_move", {"force_n": 1.0}, "hover_move has a force of 1.0 N"),
        ("up", {"force_n": 1.0}, "up has a force of 1.0 N"),
        ("force_exit", {"force_n": 1.0}, "force_exit has a force of 1.0 N"),
        ("down", {"contact_id": 5}, "contact_id goes from 0 to 5"),
        ("move", {"finger": Finger.RING}, "changes from right index to right ring"),
        ("hover_enter", {"contact_id": 1}, "begins with contact_id 1"),
        ("move", {"down_time_ns": 5}, "move has down_time_ns 5, its down was at 66000000"),
        ("move", {"dx_mm": 1.0}, "move is (1.00, 0.00) mm from its down by its own account"),
        ("drag_start", {"x_mm": 1.0, "dx_mm": 1.0}, "drag_start is 1.0 mm away from the move of the same time"),
        ("move", {"x_mm": 130.0, "dx_mm": 130.0}, "move jumps 130 mm in 33.0 ms"),
        ("up", {"x_mm": 130.0, "dx_mm": 130.0}, "up jumps 130 mm in 33.0 ms"),
        ("click", {"click_count": 2}, "click 2 is followed by hover_move"),
        ("double_click", {"click_count": 1}, "double_click has click_count 1"),
        ("cancel", {"reason": CancelReason.SOURCE_ENDED}, "drag_end has another time or reason than the cancel"),
    ],
)
def test_a_broken_field_is_named(kind: str, fields: dict[str, object], rule: str) -> None:
    found = rules(change(stream(FULL), kind, **fields))
    assert any(rule in each for each in found), found


def test_a_reason_belongs_to_a_cancel() -> None:
    events = stream("hover_enter | down force_enter | move force_exit | up | hover_exit")
    assert rules(events) == []
    found = rules(change(events, "force_exit", reason=CancelReason.TRACKING_LOST))
    assert found == ["pointer 1: force_exit has another time or reason than the up after it"]


def test_any_speed_may_be_allowed() -> None:
    events = change(stream(GOOD), "up", x_mm=500.0, dx_mm=500.0)
    assert len(verify_events(events)) == 1
    assert verify_events(events, max_speed_mm_s=None) == ()


def test_coordinates_may_have_travelled_as_32_bit_floats() -> None:
    assert rules(change(stream(GOOD), "move", x_mm=0.123456, dx_mm=0.123450)) == []


def test_two_pointers_for_one_finger_are_named() -> None:
    enter = stream("hover_enter")[0]
    assert any("already is pointer 1" in rule for rule in rules([enter, replace(enter, pointer_id=2)]))


def test_pointers_are_checked_each_for_itself() -> None:
    events = stream(FULL)
    others = [replace(event, pointer_id=2, finger=Finger.THUMB) for event in events]
    assert rules([event for pair in zip(events, others, strict=True) for event in pair]) == []


def test_feed_returns_only_what_is_new() -> None:
    verifier = GrammarVerifier()
    broken = stream("hover_enter | move | up")
    assert {violation.event for violation in verifier.feed(broken[:2])} == {broken[1]}
    before = len(verifier.violations)
    assert len(verifier.feed(broken[2:])) == len(verifier.violations) - before
