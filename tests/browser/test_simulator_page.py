"""The simulator's page in a real browser plays fingers; a second client hears what they do."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import AbstractContextManager
from math import cos, radians, sin
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.support.browser import Listener, PlayedPage, ServerProcess

TOUCHES = ("HOVER_ENTER", "HOVER_EXIT", "DOWN", "UP", "CANCEL")
#: Simulated places come back this well, in millimetres and radians.
PLACE_MM, ANGLE_RAD = 3.0, 0.1


@pytest.fixture
def page(browser: Browser, server: ServerProcess) -> Iterator[PlayedPage]:
    from tests.support.browser import open_page

    with open_page(browser, f"{server.url}simulator.html") as played:
        yield played


@pytest.fixture
def phone(browser: Browser, server: ServerProcess) -> Iterator[PlayedPage]:
    from tests.support.browser import open_page

    with open_page(browser, f"{server.url}simulator.html", phone=True) as played:
        yield played


@pytest.fixture
def listener(server: ServerProcess) -> Iterator[Listener]:
    with listening(server, *TOUCHES) as client:
        yield client


def listening(server: ServerProcess, *types: str) -> AbstractContextManager[Listener]:
    """A second client for the length of a `with` block."""
    from tests.support.browser import listening

    return listening(server.url, *types)


def assert_at(event: dict[str, Any], surface: str, x_mm: float, y_mm: float) -> None:
    assert event["surface"] == f"SURFACE_{surface}"
    assert (event["x_mm"], event["y_mm"]) == pytest.approx((x_mm, y_mm), abs=PLACE_MM)


def test_a_press_on_the_palm_arrives_with_finger_place_and_force(page: PlayedPage, server: ServerProcess) -> None:
    with listening(server, *TOUCHES, "CLICK", "LONG_CLICK") as listener:
        page.set_slider("force", 1.3)
        page.hover(-12, 35)
        listener.hear("HOVER_ENTER")
        page.press()
        (down,) = listener.hear("DOWN")
        assert (down["hand"], down["finger"]) == ("HANDEDNESS_RIGHT", "FINGER_INDEX")
        assert_at(down, "PALM", -12, 35)
        assert down["force_n"] == pytest.approx(1.3, abs=0.01)
        listener.hear("LONG_CLICK")
        assert page.contacts == 1
        page.lift()
        listener.hear("UP", "CLICK")
        page.leave()
        listener.hear("HOVER_EXIT")
        listener.hear_nothing()
    assert page.log == ["hover enter", "down", "long click", "up", "click", "hover exit"]


def test_finger_arm_side_force_and_angles_are_chosen(page: PlayedPage, server: ServerProcess) -> None:
    with listening(server, *TOUCHES, "FORCE_ENTER", "FORCE_EXIT") as listener:
        page.page.locator("[data-host=right]").click()
        page.page.locator("[data-side=back]").click()
        page.page.locator("[data-finger=middle]").click()
        page.set_slider("force", 2.5)
        page.set_slider("pitch", 60)
        page.set_slider("yaw", -20)
        page.hover(10, 50)
        page.press()
        (_, down, _) = listener.hear("HOVER_ENTER", "DOWN", "FORCE_ENTER")
        assert (down["hand"], down["finger"]) == ("HANDEDNESS_LEFT", "FINGER_MIDDLE")
        assert_at(down, "BACK_OF_HAND", 10, 50)
        assert (down["pitch_rad"], down["yaw_rad"]) == pytest.approx((radians(60), radians(-20)), abs=ANGLE_RAD)
        page.lift()
        listener.hear("FORCE_EXIT", "UP")


def test_a_drag_along_the_forearm(page: PlayedPage, server: ServerProcess) -> None:
    with listening(server, *TOUCHES, "DRAG_START", "DRAG_END") as listener:
        page.hover(0, -40)
        page.press()
        (_, down) = listener.hear("HOVER_ENTER", "DOWN")
        assert_at(down, "INNER_FOREARM", 0, -40)
        page.hover(5, -110, steps=30)
        listener.hear("DRAG_START")
        page.page.wait_for_timeout(300)  # the finger rests, then lifts: no fling
        page.lift()
        (end, _) = listener.hear("DRAG_END", "UP")
        assert_at(end, "INNER_FOREARM", 5, -110)
        assert end["dy_mm"] == pytest.approx(-70, abs=2 * PLACE_MM)
        page.leave()
        listener.hear("HOVER_EXIT")
        listener.hear_nothing()


def test_shift_adds_a_second_finger(page: PlayedPage, listener: Listener) -> None:
    page.hover(0, 40)
    listener.hear("HOVER_ENTER")
    page.page.keyboard.down("Shift")
    page.hover(1, 40)
    listener.hear("HOVER_ENTER")
    page.press()
    downs = listener.hear("DOWN", "DOWN")
    assert len({down["finger"] for down in downs}) == 2
    first, second = sorted(down["x_mm"] for down in downs)
    assert second - first == pytest.approx(24, abs=PLACE_MM)
    page.lift()
    listener.hear("UP", "UP")


def test_two_fingers_on_a_touch_screen(phone: PlayedPage, listener: Listener) -> None:
    places = [(15.0, 40.0), (-20.0, 30.0)]
    phone.touch(*places)
    events = listener.take(4)
    assert sorted(kinds(events)) == ["DOWN", "DOWN", "HOVER_ENTER", "HOVER_ENTER"]
    downs = {event["finger"]: event for event in events if event["type"] == "EVENT_TYPE_DOWN"}
    assert set(downs) == {"FINGER_INDEX", "FINGER_MIDDLE"}
    assert_at(downs["FINGER_INDEX"], "PALM", *places[0])
    assert_at(downs["FINGER_MIDDLE"], "PALM", *places[1])
    phone.touch()
    assert sorted(kinds(listener.take(4))) == ["HOVER_EXIT", "HOVER_EXIT", "UP", "UP"]
    listener.hear_nothing()


def kinds(events: list[dict[str, Any]]) -> list[str]:
    return [event["type"].removeprefix("EVENT_TYPE_") for event in events]


def test_a_pen_brings_its_own_force_and_angles(page: PlayedPage, listener: Listener) -> None:
    page.use_pen("mousePressed", -5, 45, force=0.6, tiltX=40)
    page.use_pen("mouseMoved", -5, 45, force=0.6, tiltX=40)
    (_, down) = listener.hear("HOVER_ENTER", "DOWN")
    assert down["force_n"] == pytest.approx(0.6 * 3.5, abs=0.05)
    # The pen leans to the right of the picture, so it points to the left: the side of the thumb on a left palm.
    assert (sin(down["yaw_rad"]), cos(down["yaw_rad"])) == pytest.approx((1.0, 0.0), abs=ANGLE_RAD)
    assert down["pitch_rad"] == pytest.approx(radians(90 - 40), abs=ANGLE_RAD)
    page.use_pen("mouseReleased", -5, 45)
    listener.hear("UP")


def test_keys_play_a_finger(page: PlayedPage, listener: Listener) -> None:
    page.page.locator("#limb").focus()
    page.page.keyboard.press("5")
    page.page.keyboard.press("ArrowUp")
    listener.hear("HOVER_ENTER")
    page.page.keyboard.down(" ")
    (down,) = listener.hear("DOWN")
    assert down["finger"] == "FINGER_PINKY"
    assert_at(down, "PALM", 0, 46)
    page.page.keyboard.up(" ")
    listener.hear("UP")
    page.page.keyboard.press("Escape")
    listener.hear("HOVER_EXIT")


def test_a_finger_that_leaves_the_skin_lifts(page: PlayedPage, listener: Listener) -> None:
    page.hover(0, 20)
    page.press()
    listener.hear("HOVER_ENTER", "DOWN")
    page.hover(90, -60, steps=5)
    listener.hear("UP")


def test_a_page_that_is_closed_while_touching_cancels(page: PlayedPage, listener: Listener) -> None:
    page.hover(0, 40)
    page.press()
    listener.hear("HOVER_ENTER", "DOWN")
    page.page.close()
    (cancel, _) = listener.hear("CANCEL", "HOVER_EXIT")
    assert cancel["reason"] == "CANCEL_REASON_TRACKING_LOST"
    listener.hear_nothing()


def test_a_killed_server_cancels_on_the_page_which_comes_back(page: PlayedPage, server: ServerProcess) -> None:
    page.hover(0, 40)
    page.press()
    page.page.locator("#log .group-touch", has_text="down").wait_for()
    server.kill()
    page.wait_until("egotouch.client.contacts === 0")
    assert page.log[-2:] == ["cancel", "hover exit"]
    page.lift()
    page.leave()
    server.start()
    page.expect_state("live")
    with listening(server, *TOUCHES) as listener:
        page.hover(10, 40)
        page.press()
        listener.hear("HOVER_ENTER", "DOWN")
        page.lift()
        listener.hear("UP")


def test_a_reconnect_in_a_touch_ends_it_on_this_page(page: PlayedPage) -> None:
    page.hover(0, 40)
    page.press()
    page.page.locator("#log .group-touch", has_text="down").wait_for()
    assert page.page.evaluate("() => { egotouch.client.start(); return egotouch.client.contacts; }") == 0
    assert [name for name in page.log if name != "long click"][:4] == ["hover enter", "down", "cancel", "hover exit"]
    page.expect_state("live")
    page.lift()
    page.wait_until("egotouch.client.pointers.some(({ type }) => type.startsWith('hover'))")
    page.press()
    page.wait_until("egotouch.client.contacts === 1")


def test_a_silent_server_cancels_on_the_page_until_the_next_touch(page: PlayedPage, server: ServerProcess) -> None:
    page.hover(0, 40)
    page.press()
    page.page.locator("#log .group-touch", has_text="down").wait_for()
    server.send(signal.SIGSTOP)
    page.expect_state("stale")
    assert page.contacts == 0
    assert page.log[-2:] == ["cancel", "hover exit"]
    server.send(signal.SIGCONT)
    page.expect_state("live")
    page.lift()
    page.leave()
    page.page.locator("#log .group-hover", has_text="hover exit").wait_for()
    assert not {"up", "click"} & set(page.log)
    page.hover(0, 40)
    page.press()
    page.page.locator("#log li", has_text="down").nth(1).wait_for()
