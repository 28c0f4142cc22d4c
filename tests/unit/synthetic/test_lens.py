from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

from egotouch_sdk.synthetic.lens import MAX_FIELD_RAD, Lens, draw_lens

OUTWARDS_RIGHT = Lens(field_rad=radians(35), outwards_rad=0.0, barrel=0.0, shading=0.0, fringe_px=0.0)


def test_on_its_axis_a_lens_does_nothing() -> None:
    middle = Lens(0.0, 1.0, 0.5, 1.0, 0.0)
    picture = np.random.default_rng(0).random((100, 100, 3)).astype(np.float32)
    assert np.allclose(middle.stretch(), np.eye(2)) and np.allclose(middle.fall_off(), 1.0)
    assert np.array_equal(middle.split_colours(picture), picture)


@pytest.mark.parametrize(("barrel", "longer"), [(0.0, "outwards"), (1.0, "along the rim")])
def test_a_pinhole_stretches_outwards_and_a_fisheye_along_the_rim(barrel: float, longer: str) -> None:
    stretch = replace(OUTWARDS_RIGHT, barrel=barrel).stretch()
    assert np.linalg.det(stretch) == pytest.approx(1.0)
    assert (stretch[0, 0] > 1.03) == (longer == "outwards") and (stretch[1, 1] > 1.03) == (longer != "outwards")


def test_a_pinhole_stretches_by_the_cosine_of_the_field() -> None:
    stretch = OUTWARDS_RIGHT.stretch()
    assert stretch[0, 0] / stretch[1, 1] == pytest.approx(1 / np.cos(radians(35)))


def test_stretch_turns_with_the_place_in_the_field() -> None:
    below = replace(OUTWARDS_RIGHT, outwards_rad=pi / 2).stretch()
    assert np.allclose(below, OUTWARDS_RIGHT.stretch()[::-1, ::-1])


def test_light_falls_off_outwards_and_keeps_the_middle() -> None:
    light = replace(OUTWARDS_RIGHT, shading=1.0).fall_off()[..., 0]
    assert (np.diff(light, axis=1) < 0).all() and np.allclose(np.diff(light, axis=0), 0)
    assert light[:, 49:51].mean() == pytest.approx(1.0, abs=0.01)
    assert light[0, 0] / light[0, -1] == pytest.approx(np.exp(4 * np.tan(radians(35)) * 0.1), rel=0.02)


def test_red_moves_outwards_and_blue_inwards() -> None:
    edge = np.zeros((100, 100, 3), np.float32)
    edge[:, 50:] = 1.0
    red, green, blue = np.moveaxis(replace(OUTWARDS_RIGHT, fringe_px=1.0).split_colours(edge), 2, 0)
    assert red[0, 49:53].tolist() == [0, 0, 1, 1] and green[0, 49:53].tolist() == [0, 1, 1, 1] and blue[0, 49:53].tolist() == [1, 1, 1, 1]


def test_drawn_lenses_fill_the_field_evenly_by_area() -> None:
    drawn = [draw_lens(np.random.default_rng(seed)) for seed in range(400)]
    share_inside_half = np.mean([lens.field_rad < MAX_FIELD_RAD / 2 for lens in drawn])
    assert share_inside_half == pytest.approx(0.25, abs=0.06)
    assert max(lens.field_rad for lens in drawn) <= MAX_FIELD_RAD
    assert max(abs(lens.fringe_px) for lens in drawn) <= 1.2
    assert all(0 <= lens.barrel <= 1 and 0 <= lens.shading <= 0.8 for lens in drawn)
