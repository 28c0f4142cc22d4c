"""The live view in a real browser shows what another page plays."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.support.browser import PlayedPage, ServerProcess


@pytest.fixture
def page(browser: Browser, server: ServerProcess) -> Iterator[PlayedPage]:
    """The simulator's page."""
    from tests.support.browser import open_page

    with open_page(browser, f"{server.url}simulator.html") as played:
        yield played


def picture(page: PlayedPage, canvas: str) -> str:
    """What a canvas shows."""
    return str(page.page.locator(canvas).evaluate("canvas => canvas.toDataURL()"))


@pytest.mark.parametrize("is_phone", [False, True], ids=["desktop", "phone"])
def test_touches_appear_on_their_side_and_in_the_log(browser: Browser, server: ServerProcess, page: PlayedPage, is_phone: bool) -> None:
    from tests.support.browser import open_page

    with open_page(browser, server.url, phone=is_phone) as live:
        palm, back = picture(live, "#palm"), picture(live, "#back")
        page.page.bring_to_front()
        page.hover(0, 40)
        page.press()
        live.page.locator("#log .group-touch", has_text="down").wait_for()
        live.page.locator("#force-now", has_text="1.00 N").wait_for()
        assert live.contacts == 1
        assert picture(live, "#palm") != palm
        assert picture(live, "#back") == back
        page.lift()
        live.page.locator("#log .group-touch", has_text="up").wait_for()
        assert live.contacts == 0
        live.page.locator("#filters button", has_text="Touch").click()
        assert live.page.locator("#log .group-touch:visible").count() == 0
        assert live.page.locator("#log .group-hover:visible").count() > 0


def test_the_view_follows_to_the_other_arm_unless_told_not_to(browser: Browser, server: ServerProcess, page: PlayedPage) -> None:
    from tests.support.browser import open_page

    page.page.locator("[data-host=right]").click()
    with open_page(browser, server.url) as live:
        page.page.bring_to_front()
        page.hover(0, 40)
        live.page.locator("#host-name", has_text="Right arm").wait_for()
        live.page.locator("[data-host=left]").click()
        page.press()
        live.page.locator("#log .group-touch", has_text="down").wait_for()
        assert live.page.locator("#host-name").inner_text() == "Left arm"


@pytest.mark.parametrize("name", ["", "simulator.html"])
def test_nothing_is_wider_than_a_phone(browser: Browser, server: ServerProcess, name: str) -> None:
    from tests.support.browser import PHONE, open_page

    with open_page(browser, server.url + name, phone=True) as phone:
        assert phone.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def test_a_server_with_a_token_asks_for_it(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> None:
    from tests.support.browser import PATIENCE_S, ServerProcess, loaded_page

    token_file = tmp_path_factory.mktemp("secret") / "token"
    server = ServerProcess("--token-file", str(token_file))
    server.start()
    with loaded_page(browser, server.url) as page:
        dialog = page.page.locator("dialog[open]")
        dialog.wait_for(timeout=PATIENCE_S * 1000)
        page.page.fill("#code", "0" * 32)
        page.page.keyboard.press("Enter")
        dialog.get_by_text("wrong or used up").wait_for()
        page.page.fill("#code", token_file.read_text(encoding="utf-8").strip())
        page.page.keyboard.press("Enter")
        page.expect_state("live")
        page.page.reload()
        page.expect_state("live")
    server.kill()


def test_a_token_in_the_fragment_is_taken_and_removed(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> None:
    from tests.support.browser import ServerProcess, open_page

    token_file = tmp_path_factory.mktemp("secret") / "token"
    server = ServerProcess("--token-file", str(token_file))
    server.start()
    with open_page(browser, f"{server.url}#t={token_file.read_text(encoding='utf-8').strip()}") as page:
        assert page.page.url == server.url
    server.kill()
