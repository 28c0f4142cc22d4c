"""Whatever fingers do on whatever layout, presses end, nothing stays captured, and both hands are alike."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from math import cos, hypot, sin

import cv2
import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.events.order import MAY_FOLLOW
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.skin import Region, SkinButton, SkinKeypad, SkinSlider, SkinViewGroup, layout_from_dict, layout_to_dict
from egotouch_sdk.skin.table import TABLE, ViewInput, ViewState
from egotouch_sdk.skin.views import SLOP_MM
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event
from tests.support.skin import FRAME_NS, ViewLog

Stream = list[tuple[int, tuple[str, tuple[float, float], Surface]]]

MM = st.floats(-40, 40).map(lambda value: round(value, 1))
PLACES = st.tuples(MM, MM)
#: What a finger may do next: (what, where, on which surface).
VERBS = st.tuples(st.sampled_from(["hover", "touch", "lift", "cancel", "leave", "long", "force"]), PLACES, st.sampled_from(list(Surface)))
STREAMS = st.lists(st.tuples(st.integers(1, 3), VERBS), max_size=60)
RECTANGLES = st.builds(
    lambda surface, place, width, height: Region.rectangle(surface, *place, width, height),
    st.sampled_from(list(Surface)),
    PLACES,
    st.floats(2, 60),
    st.floats(2, 60),
)


@st.composite
def layouts(draw: st.DrawFn) -> list[SkinButton]:
    return [SkinButton(name=f"view{k}", region=region) for k, region in enumerate(draw(st.lists(RECTANGLES, min_size=1, max_size=5)))]


@st.composite
def star_polygons(draw: st.DrawFn) -> tuple[tuple[float, float], ...]:
    """Outlines that turn once around their middle, so that they do not cross themselves, notches and spikes included."""
    raw = draw(st.lists(st.tuples(st.floats(0.05, 1), st.floats(5, 40)), min_size=3, max_size=12))
    turn = 2 * np.pi / sum(share for share, _ in raw)
    assume(all(share * turn < 3.0 for share, _ in raw))
    angles = np.cumsum([share * turn for share, _ in raw])
    return tuple((radius * cos(angle), radius * sin(angle)) for angle, (_, radius) in zip(angles, raw, strict=True))


def grammatical(stream: Stream) -> list[TouchEvent]:
    """Events that keep the grammar, whatever the verbs say: a verb that is impossible now becomes a hover or a move."""
    events: list[TouchEvent] = []
    down: dict[int, TouchEvent] = {}
    contacts: Counter[int] = Counter()
    seen: dict[int, int] = {}
    next_id, time_ns = 1, 0

    def send(pointer: int, event_type: EventType, place: tuple[float, float], surface: Surface) -> None:
        down_ns = down[pointer].timestamp_ns if pointer in down else None
        fields = {"down_time_ns": down_ns} if event_type is not EventType.DOWN and not event_type.is_hover else {}
        events.append(
            make_event(
                event_type,
                time_ns,
                pointer_id=seen[pointer],
                finger=FINGERS[pointer],
                contact_id=contacts[seen[pointer]],
                x_mm=place[0],
                y_mm=place[1],
                surface=surface,
                **fields,
            )
        )

    def act(pointer: int, verb: str, place: tuple[float, float], surface: Surface) -> None:
        nonlocal next_id
        if pointer not in seen:
            seen[pointer], next_id = next_id, next_id + 1
            send(pointer, EventType.HOVER_ENTER, place, surface)
        elif pointer in down:
            if verb in ("cancel", "leave"):
                send(pointer, EventType.CANCEL, place, surface)
                del down[pointer]
                send(pointer, EventType.HOVER_EXIT, place, surface)
                del seen[pointer]
            elif verb == "lift":
                send(pointer, EventType.UP, place, surface)
                send(pointer, EventType.CLICK, place, surface)
                del down[pointer]
            else:
                send(pointer, EventType.MOVE, place, surface)
                derived = {"long": (EventType.LONG_CLICK,), "force": (EventType.FORCE_ENTER, EventType.FORCE_EXIT)}
                for event_type in derived.get(verb, ()):
                    send(pointer, event_type, place, surface)
        elif verb == "touch":
            contacts[seen[pointer]] += 1
            send(pointer, EventType.DOWN, place, surface)
            down[pointer] = events[-1]
        elif verb == "leave":
            send(pointer, EventType.HOVER_EXIT, place, surface)
            del seen[pointer]
        else:
            send(pointer, EventType.HOVER_MOVE, place, surface)

    for pointer, (verb, place, surface) in stream:
        time_ns += FRAME_NS
        act(pointer, verb, place, surface)
    time_ns += FRAME_NS
    for pointer in list(seen):
        act(pointer, "leave", (0.0, 0.0), Surface.PALM)
    return events


@given(layouts(), STREAMS)
@settings(max_examples=300, deadline=None)
def test_every_press_ends_once_and_nothing_stays_captured(layout: list[SkinButton], stream: Stream) -> None:
    group = SkinViewGroup(layout)
    log = ViewLog(group)
    holder: dict[str, int] = {}
    for event in grammatical(stream):
        group.handle(event)
        for view, name in log.calls:
            if name == "onTouchDown":
                assert view not in holder, "two fingers have captured one view"
                holder[view] = event.pointer_id
            elif name in ("onTouchUp", "onTouchCancel"):
                assert holder.pop(view) == event.pointer_id
            elif name in ("onTouchMove", "onDragStart", "onDrag", "onDragEnd", "onForce", "onLongClick"):
                assert holder.get(view) == event.pointer_id
            elif name == "onClick":
                assert event.type is EventType.UP and group.view(view).view.region.is_kept(event, SLOP_MM)
        log.forget()
        assert {view.name for view in group.snapshot().views if view.is_pressed} <= set(holder)
    assert holder == {}
    assert not any(view.is_pressed or view.is_hovered or view.force_n for view in group.snapshot().views)
    assert group.snapshot().fingers == ()


@given(layouts(), STREAMS)
@settings(max_examples=150, deadline=None)
def test_hovers_are_balanced_and_never_overlap_a_press_of_the_same_finger(layout: list[SkinButton], stream: Stream) -> None:
    group = SkinViewGroup(layout)
    log = ViewLog(group)
    over: dict[int, str] = {}
    for event in grammatical(stream):
        group.handle(event)
        for view, name in log.calls:
            if name == "onHoverEnter":
                assert event.pointer_id not in over
                over[event.pointer_id] = view
            elif name == "onHoverExit":
                assert over.pop(event.pointer_id) == view
            elif name == "onTouchDown":
                assert event.pointer_id not in over
        log.forget()
    assert over == {}


@given(STREAMS)
@settings(max_examples=100, deadline=None)
def test_the_streams_of_these_tests_have_an_order_that_the_grammar_allows(stream: Stream) -> None:
    last: dict[int, EventType] = {}
    for event in grammatical(stream):
        if event.pointer_id in last:
            assert event.type in MAY_FOLLOW[last[event.pointer_id]]
        else:
            assert event.type is EventType.HOVER_ENTER
        last[event.pointer_id] = event.type
    assert set(last.values()) <= {EventType.HOVER_EXIT}


@given(layouts(), STREAMS)
@settings(max_examples=100, deadline=None)
def test_the_other_hand_is_told_the_same(layout: list[SkinButton], stream: Stream) -> None:
    told = []
    for hand in Handedness:
        group = SkinViewGroup(layout)
        log = ViewLog(group)
        for event in grammatical(stream):
            group.handle(replace(event, hand=hand))
        told.append(list(log.calls))
    assert told[0] == told[1]


@given(star_polygons(), st.lists(PLACES, min_size=1, max_size=30))
@settings(max_examples=300, deadline=None)
def test_hits_agree_with_another_implementation(points: tuple[tuple[float, float], ...], places: list[tuple[float, float]]) -> None:
    region = Region(Surface.PALM, points)
    outline = np.array(points, np.float32)
    for x_mm, y_mm in places:
        distance = cv2.pointPolygonTest(outline, (x_mm, y_mm), measureDist=True)
        if abs(distance) > 1e-3:
            assert region.contains(x_mm, y_mm) == (distance > 0)
            assert region.contains(x_mm, y_mm, slop_mm=max(-distance, 0.0) + 1e-3)
            assert not (distance < -2e-3 and region.contains(x_mm, y_mm, slop_mm=-distance - 1e-3))


@given(star_polygons(), st.integers(0, 11), st.integers(0, 11))
@settings(max_examples=200, deadline=None)
def test_two_corners_swapped_are_found_out_when_the_outline_then_crosses(points: tuple[tuple[float, float], ...], i: int, k: int) -> None:
    i, k = i % len(points), k % len(points)
    swapped = list(points)
    swapped[i], swapped[k] = swapped[k], swapped[i]
    crossing = any(
        _cross(swapped[a], swapped[(a + 1) % len(points)], swapped[b], swapped[(b + 1) % len(points)])
        for a in range(len(points))
        for b in range(a)
    )
    try:
        Region(Surface.PALM, tuple(swapped))
    except LayoutError:
        return
    assert not crossing


def _cross(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], d: tuple[float, float]) -> bool:
    """Two segments cross well inside of both, by solving for the point where their lines meet."""
    matrix = np.array([[b[0] - a[0], c[0] - d[0]], [b[1] - a[1], c[1] - d[1]]])
    if abs(np.linalg.det(matrix)) < 1e-9:
        return False
    s, t = np.linalg.solve(matrix, np.array([c[0] - a[0], c[1] - a[1]]))
    return 1e-6 < s < 1 - 1e-6 and 1e-6 < t < 1 - 1e-6


@given(PLACES, PLACES, st.integers(0, 20), PLACES)
@settings(max_examples=200, deadline=None)
def test_a_slider_has_only_its_steps(start: tuple[float, float], end: tuple[float, float], steps: int, place: tuple[float, float]) -> None:
    assume(hypot(start[0] - end[0], start[1] - end[1]) > 10.1)
    region = Region.rectangle(Surface.PALM, 0, 0, 80, 80)
    slider = SkinSlider(name="s", region=region, start_mm=start, end_mm=end, step=1 / steps if steps else 0)
    value = slider.value_at(*place)
    assert 0 <= value <= 1
    assert slider.stepped(value) == value
    assert slider.value_at(*start) == 0 and slider.value_at(*end) == 1
    if steps:
        assert abs(value * steps - round(value * steps)) < 1e-9


@given(st.sampled_from(list(Surface)), st.floats(12, 16), st.floats(0, 6))
@settings(deadline=None)
def test_keys_never_overlap_and_mirror_each_other_on_the_two_hands(surface: Surface, pitch_mm: float, gap_mm: float) -> None:
    left, right = (replace(SkinKeypad.phone("p", surface, host), pitch_mm=pitch_mm, gap_mm=gap_mm) for host in Handedness)
    for a in left.buttons:
        x, y = a.region.centre_mm
        assert [b.name for b in left.buttons if b.region.contains(x, y)] == [a.name]
    for a, b in zip(left.buttons, right.buttons, strict=True):
        ax, ay = left.axes.to_view(*a.region.centre_mm)
        bx, by = right.axes.to_view(*b.region.centre_mm)
        centre_a, centre_b = left.axes.to_view(left.x_mm, left.y_mm), right.axes.to_view(right.x_mm, right.y_mm)
        assert abs(ax - centre_a[0] - bx + centre_b[0]) < 1e-9 and abs(ay - centre_a[1] - by + centre_b[1]) < 1e-9


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.sampled_from(["palm", "left", "button", "12"]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=4),
    max_leaves=8,
)


@given(st.data())
@settings(max_examples=300, deadline=None)
def test_a_layout_with_anything_changed_in_it_is_read_or_refused(data: st.DataObject) -> None:
    """Any value in the place of any other, anywhere in a layout, gives a layout or a `LayoutError`."""
    region = {"surface": "palm", "host": "left", "rounded": {"x_mm": 0, "y_mm": 40, "width_mm": 20, "height_mm": 20, "corner_mm": 3}}
    slider = {"type": "slider", "name": "s", "region": {"surface": "palm", "points_mm": [[0, 0], [9, 0], [9, 9]]}}
    slider |= {"start_mm": [0, 0], "end_mm": [0, 20], "step": 0.1, "value": 0.5}
    keypad = {"type": "keypad", "name": "k", "surface": "palm", "host": "left", "rows": ["12", ["3", "4"]], "x_mm": 0, "y_mm": 40}
    content = {"views": [{"type": "button", "name": "b", "region": region, "slop_mm": 1}, slider, keypad | {"pitch_mm": 15}]}
    for _ in range(data.draw(st.integers(0, 2))):
        place: object = content
        while isinstance(place, dict | list) and place:
            key = data.draw(st.sampled_from(sorted(place) if isinstance(place, dict) else range(len(place))))
            if not isinstance(place[key], dict | list) or data.draw(st.integers(0, 4)) == 0:
                place[key] = data.draw(JSON)
                break
            place = place[key]
    try:
        layout = layout_from_dict(content)
    except LayoutError:
        return
    assert layout_from_dict(layout_to_dict(layout)) == layout
    SkinViewGroup(layout)


def test_the_table_has_a_way_out_of_every_state() -> None:
    reached = {ViewState.AWAY}
    for _ in ViewState:
        reached |= {after for (before, _), (after, _) in TABLE.items() if before in reached}
    assert reached == set(ViewState)
    for state in (ViewState.PRESSED, ViewState.STRAYED):
        for cause in (ViewInput.LIFT_INSIDE, ViewInput.LIFT_OUTSIDE, ViewInput.CANCEL):
            assert TABLE[state, cause][0] is ViewState.AWAY
    assert TABLE[ViewState.HOVERING, ViewInput.GONE][0] is ViewState.AWAY
