from __future__ import annotations

import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.listeners import Delivery, Listeners, TouchListener
from egotouch_sdk.listeners.touch_listener import LISTENER_NAMES
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.events import make_event


class Desk(Listeners):
    """Listeners without a source: the test says what happens."""

    def __init__(self) -> None:
        super().__init__()
        self.delivery = Delivery(self._registry, lambda: 0)

    def happens(self, *types: EventType, **fields: object) -> None:
        for event_type in types:
            self.delivery.deliver(make_event(event_type, **fields))


def test_there_is_a_registrar_for_every_name() -> None:
    assert all(callable(getattr(Desk(), name)) for name in LISTENER_NAMES)


def test_a_decorated_function_listens_and_can_still_be_called() -> None:
    desk, seen = Desk(), []

    @desk.onTouchDown
    def down(event: TouchEvent) -> str:
        """Say so."""
        seen.append(event.type)
        return "called"

    desk.happens(EventType.DOWN, EventType.MOVE)
    assert seen == [EventType.DOWN]
    assert down(make_event(EventType.DOWN)) == "called"
    assert down.__doc__ == "Say so."


def test_decorators_stack() -> None:
    desk, seen = Desk(), []

    @desk.onTouchDown
    @desk.onTouchUp
    def touch(event: TouchEvent) -> None:
        seen.append(event.type)

    desk.happens(EventType.DOWN, EventType.UP)
    assert seen == [EventType.DOWN, EventType.UP]


def test_filters_work_in_the_call_and_in_the_decorator() -> None:
    desk, seen = Desk(), []
    desk.onClick(lambda event: seen.append("call"), finger="index")
    desk.onClick(finger="thumb")(lambda event: seen.append("decorator"))
    desk.happens(EventType.CLICK)
    desk.happens(EventType.CLICK, finger="thumb")
    assert seen == ["call", "decorator"]


def test_listeners_are_called_in_the_order_in_which_they_were_added() -> None:
    desk, seen = Desk(), []
    for number in range(3):
        desk.onDrag(lambda event, number=number: seen.append(number))
    desk.happens(EventType.DRAG)
    assert seen == [0, 1, 2]


def test_a_subscription_ends_once_and_with_its_block() -> None:
    desk, seen = Desk(), []
    with desk.onFling(seen.append) as subscription:
        desk.happens(EventType.FLING)
    desk.happens(EventType.FLING)
    subscription.remove()
    assert len(seen) == 1
    assert not subscription.is_active


def test_a_listener_may_remove_itself_and_others_while_called() -> None:
    desk, seen = Desk(), []

    @desk.onTouchDown
    def first(event: TouchEvent) -> None:
        seen.append("first")
        first.remove()
        second.remove()
        desk.onTouchDown(lambda event: seen.append("third"))

    @desk.onTouchDown
    def second(event: TouchEvent) -> None:
        seen.append("second")

    desk.happens(EventType.DOWN)
    assert seen == ["first"]
    desk.happens(EventType.DOWN)
    assert seen == ["first", "third"]


class Everything(TouchListener):
    def __init__(self) -> None:
        self.seen: list[str] = []

    def onTouchDown(self, event: TouchEvent) -> None:
        self.seen.append("down")

    def onForce(self, event: TouchEvent) -> None:
        self.seen.append(event.type)


def test_a_listener_object_gets_what_it_overrides_until_removed() -> None:
    desk, listener = Desk(), Everything()
    subscription = desk.addListener(listener, surface="palm")
    desk.happens(EventType.DOWN, EventType.MOVE, EventType.FORCE_ENTER, EventType.FORCE_CHANGE, EventType.FORCE_EXIT)
    desk.happens(EventType.DOWN, surface="back_of_hand")
    subscription.remove()
    desk.happens(EventType.DOWN)
    assert listener.seen == ["down", "force_enter", "force_change", "force_exit"]


@pytest.mark.parametrize(("wrong", "hint"), [(Everything, "Everything()"), (object(), "Derive its class")])
def test_only_listener_objects_are_added(wrong: object, hint: str) -> None:
    with pytest.raises(ConfigError, match="no TouchListener object") as caught:
        Desk().addListener(wrong)  # type: ignore[arg-type]
    assert hint in caught.value.hint


def test_the_single_raw_listener_comes_first_and_is_replaced() -> None:
    desk, seen = Desk(), []

    class Raw:
        def onTouch(self, event: TouchEvent) -> bool:
            seen.append(f"object {event.type}")
            return True

    desk.onTouchDown(lambda event: seen.append("onTouchDown"))
    desk.setOnTouchListener(Raw())
    desk.happens(EventType.DOWN, EventType.MOVE, EventType.DRAG, EventType.UP, EventType.CLICK, EventType.CANCEL, EventType.HOVER_MOVE)
    assert seen == ["object down", "onTouchDown", "object move", "object up", "object cancel"]
    seen.clear()
    desk.setOnTouchListener(lambda event: seen.append("function"))
    desk.happens(EventType.UP)
    desk.setOnTouchListener(None)
    desk.happens(EventType.UP)
    assert seen == ["function"]


def test_coroutine_functions_are_sent_to_events() -> None:
    async def listener(event: TouchEvent) -> None:
        pass

    with pytest.raises(ConfigError, match=r"async for event in et\.events"):
        Desk().onTouchUp(listener)
    with pytest.raises(ConfigError, match="cannot be called"):
        Desk().onTouchUp(3)  # type: ignore[call-overload]
