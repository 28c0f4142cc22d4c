"""Browser tests need Playwright (the extra `browser`) and a Chromium on the machine; CI has both."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.support.browser import ServerProcess


def skip(reason: str) -> None:
    """Skip on a developer's machine, fail in CI."""
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A second try for a browser that the machine left no time; both tries are reported."""
    for item in items:
        if item.path.is_relative_to(Path(__file__).parent):
            item.add_marker(pytest.mark.flaky(reruns=1))


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A headless Chromium; not for the whole session, as Playwright's event loop would be in the way of other tests' loops."""
    try:
        from playwright.sync_api import sync_playwright
    except ModuleNotFoundError:
        skip("no Playwright; install it with: pip install -e '.[browser]'")
    from tests.support.browser import CHROMIUM_ARGUMENTS, chromium

    path = chromium()
    if path is None:
        skip("no Chromium; install the package chromium, or set EGOTOUCH_CHROMIUM")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=CHROMIUM_ARGUMENTS)
        yield started
        started.close()


@pytest.fixture
def server(browser: Browser) -> Iterator[ServerProcess]:
    """A live simulator."""
    from tests.support.browser import ServerProcess

    process = ServerProcess()
    process.start()
    yield process
    process.kill()
