"""Modules of the pages that need no server's events, tested where they run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.support.browser import PlayedPage, ServerProcess


@pytest.fixture(scope="module")
def shared_server(browser: Browser) -> Iterator[ServerProcess]:
    from tests.support.browser import ServerProcess

    server = ServerProcess()
    server.start()
    yield server
    server.kill()


@pytest.fixture
def page(browser: Browser, shared_server: ServerProcess) -> Iterator[PlayedPage]:
    from tests.support.browser import open_page

    with open_page(browser, shared_server.url) as opened:
        yield opened


def run(page: PlayedPage, module: str, code: str) -> Any:
    """What `code` returns, with the module's exports as `m`."""
    return page.page.evaluate(f"async () => {{ const m = await import('./{module}'); {code} }}")


def test_the_clock_offset_is_within_2_ms_under_20_ms_of_jitter(page: PlayedPage) -> None:
    """The server's clock is 5000 ms ahead; each way takes 1 ms and, independently, up to 20 ms more."""
    worst_ms = run(
        page,
        "clock_offset.js",
        """
        let seed = 1;
        const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
        const errors = [];
        for (let run = 0; run < 50; run += 1) {
          const clock = new m.ClockOffset();
          for (let i = 0; i < 100; i += 1) {
            const sent = i * 1000;
            const there = sent + 1 + 20 * random();
            const reply = { client_send_ms: sent, server_receive_ms: there + 5000, server_send_ms: there + 5000.1 };
            clock.add(reply, there + 0.1 + 1 + 20 * random());
          }
          errors.push(Math.abs(clock.toServerMs(0) - 5000));
        }
        return Math.max(...errors);
        """,
    )
    assert worst_ms < 2.0


@pytest.mark.parametrize(
    ("code", "was_live", "retry", "access"),
    [
        (1006, True, True, False),
        (1006, False, True, False),
        (1001, True, True, False),
        (1009, True, False, False),
        (4001, True, True, False),
        (4008, True, True, False),
        (4400, False, False, False),
        (4401, False, False, True),
        (4403, False, False, False),
        (4409, False, False, False),
        (4422, True, False, False),
        (4499, True, False, False),
    ],
)
def test_close_codes_say_whether_to_come_back(page: PlayedPage, code: int, was_live: bool, retry: bool, access: bool) -> None:
    advice = run(page, "close_codes.js", f"return m.closeAdvice({code}, '', {str(was_live).lower()})")
    assert (advice["retry"], advice["access"]) == (retry, access)
    assert advice["text"].endswith((".", "?"))


def test_a_contact_that_ended_here_stays_ended(page: PlayedPage) -> None:
    told = run(
        page,
        "open_pointers.js",
        """
        const pointers = new m.OpenPointers();
        const event = (type, contact_id) => ({ type, pointer_id: 1, contact_id });
        const accepted = (...types) => types.map(([type, contact]) => pointers.accept(event(type, contact)));
        const before = accepted(["HOVER_ENTER", 0], ["DOWN", 1], ["MOVE", 1]);
        const cancelled = pointers.cancelContacts().map(({ type, reason }) => [type, reason]);
        const after = accepted(["MOVE", 1], ["UP", 1], ["CLICK", 1], ["HOVER_MOVE", 1], ["DOWN", 2], ["UP", 2], ["CLICK", 2]);
        return { before, cancelled, after, contacts: pointers.contacts };
        """,
    )
    assert told == {
        "before": [True] * 3,
        "cancelled": [["CANCEL", "DISCONNECTED"]],
        "after": [False, False, False, True, True, True, True],
        "contacts": 0,
    }


def test_a_clock_that_jumps_is_found_again(page: PlayedPage) -> None:
    offset_ms = run(
        page,
        "clock_offset.js",
        """
        const clock = new m.ClockOffset();
        for (const offset of [100, 100, -300]) {
          clock.add({ client_send_ms: 0, server_receive_ms: offset + 1, server_send_ms: offset + 1 }, 2);
        }
        return clock.toServerMs(0);
        """,
    )
    assert offset_ms == -300
