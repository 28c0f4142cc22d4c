"""A script played through the real event engine."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from math import radians
from pathlib import Path

import pytest

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.simulator import ScriptSource, shipped_script, shipped_scripts
from egotouch_sdk.sources import ObservationSource, open_source
from egotouch_sdk.touch_event import EventType, TouchEvent

Play = Callable[..., list[TouchEvent]]
EACH_FRAME = {EventType.MOVE, EventType.HOVER_MOVE, EventType.DRAG, EventType.FORCE_CHANGE}
HOVER = {EventType.HOVER_ENTER, EventType.HOVER_EXIT}


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """Writes a script of the given acts, with further lines before them."""

    def write_script(*acts: str, head: str = "") -> Path:
        path = tmp_path / "script.yaml"
        path.write_text(f"{head}\nacts:\n" + "".join(f"  - {act}\n" for act in acts), encoding="utf-8")
        return path

    return write_script


def play(path: Path, fps: float | None = None) -> list[TouchEvent]:
    engine = EventEngine(TouchConfig(debug=True))
    with ScriptSource(path, fps=fps) as source:
        observations = list(source)
    events = [event for observation in observations for event in engine.process(observation).events]
    return [*events, *engine.finish(observations[-1].timestamp_ns)]


def edges(events: list[TouchEvent]) -> list[EventType]:
    """What happened, without what comes with every frame and without hovering."""
    return [event.type for event in events if event.type not in EACH_FRAME | HOVER]


DOWN, UP, CANCEL, CLICK = EventType.DOWN, EventType.UP, EventType.CANCEL, EventType.CLICK
DRAG_START, DRAG_END, FLING = EventType.DRAG_START, EventType.DRAG_END, EventType.FLING
FORCE_ENTER, FORCE_EXIT = EventType.FORCE_ENTER, EventType.FORCE_EXIT


@pytest.mark.parametrize("fps", [30, 60, 90])
@pytest.mark.parametrize(
    ("act", "expected"),
    [
        ("tap: {at: [0, 50]}", [DOWN, UP, CLICK]),
        ("double_tap: {at: [0, 50]}", [DOWN, UP, CLICK, DOWN, UP, CLICK, EventType.DOUBLE_CLICK]),
        ("press: {at: [0, 50]}", [DOWN, EventType.LONG_CLICK, UP, CLICK]),
        ("press: {at: [0, 50], duration_ms: 300, force_n: 2}", [DOWN, FORCE_ENTER, FORCE_EXIT, UP, CLICK]),
        ("drag: {at: [0, 20], to: [0, 60]}", [DOWN, DRAG_START, DRAG_END, UP]),
        ("fling: {at: [0, 20], to: [0, 60]}", [DOWN, DRAG_START, DRAG_END, UP, FLING]),
        ("hover: {at: [0, 20], to: [10, 20]}", []),
    ],
)
def test_an_act_gives_its_events_and_nothing_else(write: Callable[..., Path], act: str, expected: list[EventType], fps: float) -> None:
    events = play(write(act), fps)
    assert edges(events) == expected
    assert [event.type for event in events if event.type in HOVER] == [EventType.HOVER_ENTER, EventType.HOVER_EXIT]


def test_two_taps_are_not_a_double_tap(write: Callable[..., Path]) -> None:
    assert edges(play(write("tap: {at: [0, 50]}", "tap: {at: [0, 50]}"))) == [DOWN, UP, CLICK] * 2


@pytest.mark.parametrize(("fault", "reason"), [("vanish", "tracking_lost"), ("stall", "source_stalled")])
def test_a_fault_during_a_touch_cancels_it(write: Callable[..., Path], fault: str, reason: str) -> None:
    events = play(write("press: {at: [0, 50], duration_ms: 500}", f"{fault}: {{with_ms: 250, duration_ms: 400}}"))
    assert edges(events) == [DOWN, CANCEL]
    assert [event.reason for event in events if event.reason] == [reason]


def test_hands_found_as_new_ones_cancel_the_touch(write: Callable[..., Path]) -> None:
    events = play(write("press: {at: [0, 50], duration_ms: 500}", "swap: {with_ms: 250}"))
    assert edges(events)[:2] == [DOWN, CANCEL]
    assert [event.reason for event in events if event.reason] == ["hand_swapped"]


def test_an_event_carries_what_the_script_asked_for(write: Callable[..., Path]) -> None:
    act = "press: {at: [12, -40], hand: left, finger: middle, surface: outer_forearm, force_n: 0.7, pitch_deg: 60, yaw_deg: -30}"
    pressed = max(play(write(act)), key=lambda event: event.force_n)
    assert (pressed.hand, pressed.finger, pressed.surface, pressed.force_n) == ("left", "middle", "outer_forearm", pytest.approx(0.7))
    assert (pressed.x_mm, pressed.y_mm) == (pytest.approx(12.0, abs=2.0), pytest.approx(-40.0, abs=2.0))
    assert (pressed.pitch_rad, pressed.yaw_rad) == (pytest.approx(radians(60), abs=0.09), pytest.approx(radians(-30), abs=0.09))


def test_two_fingers_press_at_once(write: Callable[..., Path]) -> None:
    events = play(write("press: {at: [12, 60]}", "press: {at: [-10, 62], finger: middle, with_ms: 100}"))
    assert [event.finger for event in events if event.type is DOWN] == ["index", "middle"]
    assert [event.finger for event in events if event.type is UP] == ["index", "middle"]
    assert max(event.timestamp_ns for event in events if event.type is DOWN) < min(e.timestamp_ns for e in events if e.type is UP)


@pytest.mark.parametrize("name", shipped_scripts())
def test_shipped_scripts_keep_the_grammar_and_touch_as_often_as_written(name: str) -> None:
    source = ScriptSource(shipped_script(name))
    events = play(shipped_script(name))
    counts = Counter(event.type for event in events)
    touches = sum(len(act.contacts_ms) for act in source.script.acts if hasattr(act, "contacts_ms"))
    found_again = sum(act.word == "swap" for act in source.script.acts)
    assert counts[DOWN] == touches + found_again
    assert counts[DOWN] == counts[UP] + counts[CANCEL]


def test_playing_twice_gives_the_same(write: Callable[..., Path]) -> None:
    source = ScriptSource(write("tap: {at: [0, 50]}", head="jitter_mm: 1.5\nseed: 3"))
    places = [[tip.tip_px for tip in observation.fingertips] for observation in source]
    assert places == [[tip.tip_px for tip in observation.fingertips] for observation in source]
    assert source.frame_count == len(places)


def test_jitter_moves_the_finger_about_its_place(write: Callable[..., Path]) -> None:
    still = play(write("press: {at: [0, 50]}"))
    shaky = play(write("press: {at: [0, 50]}", head="jitter_mm: 0.5"))
    spread = [{round(event.x_mm, 3) for event in events if event.type is EventType.MOVE} for events in (still, shaky)]
    assert len(spread[0]) < 3 < len(spread[1])
    assert all(abs(x_mm) < 3.0 for x_mm in spread[1])


def test_a_stall_gives_no_observations(write: Callable[..., Path]) -> None:
    source = ScriptSource(write("tap: {at: [0, 50]}", "stall: {duration_ms: 500}"))
    times_ns = [observation.timestamp_ns for observation in source]
    gaps_ns = [b - a for a, b in pairwise(times_ns)]
    assert sorted(gaps_ns)[-1] >= 500_000_000 > sorted(gaps_ns)[-2]
    assert source.frame_count == len(times_ns)
    assert [observation.index for observation in source] == list(range(len(times_ns)))


def test_real_time_plays_at_the_speed_of_the_clock(write: Callable[..., Path]) -> None:
    from egotouch_sdk.clock import now_ns

    source = ScriptSource(write("swap: {after_ms: 0}", head="fps: 20"), realtime=True)
    start_ns = now_ns()
    assert len(list(source)) == 9
    assert now_ns() - start_ns >= 400_000_000
    assert source.is_live


def test_a_yaml_file_opens_as_a_source_of_observations(write: Callable[..., Path]) -> None:
    with open_source(write("tap: {at: [0, 50]}"), fps=24) as source:
        assert isinstance(source, ScriptSource)
        assert isinstance(source, ObservationSource)
        assert (source.fps, source.width_px, source.height_px, source.config, source.thresholds) == (24, 1280, 720, None, None)


@pytest.mark.parametrize("fps", [0.0, 0.5, 1000.0, float("nan")])
def test_a_rate_that_no_camera_has_is_refused(fps: float) -> None:
    with pytest.raises(ConfigError, match="Choose 1 to 240"):
        ScriptSource(shipped_script("taps"), fps=fps)
