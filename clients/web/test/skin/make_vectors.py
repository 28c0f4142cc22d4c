"""Writes vectors.json: what the Python package's skin views do with random fingers, for the web's to do the same.

python clients/web/test/skin/make_vectors.py
"""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.skin import SkinKeypad, SkinLayout, SkinViewGroup, layout_to_dict
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

VECTORS = Path(__file__).with_name("vectors.json")
CALLS = ("onHoverEnter", "onHoverMove", "onHoverExit", "onTouchDown", "onTouchMove", "onTouchUp", "onTouchCancel",
         "onDragStart", "onDrag", "onDragEnd", "onForce", "onClick")  # fmt: skip
_RARE = (EventType.CANCEL, EventType.LONG_CLICK, EventType.DRAG_START, EventType.FORCE_CHANGE)
_IN_CONTACT = (EventType.MOVE,) * 8 + (EventType.UP,) * 4 + _RARE
_HOVERING = (EventType.HOVER_MOVE,) * 3 + (EventType.DOWN,) * 5 + (EventType.HOVER_EXIT,)
PROGRAMS, EVENTS = 12, 90


def phones() -> SkinLayout:
    """A phone's keypad on every surface of both limbs."""
    return SkinLayout(tuple(SkinKeypad.phone(f"{hand}-{surface}", surface, hand) for surface in Surface for hand in Handedness))


def vectors() -> dict[str, Any]:
    """Layout, places of all keys, and the calls that each program of events leads to."""
    layout = phones()
    random = Random("skin views")
    return {
        "layout": layout_to_dict(layout),
        "views": [{"name": view.name, "points_mm": [list(point) for point in view.region.points_mm]} for view in layout.views],
        "programs": [_program(layout, random) for _ in range(PROGRAMS)],
    }


def _program(layout: SkinLayout, random: Random) -> list[dict[str, Any]]:
    group, calls = SkinViewGroup(layout), list[str]()
    for view in layout.views:
        handle = group.view(view.name)
        for name in CALLS:
            getattr(handle, name)(lambda _, name=name, view=view: calls.append(f"{view.name} {name}"))
        handle.onLongClick(lambda _, view=view: calls.append(f"{view.name} onLongClick") or view.label == "0")
    steps: list[dict[str, Any]] = []
    open_pointers: dict[int, TouchEvent] = {}
    next_id = 1
    for time_ms in range(EVENTS):
        number = random.choice([*open_pointers, 0]) if len(open_pointers) < 3 else random.choice(list(open_pointers))
        last = open_pointers.get(number)
        pointer_id, next_id = (last.pointer_id, next_id) if last else (next_id, next_id + 1)
        event = _event(pointer_id, last, random, time_ms)
        calls.clear()
        group.handle(event)
        steps.append({**_plain(event), "calls": list(calls)})
        open_pointers[pointer_id] = event
        if event.type is EventType.HOVER_EXIT:
            del open_pointers[pointer_id]
    return steps


def _event(pointer_id: int, last: TouchEvent | None, random: Random, time_ms: int) -> TouchEvent:
    in_contact = last is not None and last.down_time_ns is not None and last.type not in (EventType.UP, EventType.CANCEL)
    event_type = EventType.HOVER_ENTER if last is None else random.choice(_IN_CONTACT if in_contact else _HOVERING)
    hand = last.hand if last else random.choice(list(Handedness))
    surface = last.surface if last and random.random() < 0.9 else random.choice([Surface.PALM, Surface.PALM, *Surface])
    moved = event_type in (EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.MOVE, EventType.UP)
    x_mm, y_mm = (last.x_mm, last.y_mm) if last and not moved else _place(last, surface, random)
    time_ns = time_ms * 1_000_000
    down_ns = None if event_type.is_hover else time_ns if event_type is EventType.DOWN else last.down_time_ns if last else None
    contact_id = (last.contact_id if last else 0) + (event_type is EventType.DOWN)
    force_n = 0.0 if event_type.is_hover or event_type in (EventType.UP, EventType.CANCEL) else round(random.uniform(0.2, 3.0), 2)
    return TouchEvent(
        type=event_type, pointer_id=pointer_id, contact_id=contact_id, timestamp_ns=time_ns, down_time_ns=down_ns, hand=hand,
        finger=list(Finger)[pointer_id % 5], surface=surface, touch_probability=0.9, force_n=force_n, x_mm=x_mm, y_mm=y_mm,
        pitch_rad=0.8, yaw_rad=0.0, image_x=0.5, image_y=0.5,
        reason=CancelReason.TRACKING_LOST if event_type is EventType.CANCEL else None,
    )  # fmt: skip


def _place(last: TouchEvent | None, surface: Surface, random: Random) -> tuple[float, float]:
    """Near the last place, or anywhere around the keypads; never on an outline, where either side is right."""
    if last and surface is last.surface and random.random() < 0.6:
        return round(last.x_mm + random.uniform(-9, 9), 2) + 0.001, round(last.y_mm + random.uniform(-9, 9), 2) + 0.001
    on_hand = surface in (Surface.PALM, Surface.BACK_OF_HAND)
    along = random.uniform(10, 80) if on_hand else random.uniform(-145, -25)
    return round(random.uniform(-32, 28), 2) + 0.001, round(along, 2) + 0.001


def _plain(event: TouchEvent) -> dict[str, Any]:
    return {
        "type": str(event.type), "pointerId": event.pointer_id, "hand": str(event.hand), "surface": str(event.surface),
        "xMm": event.x_mm, "yMm": event.y_mm, "forceN": event.force_n,
    }  # fmt: skip


def text() -> str:
    """The file's content: one event a line."""
    made = vectors()
    programs = ",\n".join("[\n" + ",\n".join(json.dumps(step) for step in program) + "\n]" for program in made["programs"])
    return f'{{\n"layout": {json.dumps(made["layout"])},\n"views": {json.dumps(made["views"])},\n"programs": [\n{programs}\n]\n}}\n'


if __name__ == "__main__":
    VECTORS.write_text(text(), encoding="utf-8")
