import numpy as np

from egotouch_sdk.synthetic.air import clutter, in_the_air
from egotouch_sdk.synthetic.camera import LightLayers, photograph
from egotouch_sdk.synthetic.camera_settings import draw_settings


def test_the_hand_stays_and_the_host_is_gone() -> None:
    rng = np.random.default_rng(0)
    segment = np.ones((144, 144), np.uint8)
    segment[70:, 50:90] = 2
    before = LightLayers(
        rng.random((144, 144, 3)).astype(np.float16), rng.integers(0, 256, (144, 144, 3), np.uint8), segment, np.zeros((144, 144))
    )
    after = in_the_air(before, np.random.default_rng(1))
    hand = segment == 2
    assert np.array_equal(after.albedo[hand], before.albedo[hand]) and np.array_equal(after.light[hand], before.light[hand])
    assert set(np.unique(after.segment)) == {0, 2}
    assert (after.depth_mm[~hand] > 100).all() and (after.depth_mm[hand] == 0).all()
    assert (after.albedo[~hand] != before.albedo[~hand]).mean() > 0.9
    assert photograph(after, draw_settings(rng), rng).shape == (100, 100, 3)


def test_clutter_varies_with_its_seed() -> None:
    pictures = [clutter(144, np.random.default_rng(seed)).astype(float) for seed in range(20)]
    assert np.std([picture.mean() for picture in pictures]) > 20
    assert np.median([picture.std() for picture in pictures]) > 5
