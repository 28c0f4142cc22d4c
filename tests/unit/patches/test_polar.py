from __future__ import annotations

from math import pi

import pytest

from egotouch_sdk.patches import HOST_UNKNOWN, polar

WRIST, KNUCKLE = (100.0, 200.0), (100.0, 100.0)


@pytest.mark.parametrize(
    ("tip", "expected"),
    [
        ((100, 100), (1.0, 0.0)),
        ((50, 200), (0.5, pi / 2)),
        ((200, 200), (1.0, -pi / 2)),
        ((100, 400), (2.0, pi)),
        ((0, 100), (2**0.5, pi / 4)),
        (WRIST, (0.0, 0.0)),
    ],
)
def test_counter_clockwise_as_seen_is_positive(tip: tuple[float, float], expected: tuple[float, float]) -> None:
    assert polar(WRIST, KNUCKLE, tip, False) == pytest.approx(expected)


def test_a_left_touching_hand_turns_the_sign() -> None:
    assert polar(WRIST, KNUCKLE, (50, 200), True) == pytest.approx((0.5, -pi / 2))
    assert polar(WRIST, KNUCKLE, (100, 400), True) == pytest.approx((2.0, pi))


def test_a_host_without_axis_is_unknown() -> None:
    assert polar(WRIST, (100.5, 200.0), (50, 50), False) == HOST_UNKNOWN == (0.0, 0.0)
