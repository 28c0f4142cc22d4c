import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.listeners import TouchListener
from egotouch_sdk.listeners.touch_listener import LISTENER_NAMES, METHODS
from egotouch_sdk.touch_event import EventType
from tests.support.events import make_event


def test_every_event_has_a_method_and_every_method_a_name() -> None:
    assert set(METHODS) == set(EventType)
    assert set(LISTENER_NAMES) == {name for name in vars(TouchListener) if name.startswith("on")}


def test_methods_do_nothing_unless_overridden() -> None:
    listener = TouchListener()
    assert [getattr(listener, name)(make_event(EventType.DOWN)) for name in LISTENER_NAMES] == [None] * len(LISTENER_NAMES)


def test_a_name_in_wrong_capitals_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"Typo\.onTouchdown would never be called\. Name it onTouchDown"):
        type("Typo", (TouchListener,), {"onTouchdown": print})
