"""Whatever a server says, the page takes it or says that it does not, and goes on."""

from __future__ import annotations

from collections.abc import Iterator
from math import nan
from random import Random
from time import monotonic
from typing import TYPE_CHECKING

import pytest

from egotouch_sdk.wire.gen import egotouch_pb2 as pb

if TYPE_CHECKING:
    from playwright.sync_api import Browser, WebSocketRoute

    from tests.support.browser import PlayedPage, ServerProcess

Link = tuple["PlayedPage", "list[WebSocketRoute]"]


def event(**fields: object) -> pb.TouchEvent:
    """A finger that comes over the palm, with some fields replaced."""
    message = pb.TouchEvent(type=pb.EVENT_TYPE_HOVER_ENTER, pointer_id=7, timestamp_ns=12, hand=pb.HANDEDNESS_RIGHT)
    message.finger, message.surface, message.x_mm, message.pitch_rad = pb.FINGER_INDEX, pb.SURFACE_PALM, 1.0, 0.5
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def batch(*events: pb.TouchEvent) -> bytes:
    """One frame's events as a message."""
    return bytes(pb.ServerMessage(offset=1, batch=pb.EventBatch(timestamp_ns=12, sent_ns=13, events=events)).SerializeToString())


GOOD = [
    batch(event()),
    batch(event(), event(type=pb.EVENT_TYPE_DOWN, contact_id=1, down_time_ns=12)),
    pb.ServerMessage(offset=1, status=pb.Status(fps=30, gate=pb.GATE_REASON_OPEN, source="camera", hands_in_view=2)).SerializeToString(),
    pb.ServerMessage(hands=pb.HandsView(width_px=640, height_px=480, hands=[pb.Hand(landmarks_px=[1.0] * 63)])).SerializeToString(),
    pb.ServerMessage(clock_reply=pb.ClockReply(client_send_ns=1, server_receive_ns=2, server_send_ns=3)).SerializeToString(),
    pb.ServerMessage(heartbeat=pb.Heartbeat(sent_ns=1, active_contacts=1)).SerializeToString(),
]


@pytest.fixture
def link(browser: Browser, server: ServerProcess) -> Iterator[Link]:
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


@pytest.mark.parametrize(
    "message",
    ["{}", b"\xff", batch(event())[:-3], batch(event(x_mm=nan)), batch(event(finger=0)), batch(event(type=0))],
    ids=["text", "noise", "cut off", "no place", "no finger", "no type"],
)
def test_what_is_no_message_ends_the_link_which_comes_back(link: Link, message: str | bytes) -> None:
    from tests.support.browser import PATIENCE_S

    page, links = link
    links[-1].send(message)
    deadline_s = monotonic() + PATIENCE_S
    while len(links) < 2:
        assert monotonic() < deadline_s
        page.page.wait_for_timeout(20)
    page.expect_state("live")
    assert page.log == []


def test_messages_of_a_newer_server_are_ignored(link: Link) -> None:
    page, links = link
    links[-1].send(b"\x08\x01\x9a\x06\x02hi")  # a body of field 99
    links[-1].send(batch(event(type=99), event()))
    page.page.locator("#log li", has_text="hover enter").wait_for()
    assert len(links) == 1
    assert page.log == ["hover enter"]


def test_spoiled_messages_break_nothing(link: Link) -> None:
    """Of 500 messages with a few other bytes each is taken or ends the link; an error in the page fails the test when it closes."""
    page, links = link
    random = Random(1)
    for _ in range(500):
        message = bytearray(random.choice(GOOD))
        for _ in range(random.randint(1, 4)):
            message[random.randrange(len(message))] = random.randrange(256)
        links[-1].send(bytes(message))
    last = pb.ServerMessage(offset=1, warning=pb.Warning(code="last", message="This was the last one."))
    page.page.wait_for_timeout(200)
    page.expect_state("live")
    links[-1].send(last.SerializeToString())
    page.page.get_by_text("This was the last one.").wait_for()
    assert len(links) > 1
