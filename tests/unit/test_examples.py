"""Every example at the top of `examples/` runs on a cut of the demo clip and shows its touches."""

import os
import subprocess
import sys
from pathlib import Path

import cv2
import pytest

ROOT = Path(__file__).parents[2]
DEMO = ROOT / "egotouch_sdk" / "assets" / "demo.mp4"
#: Two touches of the index finger lie in the first 70 frames of the clip; the second is a click at this coding, too.
FRAMES = 70
#: What a busy machine may bring an example to say: printing can take longer than a listener should.
SLOW_LISTENER = "while it runs, moves are merged"

#: What each example prints, and the rate at which its cut plays: frames that are pushed live must not outrun a slow machine.
SHOWS = {
    "async_events.py": (30.0, ("click 1 with the right index", " mm  pitch ")),
    "force_dimmer.py": (30.0, ("|###", "|   ")),
    "print_touches.py": (30.0, ("down    right index", "up      right index", "click   on the palm")),
    "push_frames.py": (6.0, ("right index touches the palm", "frames were taken in time")),
}


def cut(path: Path, fps: float) -> Path:
    """The beginning of the demo clip at another rate."""
    demo = cv2.VideoCapture(str(DEMO))
    size = round(demo.get(cv2.CAP_PROP_FRAME_WIDTH)), round(demo.get(cv2.CAP_PROP_FRAME_HEIGHT))
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), fps, size)
    for _ in range(FRAMES):
        writer.write(demo.read()[1])
    writer.release()
    demo.release()
    return path


def test_every_example_is_tested() -> None:
    assert {path.name for path in (ROOT / "examples").glob("*.py")} == set(SHOWS)


@pytest.mark.parametrize("example", SHOWS)
def test_the_example_shows_touches(example: str, tmp_path: Path) -> None:
    fps, texts = SHOWS[example]
    video = cut(tmp_path / "clip.mp4", fps)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    command = [sys.executable, ROOT / "examples" / example, video]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, env=environment)
    assert done.returncode == 0
    assert [line for line in done.stderr.splitlines() if SLOW_LISTENER not in line] == []
    assert [text for text in texts if text not in done.stdout] == []
