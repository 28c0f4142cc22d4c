"""A client's capture times on the server's clock."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

from egotouch_sdk.server.client_clock import ClientClock

MS = 1_000_000
FRAME_NS = 33 * MS
OFFSET_NS = 86_400_000 * MS


def errors_ms(
    seconds: int, *, drift_ppm: float = 0.0, least_ms: float = 3.0, jitter_ms: float = 20.0, late_first_ms: float = 0.0
) -> list[float]:
    """How late each mapped time is against the true capture time, for frames whose way takes `least_ms` and more."""
    chance, clock = random.Random(5), ClientClock()
    errors, mapped = [], []
    for index in range(seconds * 30):
        true_ns = OFFSET_NS + index * FRAME_NS
        captured_ns = round(index * FRAME_NS * (1 + drift_ppm * 1e-6))
        way_ms = least_ms + chance.uniform(0, jitter_ms) + (late_first_ms if index == 0 else 0.0)
        mapped.append(clock.to_server(captured_ns, true_ns + round(way_ms * MS)))
        errors.append((mapped[-1] - true_ns) / MS)
    assert all(0.89 * FRAME_NS < late - early < 1.11 * FRAME_NS for early, late in pairwise(mapped))
    return errors


def test_jitter_goes_away_and_the_shortest_way_stays() -> None:
    settled = errors_ms(30)[150:]
    assert min(settled) >= 3.0 and max(settled) < 5.0


@pytest.mark.parametrize("drift_ppm", [-200.0, 200.0])
def test_a_clock_that_drifts_is_followed(drift_ppm: float) -> None:
    settled = errors_ms(300, drift_ppm=drift_ppm)[150:]
    assert max(abs(error - 3.0) for error in settled) < 7.0


def test_a_late_first_frame_is_made_up_for_without_a_jump() -> None:
    errors = errors_ms(30, late_first_ms=400.0)
    assert errors[0] > 400.0 and max(errors[200:]) < 5.0


def test_lag_tells_a_wrong_time() -> None:
    clock = ClientClock()
    assert clock.lag_ns(0, 7) == 0
    clock.to_server(0, OFFSET_NS)
    assert clock.lag_ns(FRAME_NS, OFFSET_NS + FRAME_NS + 5) == 5
    assert clock.lag_ns(3_600_000 * MS, OFFSET_NS) == -3_600_000 * MS
