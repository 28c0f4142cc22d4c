from __future__ import annotations

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import FrameError
from egotouch_sdk.patches import cut_patch, normalise

UP = (0.0, -1.0)
CENTRE = (49.5, 49.5)


def noise(height: int = 100, width: int = 100, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


def test_an_image_that_already_is_a_patch_comes_back_as_rgb() -> None:
    image = noise()
    np.testing.assert_array_equal(cut_patch(image, CENTRE, UP, 2.5, False), image[..., ::-1])


def test_mirroring_flips_left_and_right() -> None:
    image = noise()
    np.testing.assert_array_equal(cut_patch(image, CENTRE, UP, 2.5, True), image[:, ::-1, ::-1])


@pytest.mark.parametrize(("up", "turns"), [((0, -1), 0), ((1, 0), 1), ((0, 1), 2), ((-1, 0), 3)])
def test_the_finger_points_up_whatever_its_direction(up: tuple[float, float], turns: int) -> None:
    image = noise()
    np.testing.assert_array_equal(cut_patch(image, CENTRE, up, 2.5, False), np.rot90(image, turns)[..., ::-1])


def test_the_length_of_the_direction_does_not_matter() -> None:
    image = noise(200, 300)
    np.testing.assert_array_equal(cut_patch(image, (90, 80), (0.3, -0.4), 2, False), cut_patch(image, (90, 80), (30, -40), 2, False))


def test_beyond_the_image_its_border_is_repeated() -> None:
    image = np.full((100, 100, 3), 50, np.uint8)
    image[:, -1] = 200
    patch = cut_patch(image, (99.0, 49.5), UP, 2.5, False)
    assert (patch[:, 51:] == 200).all()
    assert (patch[:, :49] == 50).all()


def test_shrinking_does_not_alias() -> None:
    stripes = np.zeros((800, 800, 3), np.uint8)
    stripes[:, ::2] = 255
    patch = cut_patch(stripes, (400, 400), (0.6, -0.8), 10.0, False)
    assert 117 < patch.min() <= patch.max() < 138


def test_a_known_spot_lands_where_it_should() -> None:
    image = np.zeros((480, 640, 3), np.uint8)
    # 10 mm to the right of a finger that points right in the image is 10 mm down in the image.
    cv2.circle(image, (300, 200 + 40), 6, (255, 255, 255), -1)
    patch = cut_patch(image, (300, 200), (1, 0), 4.0, False)
    y, x = np.argwhere(patch[..., 0] > 128).mean(axis=0)
    assert (x, y) == pytest.approx((49.5 + 25, 49.5), abs=0.3)


@pytest.mark.parametrize("up", [(0, 0), (float("nan"), 1)])
def test_a_finger_without_direction_is_refused(up: tuple[float, float]) -> None:
    with pytest.raises(FrameError, match="direction"):
        cut_patch(noise(), CENTRE, up, 2.5, False)


@pytest.mark.parametrize("scale", [0.0, -1.0, float("inf"), float("nan")])
def test_an_impossible_scale_is_refused(scale: float) -> None:
    with pytest.raises(FrameError, match="px_per_mm"):
        cut_patch(noise(), CENTRE, UP, scale, False)


def test_normalise_is_its_formula() -> None:
    patches = np.stack([noise(seed=1), noise(seed=2) // 4])
    planes = patches.transpose(0, 3, 1, 2) / 255
    expected = [(p - p.mean()) / (p.std() + 0.05) for p in planes]
    np.testing.assert_allclose(normalise(patches), expected, atol=1e-5)


def test_normalise_cancels_exposure_but_keeps_a_flat_patch_flat() -> None:
    flat = np.full((1, 100, 100, 3), 90, np.uint8)
    assert np.abs(normalise(flat)).max() < 1e-5
    np.testing.assert_allclose(normalise(flat + noise()[None] // 2), normalise(20 + noise()[None] // 2), atol=1e-4)


def test_normalise_takes_an_empty_batch() -> None:
    assert normalise(np.zeros((0, 100, 100, 3), np.uint8)).shape == (0, 3, 100, 100)


@pytest.mark.parametrize(
    "bad", [np.zeros((1, 100, 100, 3), np.float32), np.zeros((100, 100, 3), np.uint8), np.zeros((1, 3, 100, 100), np.uint8)]
)
def test_normalise_refuses_other_shapes_and_types(bad: np.ndarray) -> None:
    with pytest.raises(FrameError, match="patches are"):
        normalise(bad)
