"""What the touch model remembers of a finger has nothing to do with other fingers."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate
from egotouch_sdk.touch import TouchModel, TouchStream
from tests.support.study import memory_model, told_patch

Key = tuple[int, Finger]
#: Milliseconds since the frame before, and how much each finger seen looks like a touch, in any order.
Shown = tuple[int, list[tuple[Key, float]]]

KEYS: tuple[Key, ...] = ((1, Finger.INDEX), (1, Finger.RING), (2, Finger.INDEX))
LOOKS = st.lists(st.tuples(st.sampled_from(KEYS), st.floats(-4, 4, width=32)), max_size=3, unique_by=lambda look: look[0])
FILMS = st.lists(st.tuples(st.integers(1, 200), LOOKS), max_size=12)


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> TouchModel:
    return TouchModel(memory_model(tmp_path_factory.mktemp("model")))


def judged(film: list[Shown], stream: TouchStream, fingers: tuple[Key, ...]) -> dict[Key, list[TouchEstimate]]:
    """The answers for each finger in order, when the stream is shown these fingers only."""
    told: dict[Key, list[TouchEstimate]] = {key: [] for key in fingers}
    timestamp_ns = 0
    for gap_ms, looks in film:
        timestamp_ns += gap_ms * 1_000_000
        patches = [told_patch(look, *key) for key, look in looks if key in fingers]
        for estimate in stream.estimate(patches, timestamp_ns):
            told[estimate.hand_id, estimate.finger].append(estimate)
    return told


@given(FILMS)
@settings(max_examples=50)
def test_a_finger_is_judged_the_same_whatever_other_fingers_are_seen(model: TouchModel, film: list[Shown]) -> None:
    together = judged(film, TouchStream(model, 150.0), KEYS)
    for key in KEYS:
        (alone,) = judged(film, TouchStream(model, 150.0), (key,)).values()
        assert [each.touch_probability for each in together[key]] == pytest.approx([each.touch_probability for each in alone], abs=1e-5)
        assert [each.force_n for each in together[key]] == pytest.approx([each.force_n for each in alone], abs=1e-5)


@given(FILMS, FILMS)
@settings(max_examples=25)
def test_reset_equals_new(model: TouchModel, before: list[Shown], after: list[Shown]) -> None:
    used = TouchStream(model, 150.0)
    judged(before, used, KEYS)
    used.reset()
    assert judged(after, used, KEYS) == judged(after, TouchStream(model, 150.0), KEYS)
