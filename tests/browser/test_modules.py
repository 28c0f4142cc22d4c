"""Modules of the pages that need no server's events, tested where they run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.support.browser import PlayedPage


@pytest.fixture(scope="module")
def page(browser: Browser) -> Iterator[PlayedPage]:
    from tests.support.browser import ServerProcess, open_page

    server = ServerProcess()
    server.start()
    with open_page(browser, server.url) as opened:
        yield opened
    server.kill()


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


#: A finger's places are the pointer's; everything is skin. `step` plays for some milliseconds and gives the heights over the skin.
STAGE = """
    const view = { toMm: (x, y) => [x, y], isOnSkin: () => true, surfaceAt: () => "PALM" };
    const settings = { finger: "INDEX", force_n: 1, pitch_rad: 1, yaw_rad: 0, hover_mm: 12, hoverOnly: false, deviceForce: true };
    const fingers = new m.PlayedFingers(view, () => settings);
    let now = 0;
    const tap = (id) => {
      fingers.move({ id, x: 0, y: 50, pen: null }, { down: true, now });
      fingers.move({ id, x: 0, y: 50, pen: null }, { down: false, now });
      fingers.leave(id, now);
    };
    const play = (ms) => {
      const played = fingers.at((now += ms));
      fingers.noteSent(now);
      return played.map(({ finger, hover_mm }) => `${finger} ${hover_mm}`);
    };
"""


def test_a_tap_of_no_length_touches_for_a_while_then_hovers_then_leaves(page: PlayedPage) -> None:
    """Also when the page was busy for a second before it could play the tap."""
    played = run(page, "played_fingers.js", STAGE + "tap(1); return [play(1000), play(80), play(20), play(200), play(100)];")
    assert played == [["INDEX 0"], ["INDEX 0"], ["INDEX 12"], ["INDEX 12"], []]


def test_a_second_tap_is_the_same_finger_s(page: PlayedPage) -> None:
    code = "tap(1); const first = play(10); play(150); tap(2); return [first, play(10), play(100)];"
    played = run(page, "played_fingers.js", STAGE + code)
    assert played == [["INDEX 0"], ["INDEX 0"], ["INDEX 12"]]


def test_fingers_that_touch_together_are_neighbours(page: PlayedPage) -> None:
    played = run(
        page,
        "played_fingers.js",
        STAGE + "for (const id of [1, 2, 3]) fingers.move({ id, x: id, y: 50, pen: null }, { down: true, now }); return play(10);",
    )
    assert played == ["INDEX 0", "MIDDLE 0", "THUMB 0"]
