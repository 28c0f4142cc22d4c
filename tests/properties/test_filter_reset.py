"""A filter that was reset behaves like a new one."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.filters import MedianFilter
from egotouch_sdk.joints import FINGERS
from egotouch_sdk.observation import TouchEstimate

ESTIMATES = st.builds(TouchEstimate, st.integers(1, 2), st.sampled_from(FINGERS[:2]), st.floats(0, 1), st.floats(0, 3.5))
FRAMES = st.lists(st.lists(ESTIMATES, max_size=3, unique_by=lambda e: (e.hand_id, e.finger)), max_size=12)


@given(FRAMES, FRAMES)
def test_reset_equals_new(before: list[list[TouchEstimate]], after: list[list[TouchEstimate]]) -> None:
    used, new = MedianFilter(), MedianFilter()
    for frame in before:
        used.apply(frame)
    used.reset()
    assert [used.apply(frame) for frame in after] == [new.apply(frame) for frame in after]


@given(FRAMES)
def test_every_output_is_one_of_the_last_three_inputs(frames: list[list[TouchEstimate]]) -> None:
    median, seen = MedianFilter(max_gap_frames=100), {}
    for frame in frames:
        for before, after in zip(frame, median.apply(frame), strict=True):
            history = seen.setdefault((before.hand_id, before.finger), [0.0, 0.0, 0.0])
            history.append(before.touch_probability)
            assert after.touch_probability == sorted(history[-3:])[1]
