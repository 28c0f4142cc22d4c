import numpy as np
import pytest

from egotouch_sdk.synthetic.coding import through_h264, through_jpeg

pytest.importorskip("av", reason="H.264 needs PyAV")


def texture(side: int, seed: int = 0) -> np.ndarray:
    """Skin-like: a slope with fine grain."""
    slope = np.linspace(90, 180, side)[None, :, None] + np.array([30, 0, -20])
    grain = np.random.default_rng(seed).normal(0, 12, (side, side, 1))
    return np.clip(slope + grain, 0, 255).astype(np.uint8)


def error(coded: np.ndarray, picture: np.ndarray) -> float:
    return float(np.abs(coded.astype(float) - picture).mean())


@pytest.mark.parametrize("side", [21, 64, 77, 100])
def test_pictures_of_any_size_come_back_in_order_and_alike(side: int) -> None:
    film = [np.full((side, side, 3), level, np.uint8) for level in (40, 120, 200)]
    coded = through_h264(film, 18)
    assert [picture.shape for picture in coded] == [(side, side, 3)] * 3 and all(picture.dtype == np.uint8 for picture in coded)
    assert [round(float(picture.mean()), -1) for picture in coded] == [40, 120, 200]


def test_a_higher_rate_factor_keeps_less() -> None:
    picture = texture(80)
    errors = [error(through_h264([picture], crf)[0], picture) for crf in (10, 23, 36)]
    assert errors[0] < errors[1] < errors[2]


def test_a_frame_that_shows_what_was_there_before_costs_nothing_more() -> None:
    picture = texture(80)
    first, second = through_h264([picture, picture], 26)
    assert error(second, picture) <= error(first, picture) + 0.1


def test_the_same_film_gives_the_same_bits() -> None:
    film = [texture(50, seed) for seed in range(4)]
    assert all(np.array_equal(a, b) for a, b in zip(through_h264(film, 25), through_h264(film, 25), strict=True))


def test_jpeg_keeps_colours_in_their_order() -> None:
    picture = np.tile(np.array([200, 100, 50], np.uint8), (32, 32, 1))
    assert np.abs(through_jpeg(picture, 95).astype(int) - picture).max() <= 4
