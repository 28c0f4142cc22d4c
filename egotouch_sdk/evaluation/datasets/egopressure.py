"""EgoPressure (CVPR'25): a hand on a pressure pad before a head-mounted camera; the presses of one index finger are read.

    configs/<participant>/<sequence>.json              intrinsics of the egocentric camera: camera_calibrations["0"]
    data/<participant>/<sequence>/cam-d.color.parquet  its pictures, undistorted, 30 per second
    data/<participant>/<sequence>/pressure.parquet     105 x 185 counts of the pad
    data/<participant>/<sequence>/annotation.parquet   joints and the camera's pose in the pad's frame

A sequence is called `<participant>_<gesture>_<hand>`. One row per frame, `frame` counts from 1; a dropped frame has no row. The pad is
the plane z = 0 and z points down through it, so a hovering finger has negative z. The data are CC BY-NC-SA 4.0: evaluate only.
There is no host hand, so the model is shown patches without (R, theta), cut by the joints that the data set brings.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import partial
from math import nan
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import FrameError, MissingExtraError, SourceError
from egotouch_sdk.evaluation.datasets.recording import Label, LabelledRecording, RecordingFile
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.pushed import hand_from_joints
from egotouch_sdk.joints import NUM_JOINTS, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation

#: Counts of the pad per newton (EgoPressure toolkit).
COUNTS_PER_N = 1736.0
#: Frames per second (EgoPressure toolkit).
FPS = 30.0
#: Least force on the whole pad that is a touch (our choice: 5 g, above single cells that flicker).
TOUCH_N = 0.05
#: Rows of pictures decoded at a time.
_ROWS = 8
_SEQUENCE = re.compile(
    r"(?P<participant>.+)_index_press_(?P<kind>high|low|no-contact|pull|push|rotate-left|rotate-right)_(?:x\d|\dx)(?:_\d)?_(?P<hand>left|right)"
)
_DRAGS = frozenset({"pull", "push", "rotate-left", "rotate-right"})
_SHARDS = ("cam-d.color.parquet", "pressure.parquet", "annotation.parquet")


def find_egopressure(folder: Path) -> list[RecordingFile]:
    """All index-press sequences below the data set's folder; raises `SourceError` when there is none."""
    found = [(path, match) for path in sorted(folder.glob("data/*/*")) if path.is_dir() and (match := _SEQUENCE.fullmatch(path.name))]
    if not found:
        raise SourceError(
            f"there is no data/<participant>/..._index_press_... in {folder}", hint="Give the folder that holds data and configs"
        )
    return [
        RecordingFile(path.parent.name, path.name, path, partial(load_egopressure, folder, path, match["kind"], match["hand"]))
        for path, match in found
    ]


def load_egopressure(folder: Path, path: Path, kind: str, hand: str) -> LabelledRecording:
    """One sequence."""
    for shard in _SHARDS:
        if not (path / shard).is_file():
            raise SourceError(f"{path / shard} is missing", hint="Download the modalities rgb (camera d), pressure and pose")
    lens = _read_lens(folder / "configs" / path.parent.name / f"{path.name}.json")
    forces_n = {row["frame"]: float(np.sum(row["force"])) / COUNTS_PER_N for row in _rows(path / "pressure.parquet", ["frame", "force"])}
    side = Handedness(hand)
    landmarks: dict[int, tuple[HandObservation, ...]] = {}
    labels: dict[int, Label] = {}
    columns = ["frame", "has_annotation", "joint_position", "ego_R", "ego_T"]
    for row in _rows(path / "annotation.parquet", columns):
        frame = row["frame"]
        if not row["has_annotation"] or frame not in forces_n:
            continue
        try:
            world_m = np.asarray(row["joint_position"], np.float64).reshape(NUM_JOINTS, 3)
            landmarks[frame] = (_project(world_m, row, lens, side),)
        except (FrameError, TypeError, ValueError) as problem:
            raise SourceError(
                f"frame {frame} of {path / 'annotation.parquet'} has no usable joints ({problem})", hint="Download it again"
            ) from problem
        force_n = forces_n[frame]
        touch = force_n >= TOUCH_N
        height_mm = max(-1000 * float(world_m[HandJoint.INDEX_FINGER_TIP, 2]), 0.0)
        labels[frame] = Label(touch, force_n if touch else nan, nan if touch else height_mm)
    if not labels:
        raise SourceError(f"{path} has no annotated frame with a pressure", hint="Leave this sequence out")
    return LabelledRecording(
        participant=path.parent.name,
        name=path.name,
        fps=FPS,
        labels=labels,
        read=partial(_frames, path / _SHARDS[0]),
        touching_hand=side,
        conditions={"gesture": kind, "touching hand": hand},
        is_hover=kind == "no-contact",
        is_drag=kind in _DRAGS,
        landmarks=landmarks,
        has_host=False,
    )


def _read_lens(path: Path) -> dict[str, float]:
    try:
        entry = json.loads(path.read_text(encoding="utf-8"))["camera_calibrations"]["0"]
        return {name: float(entry[name]) for name in ("fx", "fy", "cx", "cy")}
    except OSError as problem:
        raise SourceError(f"{path} is missing or unreadable", hint="Download the sequence's config as well") from problem
    except (ValueError, KeyError, TypeError) as problem:
        raise SourceError(f'{path} has no camera_calibrations["0"] with fx, fy, cx, cy ({problem})', hint="Download it again") from problem


def _project(world_m: npt.NDArray[np.float64], row: dict[str, Any], lens: dict[str, float], side: Handedness) -> HandObservation:
    rotation, translation = np.asarray(row["ego_R"], np.float64).reshape(3, 3), np.asarray(row["ego_T"], np.float64).reshape(3)
    camera_m = world_m @ rotation.T + translation
    if not (camera_m[:, 2] > 0).all():
        raise ValueError("a joint lies behind the camera")
    pixels = camera_m[:, :2] / camera_m[:, 2:] * (lens["fx"], lens["fy"]) + (lens["cx"], lens["cy"])
    return hand_from_joints(side, pixels, camera_m)


def _rows(path: Path, columns: list[str]) -> Iterator[dict[str, Any]]:
    """The rows of a shard as objects, a few at a time."""
    try:
        from pyarrow import ArrowException
        from pyarrow.parquet import ParquetFile
    except ImportError as error:
        raise MissingExtraError("Reading EgoPressure", "evaluation") from error
    try:
        for batch in ParquetFile(path).iter_batches(_ROWS, columns=columns):
            if missing := sorted(set(columns) - set(batch.schema.names)):
                raise SourceError(f"{path} lacks the columns {', '.join(missing)}", hint="Download it again")
            yield from batch.to_pylist()
    except (ArrowException, OSError) as problem:
        raise SourceError(f"{path} is not a readable shard ({problem})", hint="Download it again") from problem


def _frames(path: Path) -> Iterator[Frame]:
    for row in _rows(path, ["frame", "image"]):
        image = cv2.imdecode(np.frombuffer(row["image"]["bytes"], np.uint8), cv2.IMREAD_COLOR)
        if image is None:
            raise SourceError(f"frame {row['frame']} of {path} is no picture", hint="Download it again")
        yield Frame(np.asarray(image, np.uint8), round(row["frame"] * 1e9 / FPS), row["frame"])
