"""Whatever a script says, it is refused in words or played within the grammar."""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from typing import Any

import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.engine import EventEngine
from egotouch_sdk.errors import ConfigError
from egotouch_sdk.joints import FINGERS, Handedness
from egotouch_sdk.simulator import observe
from egotouch_sdk.simulator.acts import ACTS
from egotouch_sdk.simulator.script import parse_script
from egotouch_sdk.simulator.timeline import Timeline
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent

PLACES = {
    Surface.PALM: (0, 80),
    Surface.BACK_OF_HAND: (0, 80),
    Surface.INNER_FOREARM: (-200, -1),
    Surface.OUTER_FOREARM: (-200, -1),
}


@st.composite
def acts(draw: st.DrawFn) -> dict[str, Any]:
    """One sound act."""
    word = draw(st.sampled_from(sorted(ACTS)))
    fields: dict[str, Any] = draw(st.sampled_from([{}, {"after_ms": draw(st.integers(0, 900))}, {"with_ms": draw(st.integers(0, 900))}]))
    if word in ("vanish", "stall"):
        fields = fields | {"duration_ms": draw(st.integers(1, 700))}
    elif word != "swap":
        surface = draw(st.sampled_from(Surface))
        place = st.lists(st.integers(*PLACES[surface]), min_size=2, max_size=2).map(lambda at: [at[0] % 40 - 20, at[1]])
        fields = fields | {
            "at": draw(place),
            "surface": surface.value,
            "hand": draw(st.sampled_from(Handedness)).value,
            "finger": draw(st.sampled_from(FINGERS)).value,
            "force_n": draw(st.floats(0, 3.5)),
            "pitch_deg": draw(st.floats(0, 90)),
            "yaw_deg": draw(st.floats(-180, 180)),
        }
        if word in ("drag", "fling"):
            fields["to"] = draw(st.lists(place, min_size=1, max_size=3))
    return {word: fields}


@given(st.lists(acts(), min_size=1, max_size=5), st.sampled_from([15, 30, 60]), st.sampled_from([0, 2]))
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_a_sound_script_is_played_within_the_grammar(script: list[dict[str, Any]], fps: int, jitter_mm: float) -> None:
    try:
        timeline = Timeline(parse_script(yaml.safe_dump({"acts": script, "fps": fps, "jitter_mm": jitter_mm}), "any"), "any")
    except ConfigError:
        return
    engine = EventEngine(TouchConfig(debug=True))
    events: list[TouchEvent] = []
    for tick in range(int(timeline.duration_ms * fps / 1e3) + 1):
        scene = timeline.scene(tick * 1e3 / fps, tick)
        if scene is not None:
            events += engine.process(observe(scene, tick, round(tick * 1e9 / fps))).events
    events += engine.finish(round(timeline.duration_ms * 1e6))
    counts = Counter(event.type for event in events)
    assert counts[EventType.DOWN] == counts[EventType.UP] + counts[EventType.CANCEL]
    assert counts[EventType.HOVER_ENTER] == counts[EventType.HOVER_EXIT]


@given(
    st.text(max_size=200)
    | st.recursive(st.none() | st.floats() | st.text(), lambda x: st.lists(x) | st.dictionaries(st.text(), x)).map(yaml.safe_dump)
)
@settings(max_examples=300, deadline=None)
def test_any_text_is_a_script_or_a_config_error(text: str) -> None:
    for wrapped in (text, f"acts:\n - tap: {text}", f"acts:\n - {text}"):
        with suppress(ConfigError):
            assert parse_script(wrapped, "any").acts
