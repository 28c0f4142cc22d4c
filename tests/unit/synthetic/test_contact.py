import numpy as np
import pytest

pytest.importorskip("scipy")

from egotouch_sdk.synthetic.contact import HeightField, Tissue, dent_weight, press_pad, solve_dent

TISSUE = Tissue(stiffness_mm=3.0, skin_share=0.6, membrane_m=0.002, bulge=0.4)
BALL_M = 0.008


def flat_skin() -> HeightField:
    x, y = np.meshgrid(np.arange(-0.03, 0.03, 0.0004), np.arange(-0.03, 0.03, 0.0004))
    return HeightField(np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1), lowest=False)


def ball_points(sink_m: float) -> np.ndarray:
    rng = np.random.default_rng(0)
    points = rng.normal(size=(60_000, 3))
    points *= BALL_M / np.linalg.norm(points, axis=1, keepdims=True)
    return points[points[:, 2] < 0] + [0, 0, BALL_M - sink_m]


def press(force_n: float):
    sink = TISSUE.sink_m(force_n)
    points = ball_points(sink)
    return solve_dent(flat_skin(), HeightField(points, lowest=True), TISSUE), points, sink


def test_the_finger_sinks_by_hertz_law() -> None:
    assert TISSUE.sink_m(1.0) == pytest.approx(0.003)
    assert TISSUE.sink_m(8.0) / TISSUE.sink_m(1.0) == pytest.approx(4.0)


def test_the_skin_takes_its_share_under_the_tip() -> None:
    dent, _, sink = press(1.0)
    assert dent.depth_max_m == pytest.approx(0.6 * sink, rel=0.1)


def test_the_skin_far_away_stays_where_it_was() -> None:
    dent, _, _ = press(2.0)
    assert abs(dent.depth_at(np.array([[0.0235, 0.0, 0.0]]))[0]) < 1e-4
    assert dent.depth_at(np.array([[0.2, 0.0, 0.0]]))[0] == 0.0


def test_skin_wells_up_around_the_dimple() -> None:
    dent, _, _ = press(2.0)
    ring = np.array([[r, 0.0, 0.0] for r in np.linspace(dent.radius_m, 0.02, 40)])
    assert dent.depth_at(ring).min() < 0


def test_more_force_gives_a_deeper_and_wider_contact() -> None:
    dents = [press(f)[0] for f in (0.2, 0.5, 1.0, 2.0, 3.5)]
    assert np.all(np.diff([d.depth_max_m for d in dents]) > 0)
    assert np.all(np.diff([d.radius_m for d in dents]) > 0)


def test_the_pad_is_lifted_out_of_the_skin_and_nowhere_else() -> None:
    dent, points, sink = press(1.0)
    lift, _ = press_pad(points, np.full(len(points), -1.0), dent, sink)
    assert (lift >= 0).all()
    inside = points[:, 2] < dent.surface_at(points) - 1e-4
    assert (lift[inside] > 0).all() and (lift[~inside & (points[:, 2] > dent.surface_at(points) + 1e-4)] == 0).all()
    assert (points[inside, 2] + lift[inside] >= dent.surface_at(points[inside]) - 1e-9).all()


def test_the_far_side_of_the_limb_takes_no_dent() -> None:
    weights = dent_weight(np.array([1.0, -1.0]), np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -0.04]]))
    assert weights.tolist() == [1.0, 0.0]


def test_unknown_heights_are_not_invented() -> None:
    assert np.isnan(flat_skin().at(np.array([0.5]), np.array([0.5])))[0]
