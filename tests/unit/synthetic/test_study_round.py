"""Rendered rounds: truth, reproducibility, what is worn; and the job that makes them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("mitsuba", reason="needs the extra [synthetic]")
pytest.importorskip("pygltflib", reason="needs the extra [synthetic]")

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.study_data import RECIPE_FILE, StudyRound, open_study, round_name, write_recipe, write_round
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.outfit import MARGIN_M, draw_outfit
from egotouch_sdk.synthetic.participants import PARTICIPANTS, study_skin
from egotouch_sdk.synthetic.strip import film_strip
from egotouch_sdk.synthetic.study_job import StudyJob, run_study
from egotouch_sdk.synthetic.study_plan import plan_round
from egotouch_sdk.synthetic.study_round import render_round
from egotouch_sdk.synthetic.wearables import WATCH_AT_M, Item, Ring, Sleeve, Watch, covers, dress

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore:Rendering takes")]
LEVEL = 3
#: Participant 0 presses the palm indoors; 12 frames reach the skin.
PLAN = plan_round(0, 0, 2, 0.4)


def fields_of(one: StudyRound) -> dict[str, Any]:
    return {name: getattr(one, name) for name in ("patches", "polar", "timestamp_ns", "touch", "force_n", "hover_mm", "gate")}


@pytest.fixture(scope="module")
def one_round(mesh_dir: Path) -> StudyRound:
    return render_round(PLAN, samples=2, level=LEVEL)


def test_a_round_tells_what_was_planned(one_round: StudyRound) -> None:
    meta = one_round.meta
    assert (meta.participant, meta.round, meta.place, meta.touch_type, meta.light) == (0, 2, PLAN.place, PLAN.touch_type, PLAN.light)
    assert meta.hair is PARTICIPANTS[0].hair and meta.fitzpatrick == PARTICIPANTS[0].fitzpatrick
    assert len(one_round.touch) == PLAN.frames == 12
    assert one_round.gate.all()
    assert np.diff(one_round.timestamp_ns).tolist() == pytest.approx([1e9 / 30] * 11, abs=1)
    assert one_round.touch.any() and not one_round.touch.all()
    assert [act["kind"] for act in meta.acts] == ["light_press"]


def test_frames_show_skin_that_moves_little_and_are_not_blank(one_round: StudyRound) -> None:
    assert (one_round.patches.std((1, 2, 3)) > 4).all()
    changes = np.abs(np.diff(one_round.patches.astype(float), axis=0)).mean((1, 2, 3))
    assert changes.min() > 0 and changes.max() < 60
    assert (one_round.polar[:, 0] > 0).all() and (one_round.polar[:, 0] < 3).all()
    r, theta = one_round.polar.T
    assert np.hypot(*np.diff([r * np.cos(theta), r * np.sin(theta)], axis=1)).max() < 0.2


def test_the_same_plan_gives_the_same_round_and_another_seed_another(mesh_dir: Path) -> None:
    short = replace(PLAN, seconds=0.06)
    first, second, other = (render_round(plan, samples=2, level=LEVEL) for plan in (short, short, replace(short, seed=1)))
    for name, values in fields_of(first).items():
        np.testing.assert_array_equal(fields_of(second)[name], values)
    assert np.abs(other.patches.astype(int) - first.patches).mean() > 5


def test_a_finished_study_renders_nothing_again_and_another_one_is_refused(tmp_path: Path, one_round: StudyRound) -> None:
    job = StudyJob(seed=0, participants=1, rounds=1, seconds=0.4)
    (plan,) = job.plans()
    tmp_path.joinpath("study").mkdir()
    write_round(tmp_path / "study", replace(one_round, meta=replace(one_round.meta, round=plan.number)))
    lines: list[str] = []
    result = run_study(job, tmp_path / "study", LocalProcesses(1), lines.append)
    assert (result.counted, result.exit_code) == (0, 0) and len(lines) == 1
    assert open_study(tmp_path / "study").expected == 1
    assert json.loads((tmp_path / "study" / RECIPE_FILE).read_text())["details"]["fitzpatrick"] == [3]
    with pytest.raises(ConfigError, match="another study"):
        run_study(StudyJob(1, 1, 1, 0.4), tmp_path / "study", LocalProcesses(1), lines.append)


def test_a_strip_shows_a_row_per_round(tmp_path: Path, one_round: StudyRound) -> None:
    with pytest.raises(SourceError, match=RECIPE_FILE):
        film_strip(tmp_path)
    write_recipe(tmp_path, StudyJob(0, 1, 1, 0.4).recipe)
    assert write_round(tmp_path, one_round).name == round_name(0, 2)
    assert film_strip(tmp_path, every=3).shape == (116, 400, 3)


@pytest.mark.parametrize("rounds", [0, 37])
def test_a_study_of_impossible_size_is_refused(rounds: int) -> None:
    with pytest.raises(ConfigError, match="no such study"):
        StudyJob(0, 15, rounds, 1.2)


@pytest.mark.parametrize("side", ["left", "right"])
def test_what_is_worn_lies_on_the_skin_and_leaves_the_rest_alone(mesh_dir: Path, side: str) -> None:
    rig, skin = HandRig(side, LEVEL), study_skin(0, LEVEL).sides[side]
    items: Sequence[Item] = (
        Ring(Handedness(side), Finger.RING, 3.0, (196, 158, 88)),
        Watch((28, 28, 30), (20, 20, 22), 38),
        Sleeve(0.12, (30, 60, 160), (220, 220, 220), 5.0),
    )
    dressed = dress(rig, skin, items, 3)
    raised = np.linalg.norm(dressed.vertices - skin.vertices, axis=1)
    z = rig.wrist_coords[:, 2]
    assert raised.max() < 0.009
    assert (raised[z > 0.14] > 0.0009).all()
    assert (raised[(z > -0.04) & (z < -0.01)] == 0).all()
    ring = (raised > 0.0005) & (z < -0.09)
    assert ring.any() and rig.finger_weight(Finger.RING)[ring].min() > 0.5
    changed = np.abs(dressed.albedo - skin.albedo).max(1) > 0.02
    assert not changed[(z > 0.06) & (z < 0.105)].any() and changed[z > 0.14].mean() > 0.9


def test_nothing_worn_comes_near_the_contact() -> None:
    sleeves = 0
    for seed in range(300):
        rng = np.random.default_rng(seed)
        at = np.array([0.0, -0.02, rng.uniform(-0.1, 0.17)])
        left, right = draw_outfit(rng, seed % 15, bool(seed % 2), at)
        assert not covers(left, at, MARGIN_M)
        sleeves += any(isinstance(item, Sleeve) for item in left)
        assert all(item.hand is Handedness.RIGHT for item in right if isinstance(item, Ring))
    assert 120 < sleeves < 210
    assert covers((Watch((0, 0, 0), None, 0),), np.array([0.0, 0.0, WATCH_AT_M + 0.02]), MARGIN_M)
