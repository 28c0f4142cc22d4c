import numpy as np
import pytest

from egotouch_sdk.synthetic.lights import Lights, draw_lights

NORMAL, UP, VIEW = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), np.array([0.1, 0.0, 0.995])


def irradiance(radiance: np.ndarray, lights: Lights) -> float:
    """By brute force: sum the map's pixels over the hemisphere around the normal."""
    rows, cols = radiance.shape
    total = 0.0
    for i in range(rows):
        theta = (i + 0.5) / rows * np.pi
        for j in range(cols):
            phi = (j + 0.5) / cols * 2 * np.pi
            local = np.array([np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)])
            facing = max(float(lights.rotation @ local @ NORMAL), 0.0)
            total += radiance[i, j] * facing * np.sin(theta) * (np.pi / rows) * (2 * np.pi / cols)
    return total / np.pi


@pytest.mark.parametrize("seed", range(4))
def test_white_skin_in_the_open_reads_one_under_windows_and_under_the_room(seed: int) -> None:
    lights = draw_lights(np.random.default_rng(seed), NORMAL, UP, VIEW)
    assert irradiance(lights.windows, lights) == pytest.approx(1.0, rel=0.01)
    assert irradiance(lights.room, lights) == pytest.approx(1.0, rel=0.01)


@pytest.mark.parametrize("seed", range(40))
def test_the_key_light_shines_on_the_skin(seed: int) -> None:
    lights = draw_lights(np.random.default_rng(seed), NORMAL, UP, VIEW)
    assert lights.key_direction @ NORMAL > 0.3
    assert np.linalg.norm(lights.key_direction) == pytest.approx(1.0)
    assert lights.rotation @ lights.rotation.T == pytest.approx(np.eye(3), abs=1e-9)


def test_the_same_seed_gives_the_same_light() -> None:
    a, b = (draw_lights(np.random.default_rng(3), NORMAL, UP, VIEW) for _ in range(2))
    assert a.kind == b.kind and np.array_equal(a.windows, b.windows) and np.array_equal(a.key_direction, b.key_direction)
