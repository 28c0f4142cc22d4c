"""Layouts as files."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import (
    Reading,
    Region,
    SkinButton,
    SkinKeypad,
    SkinLayout,
    SkinSlider,
    SkinView,
    layout_from_dict,
    layout_to_dict,
    load_layout,
    loading,
)
from egotouch_sdk.surface import Surface

LAYOUT = SkinLayout(
    (
        SkinView(name="area", region=Region.circle(Surface.BACK_OF_HAND, 0, 40, 20)),
        SkinButton(name="ok", label="OK", region=Region.rectangle(Surface.PALM, -4, 46, 30, 20, host=Handedness.LEFT), slop_mm=1),
        SkinSlider(
            name="volume", region=Region(Surface.INNER_FOREARM, ((-15, -40), (15, -40), (0, -140))), start_mm=(0, -130), end_mm=(0, -50)
        ),
        SkinKeypad.phone("pad", Surface.OUTER_FOREARM, Handedness.RIGHT),
    )
)


def documented() -> dict[str, Any]:
    text = loading.__doc__ or ""
    return tomllib.loads(dedent(text[text.index("    [[views]]") : text.index("\nA region has")]))


def test_a_layout_survives_json() -> None:
    assert layout_from_dict(json.loads(json.dumps(layout_to_dict(LAYOUT)))) == LAYOUT


def test_the_documented_file_is_a_layout() -> None:
    button, slider, keypad = layout_from_dict(documented()).items
    assert button == SkinButton(name="ok", label="OK", region=Region.rectangle(Surface.PALM, -4, 46, 30, 20, host=Handedness.LEFT))
    assert isinstance(slider, SkinSlider) and slider.step == 0.1
    assert isinstance(keypad, SkinKeypad) and keypad.rows[3] == ("*", "0", "#")


def test_toml_and_json_files_are_read(tmp_path: Path) -> None:
    as_json, as_toml = tmp_path / "a.json", tmp_path / "a.toml"
    as_json.write_text(json.dumps(layout_to_dict(LAYOUT)))
    shape = "{x_mm = 0, y_mm = 40, width_mm = 9, height_mm = 9, corner_mm = 2}"
    as_toml.write_text(f'[[views]]\ntype = "button"\nname = "b"\nregion = {{surface = "palm", rounded = {shape}}}\n')
    assert load_layout(as_json) == LAYOUT
    assert load_layout(str(as_toml)).views == (SkinButton(name="b", region=Region.rounded(Surface.PALM, 0, 40, 9, 9, 2)),)


def test_a_keypad_may_say_how_it_is_read() -> None:
    content = documented()
    content["views"][2]["reading"] = "along"
    item = layout_from_dict({"views": [content["views"][2]]}).items[0]
    assert isinstance(item, SkinKeypad) and item.reading is Reading.ALONG


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"type": "buton"}, "view ok has no known type"),
        ({"type": ["button"]}, "view ok has no known type"),
        ({"slop_mm": 10**400}, "view ok: slop_mm is 1000"),
        ({"slop_mm": float("nan")}, "view ok: slop_mm is nan"),
        ({"lable": "x"}, r"view ok: there is no key 'lable'\. Did you mean label\?"),
        ({"slop_mm": "3"}, "view ok: slop_mm is '3'"),
        ({"slop_mm": True}, "view ok: slop_mm is True"),
        ({"name": 3}, "view 1: name is 3"),
        ({"region": None}, "view ok: region is None"),
        ({"region": {"surface": "palm"}}, "view ok: region has 0 shapes"),
        ({"region": {"surface": "pam", "circle": {}}}, "view ok: region: surface is 'pam'"),
        ({"region": {"surface": [], "circle": {}}}, "view ok: region: surface is"),
        ({"region": {"surface": "palm", "circle": {"x_mm": 1}}}, "view ok: region.circle: y_mm is missing"),
        ({"region": {"surface": "palm", "points_mm": [[0, 0], [1, 0]]}}, "view ok: region: a region has 2 corners"),
        ({"region": {"surface": "palm", "points_mm": [0, 1, 2]}}, "view ok: region: points_mm is"),
    ],
)
def test_what_is_wrong_is_named(change: dict[str, Any], message: str) -> None:
    view = {**documented()["views"][0], **change}
    with pytest.raises(LayoutError, match=message):
        layout_from_dict({"views": [view]})


@pytest.mark.parametrize("content", [{}, {"views": []}, {"views": {}}, {"views": [3]}, {"view": []}, [], None])
def test_what_is_no_layout_is_refused(content: Any) -> None:
    with pytest.raises(LayoutError):
        layout_from_dict(content)


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    broken = tmp_path / "broken.toml"
    broken.write_text("[[views]")
    empty = tmp_path / "empty.json"
    empty.write_text("{}")
    for path, message in ((tmp_path / "none.toml", "cannot read"), (broken, "is not TOML"), (empty, "views is missing")):
        with pytest.raises(LayoutError, match=message) as caught:
            load_layout(path)
        assert path.name in str(caught.value)
