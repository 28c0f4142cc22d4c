import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from egotouch_sdk import __version__
from egotouch_sdk.cli import demo
from egotouch_sdk.sources import VideoFileSource
from egotouch_sdk.view.annotate import HEIGHT_PX, WIDTH_PX
from tests.support.study import memory_model

Command = Callable[..., tuple[int, str, str]]
COMMANDS = ("demo", "run", "record", "replay", "hands", "estimate", "bench", "doctor")


@pytest.fixture
def demo_assets(tmp_path: Path, clip: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A clip without hands, with a ground truth that claims one touch."""
    clip.rename(tmp_path / "demo.mp4")
    frames = [{"frame": index, "touching": 3 <= index <= 8, "force_n": 1.0, "finger": "index", "hand": "right"} for index in range(12)]
    truth = {"fps": 30.0, "frames": frames, "touches": [{"start_frame": 3, "end_frame": 8, "force_peak_n": 1.0}]}
    (tmp_path / "demo_truth.json").write_text(json.dumps(truth))
    monkeypatch.setattr(demo, "ASSETS", tmp_path)
    return tmp_path


def test_version(egotouch: Command) -> None:
    assert egotouch("--version") == (0, f"egotouch {__version__}\n", "")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_examples(egotouch: Command, command: str) -> None:
    code, out, _ = egotouch(command, "--help")
    assert code == 0
    assert f"examples:\n  egotouch {command}" in out


def test_the_overview_lists_every_command(egotouch: Command) -> None:
    _, out, _ = egotouch("--help")
    assert all(f"\n    {command} " in out for command in COMMANDS)


def test_hands_prints_one_object_per_frame(egotouch: Command, clip: Path) -> None:
    code, out, _ = egotouch("hands", clip, "--json")
    records = [json.loads(line) for line in out.splitlines()]
    assert code == 0
    assert [record["frame"] for record in records] == list(range(12))
    assert [record["timestamp_ns"] for record in records][:2] == [0, pytest.approx(33_333_333, abs=50_000)]
    assert all(record["hands"] == [] for record in records)


def test_hands_prints_a_line_per_frame_for_people(egotouch: Command, clip: Path) -> None:
    _, out, err = egotouch("hands", clip)
    assert out.splitlines()[0].endswith("no hands")
    assert err == "hands in 0 of 12 frames\n"


def test_run_without_touches_prints_no_events_and_says_how_it_went(egotouch: Command, clip: Path) -> None:
    code, out, err = egotouch("run", clip, "--json")
    assert (code, out) == (0, "")
    assert err.startswith("12 frames in ")


def test_run_saves_an_annotated_video_of_every_frame(egotouch: Command, clip: Path, tmp_path: Path) -> None:
    code, _, err = egotouch("run", clip, "--save", tmp_path / "out.mp4")
    assert code == 0
    assert f"saved {tmp_path / 'out.mp4'}" in err
    with VideoFileSource(tmp_path / "out.mp4") as saved:
        assert (saved.width_px, saved.height_px, saved.fps) == (WIDTH_PX, HEIGHT_PX, 30.0)
        assert len(list(saved)) == 12


def test_run_reads_settings_from_a_file(egotouch: Command, clip: Path, tmp_path: Path) -> None:
    (tmp_path / "config.json").write_text('{"hands": {"max_hands": 1}, "state": {"coast_frames": 5}}')
    assert egotouch("run", clip, "--config", tmp_path / "config.json", "--mirrored", "--threads", "1")[0] == 0


def test_run_warns_about_a_damaged_video_and_goes_on(egotouch: Command, tmp_path: Path) -> None:
    path = tmp_path / "cut.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 30.0, (160, 120))
    for _ in range(30):
        writer.write(np.zeros((120, 160, 3), np.uint8))
    writer.release()
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    code, _, err = egotouch("run", path)
    assert code == 0
    assert "egotouch: warning: " in err
    assert "of 30 frames decoded" in err


def test_estimate_prints_one_object_per_image(egotouch: Command, tmp_path: Path) -> None:
    files = []
    for name, level in (("a.png", 60), ("b.png", 200)):
        cv2.imwrite(str(tmp_path / name), np.full((128, 128, 3), level, np.uint8))
        files.append(tmp_path / name)
    code, out, _ = egotouch("estimate", *files, "--tip", "64,64", "--px-per-mm", "3.2", "--json")
    records = [json.loads(line) for line in out.splitlines()]
    assert code == 0
    assert [record["file"] for record in records] == [str(file) for file in files]
    assert all(set(record) == {"file", "touch_probability", "force_n"} for record in records)
    assert all(0 <= record["touch_probability"] <= 1 and 0 <= record["force_n"] <= 3.5 for record in records)


@pytest.mark.parametrize("remembers", [False, True])
def test_estimate_of_many_images_equals_that_of_each(egotouch: Command, tmp_path: Path, remembers: bool) -> None:
    noise = np.random.default_rng(3)
    files = [tmp_path / f"{index}.png" for index in range(3)]
    for file in files:
        cv2.imwrite(str(file), noise.integers(0, 255, (100, 100, 3), np.uint8))
    model = ("--model", memory_model(tmp_path)) if remembers else ()
    options = ("--tip", "50,50", "--px-per-mm", "2.5", "--json", *model)
    _, together, _ = egotouch("estimate", *files, *options)
    alone = "".join(egotouch("estimate", file, *options)[1] for file in files)
    for a, b in zip(map(json.loads, together.splitlines()), map(json.loads, alone.splitlines()), strict=True):
        assert a["touch_probability"] == pytest.approx(b["touch_probability"], abs=2e-4)
        assert a["force_n"] == pytest.approx(b["force_n"], abs=2e-3)


def test_bench_reports_stages_rate_threads_and_machine(egotouch: Command, tmp_path: Path, clip: Path) -> None:
    code, out, _ = egotouch("bench", clip, "--json", "--threads", 1)
    report = json.loads(out)
    assert code == 0
    assert (report["frames"], report["width_px"], report["height_px"]) == (2, 1280, 720)
    assert list(report["stage_ms"]) == ["hands", "gate", "patches", "touch", "events"]
    assert report["fps"] == pytest.approx(1000 / report["frame_ms_mean"], rel=0.01)
    assert 0 < report["networks_ms"] < report["frame_ms_mean"]
    assert report["outside_networks"] == pytest.approx(1 - report["networks_ms"] / report["frame_ms_mean"], abs=0.01)
    assert (report["threads"]["hands"], report["threads"]["touch"]) == (1, 1)
    assert "cores" in report["machine"]


def test_bench_prints_a_table_for_people(egotouch: Command, clip: Path) -> None:
    code, out, _ = egotouch("bench", clip)
    assert code == 0
    assert "frames per second" in out
    assert "outside them" in out


def test_doctor_names_packages_and_models_with_their_hashes(egotouch: Command) -> None:
    _, out, _ = egotouch("doctor", "--json", "--no-cameras")
    findings = {finding["check"]: finding for finding in json.loads(out)["findings"]}
    assert findings["numpy"] == {"check": "numpy", "verdict": "ok", "detail": np.__version__, "hint": ""}
    assert all("sha256" in findings[name]["detail"] for name in ("palm_detection_full", "hand_landmark_full", "touch model"))


def test_doctor_names_every_extra_a_user_may_want_and_the_network(egotouch: Command) -> None:
    _, out, _ = egotouch("doctor", "--json", "--no-cameras")
    checks = {finding["check"] for finding in json.loads(out)["findings"]}
    wanted = {f"extra [{name}]" for name in ("debug", "lan", "mdns", "nats", "recording", "simulate", "synthetic", "train", "tuio")}
    assert wanted | {"local network", "port 8765"} <= checks
    assert not checks & {"extra [all]", "extra [browser]", "extra [dev]"}


def test_doctor_says_how_to_mend_what_is_broken(
    egotouch: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(demo, "ASSETS", tmp_path)
    code, out, _ = egotouch("doctor", "--no-cameras")
    assert code == 1
    assert "broken  demo clip" in out
    assert "-> " in out


def test_demo_ends_with_the_scoreboard(egotouch: Command, demo_assets: Path) -> None:
    code, out, _ = egotouch("demo", "--headless", "--fast", "--json")
    assert code == 0
    board = json.loads(out.splitlines()[-1])["scoreboard"]
    assert board["counts"]["touch"] == {"true": 1, "found": 0, "missed": 1, "false": 0}
    assert board["counts"]["drag"] == {"true": 0, "found": 0, "missed": 0, "false": 0}
    assert board["onset_error_ms_median"] is None


def test_demo_keeps_to_real_time(egotouch: Command, demo_assets: Path) -> None:
    _, out, err = egotouch("demo", "--headless")
    assert "touch              1      0       1      0" in out
    assert float(err.split(" frames in ")[1].split(" s")[0]) >= 0.3


def test_demo_without_a_desktop_saves_the_view(
    egotouch: Command, demo_assets: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    code, _, err = egotouch("demo", "--fast")
    assert code == 0
    assert "view: http://127.0.0.1:" in err
    with VideoFileSource(tmp_path / "egotouch-demo.mp4") as saved:
        assert len(list(saved)) == 12


def test_demo_without_its_clip_says_so(egotouch: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demo, "ASSETS", tmp_path / "gone")
    code, _, err = egotouch("demo", "--headless")
    assert code == 1
    assert "lacks the demo clip" in err
