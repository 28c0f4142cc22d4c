"""Rendered films: truth of every frame, shards, and still frames that share a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mitsuba", reason="needs the extra [synthetic]")
pytest.importorskip("pygltflib", reason="needs the extra [synthetic]")

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.study_data import TouchType
from egotouch_sdk.synthetic.backdrop import draw_backdrop
from egotouch_sdk.synthetic.film_shards import write_films
from egotouch_sdk.synthetic.films_job import FilmsJob, run_films
from egotouch_sdk.synthetic.finger_motion import TRAINING_PACE, FingerMotion, contact_spans
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.lights import draw_lights
from egotouch_sdk.synthetic.moving_scene import FRAME_PX, MovingScene, film
from egotouch_sdk.synthetic.series import draw_stage
from egotouch_sdk.synthetic.skin import bake_identity
from egotouch_sdk.synthetic.training_film import FRAMES, LabelledFilm, draw_times, render_films
from egotouch_sdk.training.films import read_films

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore:Rendering takes")]
LEVEL = 3


@pytest.fixture(scope="module")
def films(mesh_dir: Path) -> list[LabelledFilm]:
    identity = bake_identity(0, 3.0, LEVEL)
    return render_films(np.random.default_rng(4), HandRig("left", LEVEL), HandRig("right", LEVEL), identity, samples=1, seed=0)


def test_a_pose_gives_two_films_with_a_truth_for_every_frame(films: list[LabelledFilm]) -> None:
    assert len(films) == 2
    for one in films:
        labels = one.labels
        assert {len(labels[name]) for name in ("shown", "touch", "force_n", "hover_mm", "velocity_px", "polar")} == {FRAMES}
        assert sorted(set(labels["shown"])) == list(range(len(one.layers))) and labels["shown"] == sorted(labels["shown"])
        touch, force_n, hover_mm = (np.array(labels[name]) for name in ("touch", "force_n", "hover_mm"))
        assert ((force_n > 0) == touch).all() and ((hover_mm > 0) == ~touch).all()
        for picture in one.layers:
            assert picture.segment.shape == (FRAME_PX, FRAME_PX) and picture.segment[FRAME_PX // 2 + 12, FRAME_PX // 2] == 2


def test_a_shard_gives_back_what_was_written(films: list[LabelledFilm], tmp_path: Path) -> None:
    who = {"participant": 7, "fitzpatrick": 3, "scene": "0-0"}
    write_films(tmp_path / "films-0.npz", [LabelledFilm(one.layers, {**one.labels, **who}) for one in films])
    for one, back in zip(films, read_films(tmp_path / "films-0.npz"), strict=True):
        assert back.label.participant == 7 and back.fps == one.labels["fps"]
        assert [label.touch for label in back.labels] == one.labels["touch"]
        for written, read in zip(one.layers, back.layers, strict=True):
            for name in ("light", "albedo", "segment", "depth_mm"):
                np.testing.assert_array_equal(getattr(read, name), getattr(written, name))


def test_a_resting_finger_needs_fewer_pictures_than_frames(mesh_dir: Path) -> None:
    rng = np.random.default_rng(5)
    stage = draw_stage(rng, HandRig("left", LEVEL), HandRig("right", LEVEL), bake_identity(0, 3.0, LEVEL))
    motion = FingerMotion(np.random.default_rng(1), TouchType.LIGHT_PRESS, 3.0)
    start, end = contact_spans(motion.at(np.arange(0, 3, 0.01)).touch)[0]
    lights = draw_lights(rng, stage.normal, stage.aim.up, stage.aim.view)
    scene = MovingScene(stage, lights, draw_backdrop(rng, stage.contact, stage.aim.view, stage.aim.up), motion, 0.1)
    resting = film(scene, np.linspace((start + 45) / 100, (end - 35) / 100, 8), 1, 0)
    landing = film(scene, np.linspace((start - 15) / 100, (start + 8) / 100, 8), 1, 0)
    assert len(resting.layers) <= 4 < len(landing.layers) == 8
    assert np.hypot(*resting.velocity_px.T).max() < 40 < np.hypot(*landing.velocity_px.T).max()


def test_most_films_hold_an_edge_of_a_touch() -> None:
    edges = 0
    for seed in range(120):
        rng = np.random.default_rng(seed)
        motion = FingerMotion(rng, TouchType.TAP, 2.2, TRAINING_PACE)
        times_s = draw_times(rng, motion, 30.0)
        assert len(times_s) == FRAMES and times_s[0] >= 0 and times_s[-1] <= 2.2 + 1e-9
        assert np.diff(times_s) == pytest.approx([1 / 30] * (FRAMES - 1))
        touch = motion.at(times_s).touch
        edges += bool(touch.any() and not touch.all())
    assert edges > 70


def test_a_finished_job_renders_nothing_again_and_another_is_refused(films: list[LabelledFilm], tmp_path: Path) -> None:
    write_films(tmp_path / "films-3-00000.npz", films)
    lines: list[str] = []
    assert run_films(FilmsJob(3, 4, 1, 1), tmp_path, LocalProcesses(1), lines.append).counted == 0
    with pytest.raises(ConfigError, match="another job"):
        run_films(FilmsJob(3, 8, 1, 1), tmp_path, LocalProcesses(1), lines.append)
