"""The touches that EVENTS.md shows frame by frame happen as it says."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

import egotouch_sdk.events
from egotouch_sdk.config import GestureConfig
from tests.support.finger import ScriptedFinger

PAGE = (Path(egotouch_sdk.events.__file__).parent / "EVENTS.md").read_text(encoding="utf-8")
SHOWN = dict(re.findall(r"^([a-z ]+?)  +(hover_enter \| down .*)$", PAGE, re.MULTILINE))


def tap(finger: ScriptedFinger) -> None:
    finger.tap()
    finger.hover()


def double_tap(finger: ScriptedFinger) -> None:
    finger.tap()
    finger.hover()
    finger.tap()


def hard_press(finger: ScriptedFinger) -> None:
    finger.touch_down(force_n=1.0)
    finger.move(force_n=1.6)
    finger.move(force_n=2.0)
    finger.lift()


def swipe(finger: ScriptedFinger) -> None:
    finger.touch_down()
    for _ in range(3):
        finger.move(8.0)
    finger.lift()


def hand_lost(finger: ScriptedFinger) -> None:
    finger.touch_down()
    finger.move(8.0)
    finger.move(8.0)
    finger.vanish(3)


TOUCHES = {"tap": tap, "double tap": double_tap, "hard press": hard_press, "swipe": swipe, "hand lost": hand_lost}


def test_every_touch_of_the_page_is_tried() -> None:
    assert set(SHOWN) == set(TOUCHES)


@pytest.mark.parametrize("name", TOUCHES)
def test_it_happens_as_the_page_says(name: str) -> None:
    finger = ScriptedFinger(gestures=GestureConfig())
    finger.hover()
    perform: Callable[[ScriptedFinger], None] = TOUCHES[name]
    perform(finger)
    frames: dict[int, list[str]] = {}
    for event in finger.events:
        frames.setdefault(event.timestamp_ns, []).append(event.type.value)
    assert " | ".join(" ".join(kinds) for kinds in frames.values()) == SHOWN[name]
    assert finger.verifier.violations == []
