import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy")

from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.jobs import BatchResult
from egotouch_sdk.jobs.local import LocalProcesses
from egotouch_sdk.synthetic.patches_job import PatchJob, run
from egotouch_sdk.synthetic.render import Layers
from egotouch_sdk.synthetic.series import LabelledLayers
from egotouch_sdk.synthetic.shards import write_shard
from egotouch_sdk.synthetic.sheet import contact_sheet
from egotouch_sdk.synthetic.srgb import linear_to_srgb

SIDE = 144


def patch(value: float, touch: bool) -> LabelledLayers:
    plane = np.full((SIDE, SIDE), value, np.float32)
    colour = np.repeat(plane[..., None], 3, 2)
    segment = np.ones((SIDE, SIDE), np.uint8)
    labels = {"touch": touch, "force_n": 1.0 if touch else 0.0, "hover_mm": 0.0 if touch else 5.0}
    return LabelledLayers(Layers(colour, colour, segment, plane), labels)


def test_a_shard_reads_back_as_it_was_written(tmp_path: Path) -> None:
    write_shard(tmp_path / "shard-0-00000.npz", [patch(0.25, True), patch(0.5, False)])
    with np.load(tmp_path / "shard-0-00000.npz") as shard:
        assert shard["light"].shape == shard["albedo"].shape == (2, SIDE, SIDE, 3)
        assert shard["light"].dtype == np.float16 and shard["light"][1, 0, 0, 0] == 0.5
        assert shard["albedo"].dtype == np.uint8 and shard["segment"].dtype == np.uint8
        assert (shard["depth_mm"] == 0).all()
        assert [m["touch"] for m in json.loads(str(shard["meta"]))] == [True, False]
    assert [p.name for p in tmp_path.iterdir()] == ["shard-0-00000.npz"]


def test_srgb_codes_are_the_standard_ones() -> None:
    assert linear_to_srgb(np.array([0.0, 0.0021, 0.2140, 1.0, 2.0])).tolist() == [0, 7, 127, 255, 255]


def test_another_jobs_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "job-0.json").write_text(json.dumps({"seed": 0, "series": 5, "participants": 2, "samples": 9}))
    with pytest.raises(ConfigError, match="another job"):
        run(PatchJob(0, 8, 2, 9), tmp_path, LocalProcesses(1), lambda line: None)


def test_a_finished_job_renders_nothing_again(tmp_path: Path) -> None:
    write_shard(tmp_path / "shard-0-00000.npz", [patch(0.25, True)])
    lines: list[str] = []
    assert run(PatchJob(0, 8, 2, 9), tmp_path, LocalProcesses(1), lines.append) == BatchResult(0, (), ())
    assert lines == ["1 of 1 shards are there, 0 to make on 1 process"]


def test_a_sheet_of_nothing_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="egotouch synth patches"):
        contact_sheet(tmp_path)


def test_a_sheet_shows_eight_patches_a_row(tmp_path: Path) -> None:
    write_shard(tmp_path / "shard-0-00000.npz", [patch(0.25, bool(k % 2)) for k in range(8)])
    assert contact_sheet(tmp_path, rows=3).shape == (300, 800, 3)
