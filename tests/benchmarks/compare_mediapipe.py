"""Frame rate of our whole pipeline over that of MediaPipe's hand tracker alone, on one video in one run.

MediaPipe 0.10.21 wants numpy < 2, so it runs in an environment of its own as a worker process:

    python3.11 -m venv /tmp/mediapipe
    /tmp/mediapipe/bin/pip install "mediapipe==0.10.21" "numpy<2"
    python tests/benchmarks/compare_mediapipe.py --mediapipe-python /tmp/mediapipe/bin/python [VIDEO]

The video (default: the demo clip) is scaled and padded to 1280x720. Blocks of frames alternate, A B A B, so that both meet the same
machine; only frames in which both found two hands count. MediaPipe runs with its bundled graph (video mode, complexity 1, two hands),
which uses XNNPACK's own number of threads; `--threads` sets ours, and both processes are held to that many processors (Linux).
"""

from __future__ import annotations

import argparse
import json
import os
import pickle
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

WIDTH, HEIGHT = 1280, 720
FRAME_NS = 33_333_333
DEMO_CLIP = Path(__file__).parents[2] / "egotouch_sdk" / "assets" / "demo.mp4"


def read_720p(path: str, limit: int) -> list[Any]:
    """Up to `limit` frames, scaled to fit 1280x720 and padded with grey."""
    import cv2

    clip, frames = cv2.VideoCapture(path), []
    while len(frames) < limit:
        ok, image = clip.read()
        if not ok:
            break
        scale = min(WIDTH / image.shape[1], HEIGHT / image.shape[0])
        image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        right, bottom = WIDTH - image.shape[1], HEIGHT - image.shape[0]
        frames.append(cv2.copyMakeBorder(image, 0, bottom, 0, right, cv2.BORDER_CONSTANT, value=(110, 120, 130)))
    if not frames:
        sys.exit(f"{path} gives no frames")
    return frames


#: One block: for each frame the seconds it took and the number of hands that were found.
Block = list[tuple[float, int]]


def timed(frames: list[Any], process: Callable[[Any], int]) -> Block:
    """Process every frame and note how long it took."""
    block = []
    for frame in frames:
        start = time.perf_counter()
        hands = process(frame)
        block.append((time.perf_counter() - start, hands))
    return block


def mediapipe_worker(video: str, limit: int) -> None:
    """Answer each line on stdin with one pickled block on stdout."""
    import cv2
    import mediapipe

    frames = [cv2.cvtColor(frame, cv2.COLOR_BGR2RGB) for frame in read_720p(video, limit)]
    tracker = mediapipe.solutions.hands.Hands(static_image_mode=False, max_num_hands=2, model_complexity=1)
    out = sys.stdout.buffer
    for _ in sys.stdin:
        block = timed(frames, lambda image: len(tracker.process(image).multi_hand_landmarks or ()))
        data = pickle.dumps(block)
        out.write(len(data).to_bytes(8, "little") + data)
        out.flush()


class MediaPipe:
    """The worker process as a function that runs one block."""

    def __init__(self, python: str, video: str, limit: int) -> None:
        command = [python, __file__, "--worker", video, "--frames", str(limit)]
        environment = {**os.environ, "GLOG_minloglevel": "3"}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment
        )

    def __call__(self) -> Block:
        """Run one block."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(b"\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            sys.exit("The MediaPipe worker ended: check --mediapipe-python (see this script's documentation)")
        size = self._process.stdout.read(8)
        if len(size) < 8:
            sys.exit("The MediaPipe worker ended: check --mediapipe-python (see this script's documentation)")
        block: Block = pickle.loads(self._process.stdout.read(int.from_bytes(size, "little")))
        return block


class Ours:
    """The whole pipeline, and the time it spends per stage."""

    def __init__(self, frames: list[Any], threads: int) -> None:
        from egotouch_sdk.config import TouchConfig
        from egotouch_sdk.pipeline import TouchPipeline

        self._frames, self._count = frames, 0
        config = TouchConfig.model_validate({"hands": {"threads": threads}, "touch": {"threads": threads}})
        self._pipeline = TouchPipeline(config)
        self.stage_ms: dict[str, list[float]] = {}

    def __call__(self) -> Block:
        """Run one block."""
        return timed(self._frames, self._process)

    def _process(self, image: Any) -> int:
        from egotouch_sdk.frame import Frame

        result = self._pipeline.process(Frame(image, self._count * FRAME_NS, self._count))
        self._count += 1
        for stage, value in result.stage_ms.items():
            self.stage_ms.setdefault(stage, []).append(value)
        return len(result.hands)


def both_see_two(a: list[Block], b: list[Block]) -> Iterator[tuple[float, float]]:
    """Times of the same frame in the same round where each side had two hands."""
    for ours, theirs in zip(a, b, strict=True):
        yield from ((x, y) for (x, m), (y, n) in zip(ours, theirs, strict=True) if m == n == 2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("video", nargs="?", default=str(DEMO_CLIP))
    parser.add_argument("--mediapipe-python", default="", help="interpreter of the environment that has mediapipe 0.10.21")
    parser.add_argument("--threads", type=int, default=2, help="threads of our pipeline, and processors for either side (default 2)")
    parser.add_argument("--rounds", type=int, default=4, help="blocks per side (default 4)")
    parser.add_argument("--frames", type=int, default=150, help="frames of the video to use (default 150)")
    parser.add_argument("--json", action="store_true", help="print one JSON object instead of text")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        mediapipe_worker(options.video, options.frames)
        return
    if not Path(options.video).is_file():
        sys.exit(f"{options.video} does not exist; give a video with two hands")
    if not options.mediapipe_python:
        sys.exit("give --mediapipe-python; see this script's documentation for how to make that environment")
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, set(sorted(os.sched_getaffinity(0))[: options.threads]))
    report(options)


def report(options: argparse.Namespace) -> None:
    """Run the rounds and print the ratio."""
    theirs = MediaPipe(options.mediapipe_python, options.video, options.frames)
    ours = Ours(read_720p(options.video, options.frames), options.threads)
    ours(), theirs()  # the first block of each warms up
    ours.stage_ms.clear()
    blocks = [(ours(), theirs()) for _ in range(options.rounds)]
    pairs = list(both_see_two([a for a, _ in blocks], [b for _, b in blocks]))
    if not pairs:
        sys.exit("no frame in which both sides found two hands; use another video")
    our_ms, their_ms = (1000 * statistics.median(column) for column in zip(*pairs, strict=True))
    result = {
        "frames_with_two_hands": len(pairs),
        "threads": options.threads,
        "pipeline_ms": round(our_ms, 2),
        "mediapipe_tracker_ms": round(their_ms, 2),
        "frame_rate_ratio": round(their_ms / our_ms, 3),
        "stage_ms": {stage: round(statistics.median(values), 3) for stage, values in ours.stage_ms.items()},
    }
    if options.json:
        print(json.dumps(result))
        return
    print(f"{len(pairs)} frames of {WIDTH}x{HEIGHT} with two hands, {options.threads} threads, medians of alternating blocks")
    print(f"  our whole pipeline        {our_ms:7.2f} ms  {1000 / our_ms:6.1f} frames/s")
    print(f"  MediaPipe's tracker alone {their_ms:7.2f} ms  {1000 / their_ms:6.1f} frames/s")
    print(f"  ratio of frame rates      {their_ms / our_ms:7.2f}   (goal 2)")
    print("  our stages (ms): " + ", ".join(f"{stage} {value}" for stage, value in result["stage_ms"].items()))


if __name__ == "__main__":
    main()
