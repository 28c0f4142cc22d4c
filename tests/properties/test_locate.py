"""Whatever two hands look like, a place is finite and in range, or there is none."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.host_frame import locate
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HandObservation, TouchPair


@given(
    seed=st.integers(0, 2**32 - 1),
    spread_px=st.sampled_from([0.0, 1e-6, 1e-3, 1.0, 300.0, 1e5]),
    flatness=st.sampled_from([(1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1e-7)]),
    side=st.sampled_from(Handedness),
    finger=st.sampled_from(Finger),
    mirrored=st.booleans(),
)
def test_any_hands_give_a_point_in_range_or_none(
    seed: int, spread_px: float, flatness: tuple[float, float], side: Handedness, finger: Finger, mirrored: bool
) -> None:
    rng = np.random.default_rng(seed)
    host, touching = rng.normal(0, spread_px, (2, 21, 3)) * (*flatness, 1.0) + (320.0, 240.0, 0.0)
    flat = np.zeros((21, 3))
    touching_hand, host_hand = HandObservation(1, side.other, 1.0, touching, flat), HandObservation(2, side, 1.0, host, flat)
    pair = TouchPair(touching_hand, host_hand, 0.0, (finger,))
    point = locate(pair, finger, mirrored=mirrored)
    if spread_px == 0.0:
        assert point is None
    elif point is not None:
        assert -1e9 < point.x_mm < 1e9
        assert -1e9 < point.y_mm < 1e9
