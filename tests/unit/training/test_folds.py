"""Folds and trials as jobs on a worker process."""

from __future__ import annotations

import json
import multiprocessing as mp
import os
import signal
import sys
import threading
import time
from pathlib import Path

import pytest

pytest.importorskip("torch")
pytest.importorskip("lightning")
pytest.importorskip("onnx")

from hypothesis import given
from hypothesis import strategies as st

from egotouch_sdk.cli.main import main
from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.evaluation.folds import read_folds
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.touch import TouchModel
from egotouch_sdk.training.folds import deal, fold_scores, participants_in, train_folds
from egotouch_sdk.training.recipe import Recipe
from egotouch_sdk.training.run import Machine
from egotouch_sdk.training.table import score_table
from egotouch_sdk.training.trials import read_trials, train_trials, trial_scores

pytestmark = pytest.mark.slow
TINY = Recipe(epochs=1, picture_px=32, batch=8, held_out_views=1, held_out_share=0.2)
MACHINE = Machine(threads=1, workers=0)


@given(st.sets(st.integers(0, 99), min_size=2, max_size=20), st.data(), st.integers(0, 9))
def test_every_participant_is_left_out_once(participants: set[int], data: st.DataObject, seed: int) -> None:
    folds = data.draw(st.integers(2, len(participants)))
    groups = deal(participants, folds, seed)
    assert sorted(number for group in groups for number in group) == sorted(participants)
    sizes = [len(group) for group in groups]
    assert len(groups) == folds and max(sizes) - min(sizes) <= 1
    assert groups == deal(participants, folds, seed)


@pytest.mark.parametrize("folds", [1, 4])
def test_folds_that_cannot_be_are_refused(folds: int) -> None:
    with pytest.raises(ConfigError, match=f"{folds} folds of 3 participants"):
        deal({1, 2, 3}, folds, 0)


def test_folds_of_nothing_say_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="egotouch synth patches"):
        participants_in(tmp_path)
    (tmp_path / "shard.npz").write_bytes(b"PK torn")
    with pytest.raises(SourceError, match=r"shard\.npz is not a readable shard"):
        participants_in(tmp_path)


@pytest.mark.timeout(600)
def test_a_fold_never_sees_its_participants_and_is_trained_once(shard_folder: Path, tmp_path: Path) -> None:
    lines: list[str] = []
    result = train_folds(shard_folder, tmp_path, 2, TINY, MACHINE, LocalProcesses(1), lines.append)
    assert result.exit_code == 0 and sorted(result.new) == ["fold-0", "fold-1"]
    folds = read_folds(tmp_path / "folds.json")
    folds.check(range(4))
    for number in (0, 1):
        folder = tmp_path / f"fold-{number}"
        left_out = json.loads((folder / "run.json").read_text())["left_out"]
        assert [who for who in range(4) if folds.model_of(who) == folder / "touch.onnx"] == left_out
        training = json.loads((folder / "touch.json").read_text())["training"]
        assert training["patches"] < 24 and training["participants"] <= 2
        assert "epoch 1/1" in (folder / "train.log").read_text()
        TouchModel(folder / "touch.onnx")
    scores = fold_scores(tmp_path)
    assert [row["pictures"] for row in scores.values()] == [24, 24]
    table = score_table(scores, mean=True).splitlines()
    assert [line.split()[0] for line in table] == ["pictures", "fold-0", "fold-1", "mean"]
    assert table[-1].split()[1] == "48"

    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("touch.onnx")}
    assert train_folds(shard_folder, tmp_path, 2, TINY, MACHINE, LocalProcesses(1), lines.append).new == ()
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("touch.onnx")} == before
    with pytest.raises(ConfigError, match="other folds"):
        train_folds(shard_folder, tmp_path, 3, TINY, MACHINE, LocalProcesses(1), lines.append)
    with pytest.raises(ConfigError, match="other settings"):
        train_folds(shard_folder, tmp_path, 2, Recipe(epochs=9), MACHINE, LocalProcesses(1), lines.append)


@pytest.mark.timeout(600)
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_killed_trial_goes_on_from_its_last_epoch_and_the_best_comes_first(shard_folder: Path, tmp_path: Path) -> None:
    (tmp_path / "trials.toml").write_text("[recipe]\nbatch = 12\n[trials.long]\nepochs = 3\n[trials.still]\nlearning_rate = 1e-9\n")
    recipes = read_trials(tmp_path / "trials.toml", TINY)
    assert {name: (recipe.batch, recipe.epochs) for name, recipe in recipes.items()} == {"long": (12, 3), "still": (12, 1)}
    out, lines = tmp_path / "out", list[str]()

    def kill_after_first_epoch() -> None:
        for _ in range(20_000):
            if list(out.glob(".long.*.part/last.ckpt")):
                for worker in mp.active_children():
                    os.kill(worker.pid or 0, signal.SIGKILL)
                return
            time.sleep(0.02)

    killer = threading.Thread(target=kill_after_first_epoch)
    killer.start()
    result = train_trials(shard_folder, out, recipes, MACHINE, LocalProcesses(1), lines.append)
    killer.join()
    assert result.exit_code == 0 and sorted(result.new) == ["long", "still"]
    assert "long failed, will be tried again: its worker was killed by SIGKILL" in lines
    log = (out / "long" / "train.log").read_text()
    assert log.count("epoch 1/3") == 1 and log.count("epoch 3/3") == 1
    assert json.loads((out / "long" / "touch.json").read_text())["training"]["epochs_done"] == 3
    assert sorted(path.name for path in out.iterdir() if not path.name.endswith(".lock")) == ["long", "still"]

    scores = trial_scores(out, [*recipes, "missing"])
    assert sorted(scores) == ["long", "still"]
    aurocs = [row["auroc"] for row in scores.values()]
    assert aurocs == sorted(aurocs, reverse=True)
    assert [line.split()[0] for line in score_table(scores, mean=False).splitlines()] == ["pictures", *scores]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "no list of trials"),
        ("[trials]", "no list of trials"),
        ("[trial.a]", "no list of trials"),
        ("x = ", "cannot read"),
        ("[trials.a]\nepoch = 3", r"\[trials.a\] has the unknown field epoch"),
        ("[trials.a]\nepochs = 0", "epochs=0"),
        ("[trials.a]\nepochs = 'all'", r"\[trials.a\] has a value of the wrong type"),
        ("[trials]\na = 3", "trials.a is not a table"),
        ("[trials.a]\nheld_out_share = 0.5", "changes held_out_share"),
    ],
)
def test_trials_that_make_no_sense_are_refused(text: str, problem: str, tmp_path: Path) -> None:
    (tmp_path / "trials.toml").write_text(text)
    with pytest.raises(ConfigError, match=problem):
        read_trials(tmp_path / "trials.toml", TINY)


def test_a_single_run_takes_no_cluster(shard_folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["train", "--data", str(shard_folder), "--out", str(tmp_path / "out"), "--ray", "local"]) == 1
    assert "--ray and --jobs are for --folds and --trials" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_command_says_which_data_is_missing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["train", "--data", str(tmp_path), "--out", str(tmp_path / "out"), "--folds", "2"]) == 1
    assert "no rendered patches in" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
