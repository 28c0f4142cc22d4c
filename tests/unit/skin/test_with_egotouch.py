"""A group as a listener of `EgoTouch`, with simulated fingers."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest

import egotouch_sdk.skin
from egotouch_sdk import EgoTouch, ErrorEvent, Handedness, Surface, TouchEvent
from egotouch_sdk.skin import Region, SkinButton, SkinKeypad, SkinSlider, SkinViewGroup

pytest.importorskip("yaml")

BUTTON = SkinButton(name="ok", region=Region.rectangle(Surface.PALM, 0, 50, 30, 30))


@pytest.fixture
def script(tmp_path: Path) -> Path:
    path = tmp_path / "script.yaml"
    path.write_text(
        "acts:\n  - tap: {at: [0, 50]}\n  - press: {at: [0, 50]}\n  - drag: {at: [0, -130], to: [0, -30], surface: inner_forearm}\n"
    )
    return path


def test_a_consumed_long_click_is_no_click_for_anyone_else_either(script: Path) -> None:
    skin = SkinViewGroup([BUTTON])
    told: list[str] = []
    with EgoTouch(script, realtime=False) as et:
        et.addListener(skin)
        et.onClick(lambda event: told.append("click anywhere"))
        skin.view("ok").onClick(lambda event: told.append("click"))

        @skin.view("ok").onLongClick
        def consume(event: TouchEvent) -> bool:
            told.append("long click")
            return True

        et.run()
    assert told == ["click", "click anywhere", "long click"]


def test_a_throwing_view_listener_reaches_on_error_and_stops_nothing(script: Path) -> None:
    skin = SkinViewGroup([BUTTON])
    errors: list[ErrorEvent] = []
    clicks: list[TouchEvent] = []
    with EgoTouch(script, realtime=False) as et:
        et.addListener(skin)
        et.onError(errors.append)

        @skin.view("ok").onTouchDown
        def broken(event: TouchEvent) -> None:
            raise RuntimeError("broken")

        skin.view("ok").onClick(clicks.append)
        et.run()
    assert [str(error.error) for error in errors] == ["broken", "broken"]
    assert len(clicks) == 2


def test_the_documented_example_runs(script: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = egotouch_sdk.skin.__doc__ or ""
    names = {**vars(egotouch_sdk.skin), "Surface": Surface, "Handedness": Handedness}
    code = text[text.index("    volume =") : text.index("\nPlaces are")]
    exec(dedent(code), {**names, "EgoTouch": lambda source: EgoTouch(script, realtime=False)})
    assert capsys.readouterr().out.split("\n")[0] == "key 5"


def test_a_slider_on_the_forearm_follows_the_finger(script: Path) -> None:
    region = Region.rectangle(Surface.INNER_FOREARM, x_mm=0, y_mm=-80, width_mm=30, height_mm=140)
    slider = SkinSlider(name="volume", region=region, start_mm=(0, -120), end_mm=(0, -40), step=0.25)
    skin = SkinViewGroup([slider, SkinKeypad.phone("pad", Surface.PALM, Handedness.LEFT)])
    values: list[float] = []
    skin.slider("volume").onChange(lambda change: values.append(change.value))
    with EgoTouch(script, realtime=False) as et:
        et.addListener(skin)
        et.run()
    assert values == [0.25, 0.5, 0.75, 1.0]
    assert skin.snapshot().fingers == ()
    assert not any(view.is_pressed or view.is_hovered for view in skin.snapshot().views)
