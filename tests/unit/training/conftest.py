"""A tiny set of drawn, not rendered, fingertips: enough to run every step, far too simple to learn from."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

SIDE = 144


def draw_shard(path: Path, participant: int, count: int = 12) -> None:
    rng = np.random.default_rng(participant)
    y, x = np.mgrid[:SIDE, :SIDE]
    finger = ((np.abs(x - 72) < 25) & (y > 82)) | (np.hypot(x - 72, y - 85) < 25)
    segment = np.where(finger, 2, 1).astype(np.uint8)
    distance = cv2.distanceTransform((segment == 1).astype(np.uint8), cv2.DIST_L2, 3)
    light, metas = [], []
    for i in range(count):
        touch = i % 2 == 0
        shade = np.where(finger, 1.0, 1.0 - (0.6 if touch else 0.15) * np.exp(-distance / 4))
        light.append(np.repeat(shade[..., None], 3, 2).astype(np.float16))
        metas.append(
            {
                "touch": touch, "force_n": float(rng.uniform(0.2, 3.5)) if touch else 0.0, "hover_mm": 0.0 if touch else 8.0,
                "finger": "index", "place": "palm", "participant": participant, "fitzpatrick": 3, "scene": f"{participant}-{i // 4}",
                "light": "panel", "r_palms": 0.9, "theta_rad": 0.3, "pitch_rad": 0.5, "seed": i,
            }
        )  # fmt: skip
    albedo = np.where(segment[..., None] == 2, [205, 150, 125], [210, 150, 140]).astype(np.uint8)
    np.savez(
        path, light=np.stack(light), albedo=np.repeat(albedo[None], count, 0), segment=np.repeat(segment[None], count, 0),
        depth_mm=np.zeros((count, SIDE, SIDE), np.float16), meta=np.array(json.dumps(metas)),
    )  # fmt: skip


def draw_films(path: Path, participant: int) -> None:
    """Two films of four frames, three pictures each, made of a shard's pictures; the finger comes down in the third frame."""
    draw_shard(path, participant, count=6)
    with np.load(path) as drawn:
        arrays = {name: drawn[name][:, 6:138, 6:138] for name in ("light", "albedo", "segment", "depth_mm")}
    who = {"finger": "index", "place": "palm", "participant": participant, "fitzpatrick": 3}
    metas = [
        {
            **who, "scene": f"{participant}-{k}", "fps": 30.0, "first": 3 * k, "pictures": 3, "shown": [1, 1, 0, 2],
            "touch": [False, False, True, True], "force_n": [0.0, 0.0, 0.6, 1.4], "hover_mm": [8.0, 3.0, 0.0, 0.0],
            "velocity_px": [[4.0, -300.0], [2.0, -200.0], [0.0, 0.0], [0.0, 0.0]], "polar": [[0.9, 0.3]] * 4,
        }
        for k in range(2)
    ]  # fmt: skip
    np.savez(path, **arrays, meta=np.array(json.dumps(metas)))


@pytest.fixture(scope="session")
def film_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("films")
    for participant in range(4):
        draw_films(folder / f"films-{participant}.npz", participant)
    return folder


@pytest.fixture(scope="session")
def shard_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("shards")
    for participant in range(4):
        draw_shard(folder / f"shard-{participant}.npz", participant)
    return folder
