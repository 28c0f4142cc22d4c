import numpy as np
import pytest

pytest.importorskip("mitsuba")
pytest.importorskip("pygltflib")

from egotouch_sdk.joints import Finger
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.patches_job import participant
from egotouch_sdk.synthetic.render import SEGMENT_HOST, SEGMENT_TOUCHING
from egotouch_sdk.synthetic.series import SIDE_PX, draw_stage, render_series

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore:No LLVM")]


@pytest.fixture(scope="module")
def rigs(mesh_dir: object) -> tuple[HandRig, HandRig]:
    return HandRig("left"), HandRig("right")


@pytest.fixture(scope="module")
def series(rigs):
    return render_series(np.random.default_rng(5), *rigs, participant(1), samples=4, seed=5)


def test_a_series_holds_two_hovers_and_two_touches_from_two_views(series) -> None:
    assert [p.labels["touch"] for p in series] == [False] * 4 + [True] * 4
    assert all((p.labels["force_n"] > 0) == p.labels["touch"] for p in series)
    assert all((p.labels["hover_mm"] > 0) != p.labels["touch"] for p in series)


def test_every_patch_shows_the_fingertip_in_the_middle_pointing_up(series) -> None:
    centre = SIDE_PX // 2
    for p in series:
        segment = p.layers.segment
        assert segment[centre + 12, centre] == SEGMENT_TOUCHING
        assert (segment[centre:] == SEGMENT_TOUCHING).sum() > 2 * (segment[:centre] == SEGMENT_TOUCHING).sum()
        assert (segment == SEGMENT_HOST).sum() > 500


def test_light_is_finite_positive_and_near_one_on_skin(series) -> None:
    for p in series:
        light = p.layers.light
        assert np.isfinite(light).all() and light.min() >= 0
        assert 0.2 < np.median(light[p.layers.segment == SEGMENT_HOST][:, 2]) < 2.0


def test_pressing_dents_the_skin_more_with_more_force(rigs) -> None:
    stage = draw_stage(np.random.default_rng(2), *rigs, participant(1))
    dents = [stage.at(force_n=f).dent_mm for f in (0.2, 1.0, 3.0)]
    assert 0 < dents[0] < dents[1] < dents[2] < 9


def test_hovering_moves_the_finger_along_the_normal_and_leaves_the_skin_alone(rigs) -> None:
    stage = draw_stage(np.random.default_rng(2), *rigs, participant(1))
    near, far = stage.at(hover_mm=1.0), stage.at(hover_mm=11.0)
    assert near.host.vertices is far.host.vertices
    assert far.landmarks_m - near.landmarks_m == pytest.approx(np.tile(stage.normal * 0.010, (21, 1)), abs=1e-9)


def test_touching_fingers_vary(rigs) -> None:
    fingers = {draw_stage(np.random.default_rng(seed), *rigs, participant(1)).plan.finger for seed in range(12)}
    assert len(fingers & set(Finger)) >= 3
