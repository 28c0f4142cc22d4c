"""Layouts from plain dicts and from JSON or TOML files, and back.

    [[views]]
    type = "button"                   # view, button, slider or keypad; later views lie on top of earlier ones
    name = "ok"
    label = "OK"                      # optional
    slop_mm = 5.0                     # optional
    region = {surface = "palm", host = "left", rectangle = {x_mm = -4, y_mm = 46, width_mm = 30, height_mm = 20}}

    [[views]]
    type = "slider"
    name = "volume"
    region = {surface = "inner_forearm", points_mm = [[-15, -40], [15, -40], [15, -140], [-15, -140]]}
    start_mm = [0, -130]
    end_mm = [0, -50]
    step = 0.1                        # optional, like value

    [[views]]
    type = "keypad"
    name = "pad"
    surface = "palm"
    host = "left"
    rows = ["123", "456", "789", "*0#"]   # or lists of keys: [["del", "ok"]]
    x_mm = -4
    y_mm = 46
    pitch_mm = 15                     # optional after it: gap_mm, reading ("across" or "along"), slop_mm

A region has one of points_mm, rectangle, circle = {x_mm, y_mm, radius_mm} and rounded = {x_mm, y_mm, width_mm, height_mm, corner_mm};
host is optional. JSON files have the same keys.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields
from difflib import get_close_matches
from enum import StrEnum
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin.keypad import SkinKeypad
from egotouch_sdk.skin.layout import SkinItem, SkinLayout
from egotouch_sdk.skin.reading import Reading
from egotouch_sdk.skin.region import Region
from egotouch_sdk.skin.views import SkinButton, SkinSlider, SkinView
from egotouch_sdk.surface import Surface

_KINDS: dict[str, type[SkinItem]] = {"view": SkinView, "button": SkinButton, "slider": SkinSlider, "keypad": SkinKeypad}
_SHAPES: dict[str, tuple[Callable[..., Region], tuple[str, ...]]] = {
    "rectangle": (Region.rectangle, ("x_mm", "y_mm", "width_mm", "height_mm")),
    "circle": (Region.circle, ("x_mm", "y_mm", "radius_mm")),
    "rounded": (Region.rounded, ("x_mm", "y_mm", "width_mm", "height_mm", "corner_mm")),
}
_ENUMS: dict[str, type[StrEnum]] = {"surface": Surface, "host": Handedness, "reading": Reading}


def load_layout(path: str | Path) -> SkinLayout:
    """The layout in a `.json` or `.toml` file; raises `LayoutError` that names file, view and key."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
        content = json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
    except OSError as error:
        raise LayoutError(f"cannot read the layout {path} ({error.strerror})", hint="Check the path") from error
    except (ValueError, RecursionError) as error:
        raise LayoutError(f"the layout {path} is not {'JSON' if path.suffix == '.json' else 'TOML'}: {error}") from error
    try:
        return layout_from_dict(content)
    except LayoutError as error:
        raise LayoutError(f"{path}: {error.message}", hint=error.hint) from error


def layout_from_dict(content: Mapping[str, Any]) -> SkinLayout:
    """The layout that plain data describe; raises `LayoutError` that names the view and the key that is wrong."""
    views = _table(content, "the layout", required=("views",))["views"]
    if not isinstance(views, list) or not views:
        raise LayoutError("the layout has no views", hint='Give a list "views" of tables with type, name and so on')
    return SkinLayout(tuple(_item(view, number) for number, view in enumerate(views, 1)))


def layout_to_dict(layout: SkinLayout) -> dict[str, Any]:
    """Plain JSON-ready data from which `layout_from_dict` makes an equal layout."""
    return {"views": [_item_to_dict(item) for item in layout.items]}


def _item(view: object, number: int) -> SkinItem:
    name = view.get("name") if isinstance(view, Mapping) else None
    where = f"view {name}" if isinstance(name, str) and name else f"view {number}"
    if not isinstance(view, Mapping) or not isinstance(view.get("type"), str) or view["type"] not in _KINDS:
        raise LayoutError(f"{where} has no known type", hint=f"Set type to one of {', '.join(_KINDS)}")
    kind = _KINDS[view["type"]]
    required = [field.name for field in fields(kind) if field.default is MISSING]
    optional = [field.name for field in fields(kind) if field.default is not MISSING]
    values = {key: _value(key, value, where) for key, value in _table(view, where, ("type", *required), optional).items() if key != "type"}
    try:
        return kind(**values)
    except (TypeError, ValueError) as error:
        raise _explained(where, error) from error


