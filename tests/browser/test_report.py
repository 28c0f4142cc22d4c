"""The evaluation's report in a real browser: nothing sticks out, nothing is fetched, light and dark."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from egotouch_sdk.cli.main import main
from egotouch_sdk.surface import Surface
from tests.support.study import signal_model, study_round, write_study

if TYPE_CHECKING:
    from playwright.sync_api import Browser, ColorScheme, ViewportSize

DESKTOP: ViewportSize = {"width": 1280, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 844}
_STICKING_OUT = """() => [...document.querySelectorAll('main *')].filter(node =>
  !node.closest('.table') && node.getBoundingClientRect().right > document.documentElement.clientWidth + 1).map(node => node.outerHTML)"""
_CLIPPED = """() => [...document.querySelectorAll('svg')].flatMap(svg => {
  const frame = svg.getBoundingClientRect();
  return [...svg.querySelectorAll('text')].filter(text => {
    const box = text.getBoundingClientRect();
    return box.left < frame.left - 1 || box.right > frame.right + 1 || box.bottom > frame.bottom + 1;
  }).map(text => text.textContent);
})"""


@pytest.fixture
def report(tmp_path: Path) -> Path:
    rounds = [
        study_round("....########...", participant=person, round=number, place=place, fitzpatrick=2 + person, walking=person > 0)
        for person in (0, 1, 2)
        for number, place in enumerate(Surface)
    ]
    path = tmp_path / "report.html"
    arguments = [str(write_study(tmp_path / "study", rounds)), "--model", str(signal_model(tmp_path)), "--report", str(path)]
    assert main(["evaluate", "study", *arguments]) == 0
    return path


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_report_fits_the_page_and_fetches_nothing(browser: Browser, report: Path, size: ViewportSize, scheme: ColorScheme) -> None:
    page = browser.new_page(viewport=size, color_scheme=scheme)
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url) if request.url != report.as_uri() else None)
    page.goto(report.as_uri())
    assert page.locator("h1").inner_text() == "Touch study in simulation" and page.locator("svg").count() >= 6
    assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
    assert page.evaluate(_STICKING_OUT) == [] and page.evaluate(_CLIPPED) == []
    paper, ink = (page.evaluate(f"getComputedStyle(document.body).{name}") for name in ("backgroundColor", "color"))
    assert (paper == "rgb(255, 255, 255)") == (scheme == "light") and paper != ink
    page.get_by_role("link", name="By place").click()
    assert page.locator("section:target h2").inner_text() == "By place"
    assert complaints == []
    page.close()
