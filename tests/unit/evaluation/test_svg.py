from __future__ import annotations

import re
from math import nan
from xml.etree import ElementTree as ET

import pytest

from egotouch_sdk.evaluation.svg import WIDTH, column_plot, curve_plot, interval_plot


def shapes(svg: str, tag: str) -> list[dict[str, str]]:
    return [dict(node.attrib) for node in ET.fromstring(svg).iter(tag)]


def test_a_dot_lies_at_its_value_inside_its_interval() -> None:
    svg = interval_plot([("palm", 95.0, (94.0, 96.0)), ("back of hand", 90.0, (nan, nan)), ("none", nan, (nan, nan))])
    dots = [float(dot["cx"]) for dot in shapes(svg, "circle")]
    (bar,) = [path["d"] for path in shapes(svg, "path") if path["class"] == "bar"]
    low, high = (float(number) for number in re.findall(r"[MH]([\d.]+)", bar))
    assert len(dots) == 2 and dots[1] < low < dots[0] < high and dots[0] == pytest.approx((low + high) / 2, abs=0.1)
    assert [text.text for text in ET.fromstring(svg).iter("text")][-3:] == ["palm", "back of hand", "none"]


def test_a_reference_is_drawn_where_it_belongs() -> None:
    svg = interval_plot([("a", 95.0, (nan, nan))], reference=95.0)
    (line,) = [path["d"] for path in shapes(svg, "path") if path["class"] == "other"]
    assert line.startswith(f"M{shapes(svg, 'circle')[0]['cx']} ")


def test_columns_are_as_tall_as_their_values() -> None:
    columns = shapes(column_plot([("a", 50.0), ("b", 100.0), ("c", nan)], top=100), "rect")
    assert len(columns) == 2 and float(columns[1]["height"]) == pytest.approx(2 * float(columns[0]["height"]), abs=0.2)


def test_many_columns_have_few_labels() -> None:
    svg = column_plot([(str(number), float(number)) for number in range(60)])
    assert len(shapes(svg, "rect")) == 60 and 5 < len(shapes(svg, "text")) < 12


def test_a_curve_runs_from_corner_to_corner_within_the_picture() -> None:
    svg = curve_plot([(0.0, 0.0), (0.1, 0.9), (1.0, 1.0)], "across", "up", diagonal=True)
    curve, diagonal = (next(path["d"] for path in shapes(svg, "path") if path["class"] == name) for name in ("bar", "other"))
    points = [tuple(map(float, point.split())) for point in curve[1:].split("L")]
    assert diagonal == f"M{curve[1:].split('L')[0]}L{curve.split('L')[-1]}"
    assert all(0 < x < WIDTH and 0 < y < 240 for x, y in points) and points[0][1] > points[1][1] > points[2][1]


@pytest.mark.parametrize("svg", [interval_plot([]), column_plot([]), column_plot([("a", nan)]), curve_plot([], "x", "y", diagonal=False)])
def test_nothing_to_draw_is_still_a_picture(svg: str) -> None:
    assert ET.fromstring(svg).tag == "svg"


def test_labels_are_escaped() -> None:
    assert "a &lt;b&gt;" in interval_plot([("a <b>", 1.0, (nan, nan))])