def _value(key: str, value: Any, where: str) -> Any:
    if key in ("name", "label"):
        if not isinstance(value, str):
            raise LayoutError(f"{where}: {key} is {value!r}", hint="Give text in quotes")
        return value
    if key == "region":
        return _region(value, where)
    if key == "rows":
        if not isinstance(value, list) or not all(isinstance(row, str | list) and all(isinstance(k, str) for k in row) for row in value):
            raise LayoutError(f"{where}: rows is {value!r}", hint='Give a list of rows such as "123" or ["del", "ok"]')
        return tuple(tuple(row) for row in value)
    if key in _ENUMS:
        return None if value is None else _member(key, value, where)
    if key in ("start_mm", "end_mm"):
        return _points([value], key, where)[0]
    return _number(value, key, where)


def _region(value: object, where: str) -> Region:
    where = f"{where}: region"
    table = _table(value, where, ("surface",), ("host", "points_mm", *_SHAPES))
    shapes = [key for key in table if key == "points_mm" or key in _SHAPES]
    if len(shapes) != 1:
        raise LayoutError(f"{where} has {len(shapes)} shapes", hint=f"Give one of points_mm, {', '.join(_SHAPES)}")
    surface, host = _member("surface", table["surface"], where), table.get("host")
    host = None if host is None else _member("host", host, where)
    shape = shapes[0]
    try:
        if shape == "points_mm":
            return Region(surface, _points(table[shape], shape, where), host)
        make, names = _SHAPES[shape]
        measures = {name: _number(number, name, where) for name, number in _table(table[shape], f"{where}.{shape}", names).items()}
        return make(surface, **measures, host=host)
    except (TypeError, ValueError) as error:
        raise _explained(where, error) from error


def _points(value: object, key: str, where: str) -> tuple[tuple[float, float], ...]:
    if not isinstance(value, list | tuple) or not all(isinstance(point, list | tuple) and len(point) == 2 for point in value):
        raise LayoutError(f"{where}: {key} is {value!r}", hint="A place is [x_mm, y_mm]")
    return tuple((_number(x, key, where), _number(y, key, where)) for x, y in value)


def _number(value: object, key: str, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e9:
        raise LayoutError(f"{where}: {key} is {value!r}", hint="Give a number")
    return float(value)


def _member(key: str, value: object, where: str) -> Any:
    try:
        return _ENUMS[key](str(value))
    except ValueError:
        raise LayoutError(f"{where}: {key} is {value!r}", hint=f"Give one of {', '.join(_ENUMS[key])}") from None


def _table(value: object, where: str, required: tuple[str, ...], optional: tuple[str, ...] | list[str] = ()) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise LayoutError(f"{where} is {value!r}", hint=f"Give a table with {', '.join(required)}")
    known = (*required, *optional)
    for key in value:
        if key not in known:
            close = get_close_matches(str(key), known, n=1)
            raise LayoutError(
                f"{where}: there is no key {key!r}", hint=f"Did you mean {close[0]}?" if close else f"There are: {', '.join(known)}"
            )
    for key in required:
        if key not in value:
            raise LayoutError(f"{where}: {key} is missing", hint=f"Keys are: {', '.join(known)}")
    return value


def _explained(where: str, error: Exception) -> LayoutError:
    message = error.message if isinstance(error, LayoutError) else str(error)
    return LayoutError(f"{where}: {message.removeprefix(f'{where}: ')}", hint=error.hint if isinstance(error, LayoutError) else "")


def _item_to_dict(item: SkinItem) -> dict[str, Any]:
    kind = next(name for name, kind in _KINDS.items() if type(item) is kind)
    return {"type": kind, **{field.name: _plain(getattr(item, field.name)) for field in fields(item)}}


def _plain(value: object) -> Any:
    if isinstance(value, Region):
        return {"surface": value.surface.value, "host": _plain(value.host), "points_mm": _plain(value.points_mm)}
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return str(value) if isinstance(value, Surface | Handedness | Reading) else value
