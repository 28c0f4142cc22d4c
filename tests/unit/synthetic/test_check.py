"""Statistics that tell renders from photographs."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk.cli.main import EXIT_ERROR, main
from egotouch_sdk.study_data import StudyRecipe, write_recipe, write_round
from egotouch_sdk.synthetic.check import STATISTICS, compare, crease, effect_size, hue, saturation, sharpness, table
from tests.support.study import study_round

SKIN = (205, 155, 127)


def patch(line: int = 0, noise: float = 0.0, colour: tuple[int, int, int] = SKIN, seed: int = 0) -> np.ndarray:
    """A patch of one colour with a dark curve of `line` codes over the tip and noise."""
    image = np.full((100, 100, 3), colour, np.float64)
    if line:
        curve = np.zeros((100, 100), np.float32)
        cv2.ellipse(curve, (50, 62), (16, 18), 0, 180, 360, 1.0, 2, cv2.LINE_AA)
        image -= line * curve[..., None]
    image += np.random.default_rng(seed).normal(0, noise, image.shape) if noise else 0
    return np.clip(image, 0, 255).astype(np.uint8)


def test_noise_is_sharp_and_a_plain_patch_is_not() -> None:
    assert sharpness(patch()) == 0 < sharpness(patch(noise=3)) < sharpness(patch(noise=9))


def test_a_dark_curve_over_the_tip_is_a_crease() -> None:
    values = [crease(patch(line)) for line in (0, 20, 60)]
    assert values[0] == 0 and values[0] < values[1] < values[2]


def test_colour_is_measured_in_degrees_and_percent() -> None:
    assert hue(patch(colour=(200, 100, 100))) == pytest.approx(0, abs=1)
    assert hue(patch(colour=(200, 100, 120))) < -5
    assert hue(patch(colour=(200, 150, 100))) == pytest.approx(30, abs=2)
    assert saturation(patch(colour=(200, 100, 100))) == pytest.approx(50, abs=1)


def test_effect_size_is_cohens_d() -> None:
    assert effect_size(np.array([1.0, 2.0, 3.0]), np.array([0.0, 1.0, 2.0])) == pytest.approx(1.0)
    assert effect_size(np.ones(3), np.ones(3)) == 0
    assert effect_size(np.ones(3), np.zeros(3)) == np.inf


def test_alike_sets_are_alike_and_others_differ() -> None:
    ours = np.stack([patch(line=10 + seed, noise=3 + seed % 4, seed=seed) for seed in range(20)])
    touch = np.arange(20) % 2 == 0
    rows = compare(ours, touch, ours[::-1], touch[::-1])
    assert len(rows) == 2 * len(STATISTICS) and {row.verdict for row in rows} == {"alike"}
    darker = compare(ours, touch, np.stack([patch(line=90, noise=2, colour=(90, 50, 40), seed=seed) for seed in range(20)]), touch)
    verdicts = {(row.statistic, row.kind): row.verdict for row in darker}
    assert verdicts["crease %", "touch"] == verdicts["saturation %", "hover"] == "differs"
    assert len(table(darker).splitlines()) == 1 + len(darker)


def test_wide_renders_around_real_patches_are_covered() -> None:
    wide = np.stack([patch(noise=1 + seed, seed=seed) for seed in range(30)])
    narrow = np.stack([patch(noise=6, seed=seed) for seed in range(30)])
    rows = {row.statistic: row for row in compare(wide, np.ones(30, bool), narrow, np.ones(30, bool))}
    assert rows["sharpness"].verdict == "covered" and rows["sharpness"].effect > 0.5
    assert {row.kind for row in rows.values()} == {"touch"}


def real_folder(folder: Path, count: int = 6) -> Path:
    """Finger-up pictures with labels: touches have the dark curve, hovers do not; one is of nothing."""
    folder.mkdir()
    rows = ["file,recording,frame,label,press_strength,label_confidence,force_sensor_counts"]
    for k in range(count):
        cv2.imwrite(str(folder / f"{k}.png"), patch(line=40 * (k % 2), noise=3, seed=k))
        rows.append(f"{k}.png,a,{k},{('hover', 'touch')[k % 2]},,0.9,")
    rows.append(f"none.png,a,{count},none,,0.9,")
    (folder / "labels.csv").write_text("\n".join(rows) + "\n")
    return folder


def test_the_command_compares_a_study_with_pictures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    study, real = tmp_path / "study", real_folder(tmp_path / "real")
    write_recipe(study, StudyRecipe(seed=0, fps=30.0, participants=1, rounds=1, seconds_per_round=1.0))
    write_round(study, study_round("........########" * 4))
    command = ["synth", "check", str(study), str(real), "--tip", "49.5,49.5", "--px-per-mm", "2.5"]
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "8 renders (4 touches) against 6 real patches (3 touches)"
    assert sum("touch" in line for line in lines[2:]) == sum("hover" in line for line in lines[2:]) == len(STATISTICS)
    assert main([*command, "--finger", "thumb"]) == EXIT_ERROR
    assert "no renders of that finger and place" in capsys.readouterr().err
    assert main(["synth", "check", str(real), str(real)]) == EXIT_ERROR
    assert "no shards and no study" in capsys.readouterr().err
