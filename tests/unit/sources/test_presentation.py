import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.sources.presentation import PresentationTimes, sound_fps


@pytest.mark.parametrize("announced", [0.0, -1.0, math.nan, math.inf, 90_000.0])
def test_nonsense_rates_count_as_unknown(announced: float) -> None:
    assert sound_fps(announced) is None


@pytest.mark.parametrize("announced", [0.5, 29.97, 1000.0])
def test_plausible_rates_are_kept(announced: float) -> None:
    assert sound_fps(announced) == announced


def test_first_frame_is_at_zero_and_variable_times_are_kept() -> None:
    times = PresentationTimes(30.0)
    assert [times.next_ns(ms) for ms in (500.0, 533.3, 633.3)] == [0, 33_300_000, 133_300_000]
    assert times.repaired == 0


def test_a_time_that_stands_still_is_replaced_by_one_frame() -> None:
    times = PresentationTimes(25.0)
    assert [times.next_ns(0.0) for _ in range(3)] == [0, 40_000_000, 80_000_000]
    assert times.repaired == 2


def test_an_unknown_rate_steps_by_a_thirtieth_of_a_second() -> None:
    times = PresentationTimes(None)
    times.next_ns(math.nan)
    assert times.next_ns(math.nan) == 33_333_333


def test_a_constant_rate_ignores_the_stated_times_and_does_not_drift() -> None:
    times = PresentationTimes(30.0, constant_fps=60.0)
    stamps = [times.next_ns(1e6 * index) for index in range(3601)]
    assert stamps[-1] == 60_000_000_000


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=1, max_size=40))
def test_whatever_a_file_states_timestamps_rise_strictly_from_zero(stated_ms: list[float]) -> None:
    times = PresentationTimes(30.0)
    stamps = [times.next_ns(ms) for ms in stated_ms]
    assert stamps[0] == 0
    assert all(a < b for a, b in itertools.pairwise(stamps))
