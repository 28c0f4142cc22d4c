import math

import pytest

from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.filters import OneEuroFilter

STEP_NS = 100_000_000


def test_golden_table() -> None:
    """Casiez et al. 2012 with T = 0.1 s, minimum cutoff 1 Hz, beta 0.5, derivative cutoff 1 Hz, worked out apart from this code."""
    one_euro = OneEuroFilter(1.0, 0.5)
    got = [one_euro.apply((x,), i * STEP_NS)[0] for i, x in enumerate((0.0, 1.0, 1.0, 0.5))]
    assert got == pytest.approx([0.0, 0.647957170, 0.874250531, 0.697605411], abs=1e-9)


def test_without_beta_it_is_a_plain_low_pass() -> None:
    one_euro = OneEuroFilter(2.0, 0.0)
    one_euro.apply((0.0,), 0)
    share = 1 / (1 + 1 / (2 * math.pi * 2.0 * 0.1))
    assert one_euro.apply((1.0,), STEP_NS) == pytest.approx((share,))


def test_components_share_one_cutoff_so_a_straight_path_stays_straight() -> None:
    one_euro = OneEuroFilter(1.0, 0.1)
    for i in range(20):
        x, y = one_euro.apply((3.0 * i * i, 4.0 * i * i), i * STEP_NS)
        assert 4 * x == pytest.approx(3 * y)


def test_a_reset_filter_is_like_a_new_one() -> None:
    used = OneEuroFilter(1.0, 0.1)
    used.apply((5.0, 6.0), 0)
    used.apply((50.0, 60.0), STEP_NS)
    used.reset()
    new = OneEuroFilter(1.0, 0.1)
    for i, sample in enumerate([(1.0,), (2.0,), (-3.0,)]):
        assert used.apply(sample, i * STEP_NS) == new.apply(sample, i * STEP_NS)


def test_time_must_rise() -> None:
    one_euro = OneEuroFilter(1.0, 0.1)
    one_euro.apply((1.0,), 5)
    with pytest.raises(FrameError, match="order of time"):
        one_euro.apply((1.0,), 5)


@pytest.mark.parametrize(("cutoff", "beta"), [(0.0, 0.1), (math.nan, 0.1), (1.0, -1.0), (1.0, math.nan)])
def test_settings_out_of_range_are_refused(cutoff: float, beta: float) -> None:
    with pytest.raises(ConfigError):
        OneEuroFilter(cutoff, beta)
