"""Renders a script to a video with its ground truth: frames by many workers, then light, camera and H.264."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import MissingExtraError
from egotouch_sdk.jobs import Batch, BatchResult, Runner, Task, run_jobs
from egotouch_sdk.synthetic.camera import groove
from egotouch_sdk.synthetic.patches_job import participant
from egotouch_sdk.synthetic.script import FPS, Shot
from egotouch_sdk.synthetic.series import PX_PER_MM
from egotouch_sdk.synthetic.shots import DEMO
from egotouch_sdk.synthetic.take import HEIGHT_PX, WIDTH_PX, Take

#: Mean linear level of skin after exposure, about 48 % grey once encoded (our choice; cameras meter near 18 % reflectance).
_SKIN_LEVEL = 0.2
_CRF = "20"
#: Depth and width (at 2.5 px/mm) of the groove along a pressed finger: the middle of the training camera's ranges.
_GROOVE_DEPTH, _GROOVE_WIDTH_PX = 0.65, 1.55


@functools.lru_cache(maxsize=1)
def _take(shot: int) -> Take:
    return Take(DEMO[shot], participant(DEMO[shot].participant))


def _frame_name(shot: int, frame: int) -> str:
    return f"take{shot}-{frame:04d}.npz"


def render_frame(path: Path, shot: int, frame: int) -> int:
    """Render one frame of the demo's take `shot` with its truth to `path`; returns 1, the number of frames."""
    rendered = _take(shot).render(frame)
    layers = rendered.layers
    with path.open("wb") as file:
        np.savez(
            file,
            light=np.clip(layers.light, 0, 60).astype(np.float16),
            albedo=layers.albedo.astype(np.float16),
            segment=layers.segment,
            depth_mm=(layers.depth_m * 1e3).astype(np.float32),
            truth=np.array(json.dumps(rendered.truth)),
        )
    return 1


def _develop(layers: Any, shot: Shot, exposure: float, rng: np.random.Generator) -> npt.NDArray[np.uint8]:
    """Light, exposure, optics, sensor noise and tone curve: layers to a BGR frame."""
    image = (layers["light"].astype(np.float32) @ shot.light_gains.astype(np.float32)) * layers["albedo"].astype(np.float32) * exposure
    image *= (1 - _GROOVE_DEPTH * _groove(layers))[..., None]
    image = cv2.GaussianBlur(image.astype(np.float32), (0, 0), 0.8)
    noise = cv2.GaussianBlur(rng.standard_normal(image.shape).astype(np.float32), (0, 0), 0.5) * 1.6
    image = np.clip(image + noise * np.sqrt(np.maximum(image, 0) * 4e-5 + 1.5e-6), 0, None)
    image = image / (1 + 0.22 * image) * 1.18
    return np.asarray((np.clip(image, 0, 1) ** (1 / 2.2) * 255).astype(np.uint8)[:, :, ::-1])


def _groove(layers: Any) -> npt.NDArray[np.float32]:
    """Where skin hugs the finger's flank, (H, W) in 0..1, worked out at the patches' resolution; see `camera.groove`."""
    scale = PX_PER_MM / json.loads(str(layers["truth"]))["px_per_mm"]
    size = (round(WIDTH_PX * scale), round(HEIGHT_PX * scale))
    depth = cv2.resize(layers["depth_mm"].astype(np.float32), size, interpolation=cv2.INTER_NEAREST)
    segment = cv2.resize(layers["segment"], size, interpolation=cv2.INTER_NEAREST)
    fine = groove(np.asarray(depth, np.float32), np.asarray(segment, np.uint8), _GROOVE_WIDTH_PX)
    return np.asarray(cv2.resize(fine, (WIDTH_PX, HEIGHT_PX), interpolation=cv2.INTER_AREA), np.float32)


def _exposure(layers: Any, shot: Shot) -> float:
    skin = layers["segment"] > 0
    return float(_SKIN_LEVEL / np.median(((layers["light"][skin].astype(float) @ shot.light_gains) * layers["albedo"][skin]).mean(-1)))


def render_demo(folder: Path, runner: Runner, report: Callable[[str], None]) -> BatchResult:
    """Render every missing frame of the demo's takes into `folder`."""
    frames = [(shot, frame) for shot in range(len(DEMO)) for frame in range(DEMO[shot].frames)]
    tasks = tuple(Task(_frame_name(shot, frame), render_frame, (shot, frame)) for shot, frame in frames)
    return run_jobs(Batch("demo", folder, tasks, "frames"), runner, report)


def _touches(frames: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    for frame in frames:
        key = (frame["take"], frame["act"])
        if not frame["touching"]:
            continue
        if not found or found[-1]["key"] != key:
            found.append(
                {
                    "key": key,
                    "start_frame": frame["frame"],
                    "surface": frame["surface"],
                    "kind": frame["kind"],
                    "finger": frame["finger"],
                    "force_peak_n": 0.0,
                }
            )
        found[-1]["end_frame"] = frame["frame"]
        found[-1]["force_peak_n"] = max(found[-1]["force_peak_n"], frame["force_n"])
    return [{k: v for k, v in touch.items() if k != "key"} for touch in found]


def assemble_demo(folder: Path, video: Path, truth: Path) -> int:
    """Develop the rendered frames into an H.264 `video` and write the `truth` beside it; returns the number of frames.

    Raises `MissingExtraError` without PyAV.
    """
    try:
        import av
    except ImportError as error:
        raise MissingExtraError("Writing clips", "synthetic") from error
    labels: list[dict[str, Any]] = []
    rng = np.random.default_rng(0)
    with av.open(str(video), "w") as container:
        stream = container.add_stream("libx264", rate=FPS, options={"crf": _CRF, "preset": "slow"})
        stream.width, stream.height, stream.pix_fmt = WIDTH_PX, HEIGHT_PX, "yuv420p"
        for number, shot in enumerate(DEMO):
            exposure = 0.0
            for frame in range(shot.frames):
                with np.load(folder / _frame_name(number, frame)) as layers:
                    exposure = exposure or _exposure(layers, shot)
                    image = _develop(layers, shot, exposure, rng)
                    labels.append({"frame": len(labels), "take": number, **json.loads(str(layers["truth"]))})
                container.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="bgr24")))
        container.mux(stream.encode())
    truth.write_text(json.dumps({"fps": FPS, "frames": labels, "touches": _touches(labels)}, separators=(",", ":")) + "\n")
    return len(labels)
