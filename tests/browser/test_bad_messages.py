"""Whatever a server says, the page takes it or says that it does not, and goes on."""

from __future__ import annotations

import json
from collections.abc import Iterator
from random import Random
from time import monotonic
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, WebSocketRoute

    from tests.support.browser import PlayedPage, ServerProcess

EVENT = {
    "type": "EVENT_TYPE_DOWN", "pointer_id": 7, "contact_id": 1, "timestamp_ns": "12", "down_time_ns": "12", "hand": "HANDEDNESS_RIGHT",
    "finger": "FINGER_INDEX", "surface": "SURFACE_PALM", "touch_probability": 0.9, "force_n": 1.0, "x_mm": 1.0, "y_mm": 2.0, "dx_mm": 0.0,
    "dy_mm": 0.0, "velocity_x_mm_s": 0.0, "velocity_y_mm_s": 0.0, "pitch_rad": 0.5, "yaw_rad": 0.1, "image_x": 0.5, "image_y": 0.5,
    "click_count": 0, "reason": "CANCEL_REASON_UNSPECIFIED", "coalesced": [],
}  # fmt: skip
BATCH = {"offset": "1", "batch": {"frame_index": "3", "timestamp_ns": "12", "sent_ns": "13", "events": [EVENT], "late": False}}
GOOD = [
    BATCH,
    {"offset": "1", "status": {"fps": 30.0, "gate": "GATE_REASON_OPEN", "source": "camera", "hands_in_view": 2}},
    {"offset": "1", "hands": {"width_px": 640, "height_px": 480, "hands": [{"handedness": "HANDEDNESS_LEFT", "landmarks_px": [1.0] * 63}]}},
    {"offset": "1", "clock_reply": {"client_send_ns": "1", "server_receive_ns": "2", "server_send_ns": "3"}},
    {"offset": "1", "heartbeat": {"sent_ns": "1", "active_contacts": 1}},
    {"offset": "1", "warning": {"code": "x", "message": "y"}},
]
JUNK: list[Any] = [None, "", "text", [], {}, -1, 1e300, True, "NaN", [[[]]], {"a": 1}]

READ = """async (texts) => {
  const { readMessage } = await import("./wire.js");
  const isRead = (text) => {
    try {
      readMessage(text);
      return true;
    } catch {
      return false;
    }
  };
  return texts.filter(isRead);
}"""


@pytest.fixture
def link(browser: Browser, server: ServerProcess) -> Iterator[tuple[PlayedPage, list[WebSocketRoute]]]:
    """A live view, and its connections to the server, the newest last: what is sent into one comes from the server for the page."""
    from tests.support.browser import loaded_page

    links: list[WebSocketRoute] = []

    def join(route: WebSocketRoute) -> None:
        route.connect_to_server()
        links.append(route)

    with loaded_page(browser, "about:blank") as page:
        page.page.route_web_socket("**/*", join)
        page.page.goto(server.url)
        page.expect_state("live")
        yield page, links


def spoil(value: Any, random: Random) -> Any:
    """The message with one place of it replaced, left out or added to."""
    if isinstance(value, dict) and value and random.random() < 0.85:
        key = random.choice(list(value))
        if random.random() < 0.2:
            return {name: inner for name, inner in value.items() if name != key}
        return value | {key: spoil(value[key], random)}
    if isinstance(value, list) and value and random.random() < 0.7:
        place = random.randrange(len(value))
        return [*value[:place], spoil(value[place], random), *value[place + 1 :]]
    return random.choice(JUNK)


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "7", '"text"', '{"batch": 7}', '{"batch": {}}', '{"hands": {"hands": 1}}'])
def test_what_is_no_message_ends_the_link_which_comes_back(link: tuple[PlayedPage, list[WebSocketRoute]], text: str) -> None:
    from tests.support.browser import PATIENCE_S

    page, links = link
    links[-1].send(text)
    if text in {"[]", "7", '"text"'}:  # JSON without a kind that the page knows, as a newer server may send
        page.expect_state("live")
        return
    deadline_s = monotonic() + PATIENCE_S
    while len(links) < 2:
        assert monotonic() < deadline_s
        page.page.wait_for_timeout(20)
    page.expect_state("live")


def test_messages_of_a_newer_server_are_ignored(link: tuple[PlayedPage, list[WebSocketRoute]]) -> None:
    page, links = link
    links[-1].send(json.dumps({"offset": "1", "something_new": {"a": 1}}))
    event = EVENT | {"type": "EVENT_TYPE_SQUEEZE", "grip_n": 3.0}
    links[-1].send(json.dumps(BATCH | {"batch": {**BATCH["batch"], "events": [event, EVENT]}}))  # type: ignore[dict-item]
    page.page.locator("#log li", has_text="down").wait_for()
    assert len(links) == 1


def test_spoiled_messages_break_nothing(link: tuple[PlayedPage, list[WebSocketRoute]]) -> None:
    """Of 3000 spoiled messages those that the page reads are sent to it; an error in the page fails the test when it closes."""
    page, links = link
    random = Random(1)
    spoiled = [json.dumps(spoil(random.choice(GOOD), random)) for _ in range(3000)]
    read = page.page.evaluate(READ, spoiled)
    assert 300 < len(read) < len(spoiled)
    for text in read:
        links[-1].send(text)
    links[-1].send(json.dumps({"offset": "1", "warning": {"code": "last", "message": "This was the last one."}}))
    page.page.get_by_text("This was the last one.").wait_for()
    assert len(links) == 1
