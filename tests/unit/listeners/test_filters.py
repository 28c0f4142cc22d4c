import pytest

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.listeners.filters import EventFilter
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType
from tests.support.events import make_event

EVENT = make_event(EventType.DOWN)  # the right index finger on the palm


@pytest.mark.parametrize(
    ("wants", "accepted"),
    [
        (EventFilter.of(), True),
        (EventFilter.of(finger="index"), True),
        (EventFilter.of(finger=Finger.THUMB), False),
        (EventFilter.of(finger=["thumb", Finger.INDEX]), True),
        (EventFilter.of(hand={"left"}), False),
        (EventFilter.of(hand=Handedness.RIGHT, surface=(Surface.PALM, "back_of_hand")), True),
        (EventFilter.of(finger="index", surface="inner_forearm"), False),
    ],
)
def test_filters_take_one_value_or_several(wants: EventFilter, accepted: bool) -> None:
    assert wants.accepts(EVENT) is accepted


def test_an_unknown_name_is_met_with_the_nearest() -> None:
    with pytest.raises(ConfigError, match=r"there is no surface 'plam'\. Did you mean palm\?"):
        EventFilter.of(surface="plam")
    with pytest.raises(ConfigError, match="There are: left, right"):
        EventFilter.of(hand="third")


def test_an_empty_collection_is_refused() -> None:
    with pytest.raises(ConfigError, match="no finger is wanted"):
        EventFilter.of(finger=[])
