"""Labelled recordings in a plain folder layout of our own, for data that users record themselves.

    <participant>/<recording>/
        video.mp4           or .avi, .mov, .mkv; or a folder `frames` of pictures in natural order
        labels.csv          frame,touch[,force_n][,hover_mm]        frames count from 0, touch is 0 or 1
        landmarks.csv       may be missing: frame,hand,joint,x_px,y_px,z_px,x_mm,y_mm,z_mm
        about.json          may be missing: {"fps": 30, "finger": "index", "touching_hand": "right", "task": "drag",
                            "conditions": {"skin tone": "III", "light": "lamp"}}

Frames without a row in labels.csv are not scored; an empty cell is a value that nobody measured. `hand` is left or right, `joint` one
of the 21 numbers of MediaPipe's hand; `_px` is in the picture (z relative to the wrist, smaller is nearer), `_mm` metric with any origin
in the camera's directions (x right, y down, z away). Without landmarks.csv the built-in tracker finds the hands. `task` is press (also
when left out), drag or hover. `fps` is that of pictures, or replaces a video's own.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from functools import partial
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from egotouch_sdk.errors import FrameError, SourceError
from egotouch_sdk.evaluation.datasets.recording import Label, LabelledRecording, RecordingFile
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands.pushed import hand_from_joints
from egotouch_sdk.joints import NUM_JOINTS, Finger, Handedness
from egotouch_sdk.observation import HandObservation
from egotouch_sdk.sources import open_frames

LABELS, LANDMARKS, ABOUT, FRAMES = "labels.csv", "landmarks.csv", "about.json", "frames"
VIDEO_SUFFIXES = (".mp4", ".avi", ".mov", ".mkv")
PIXELS, METRIC = ("x_px", "y_px", "z_px"), ("x_mm", "y_mm", "z_mm")
TASKS = ("press", "drag", "hover")
#: Rate of pictures without a stated one.
FPS = 30.0


def find_folder(folder: Path) -> list[RecordingFile]:
    """All recordings below a folder; raises `SourceError` when there is none."""
    tables = sorted(folder.glob(f"*/*/{LABELS}"))
    if not tables:
        raise SourceError(f"there is no <participant>/<recording>/{LABELS} in {folder}", hint="See `egotouch evaluate dataset --help`")
    return [
        RecordingFile(table.parent.parent.name, table.parent.name, table.parent, partial(load_folder, table.parent)) for table in tables
    ]


def load_folder(path: Path) -> LabelledRecording:
    """One recording."""
    about = _read_about(path / ABOUT)
    pictures = _pictures(path)
    with open_frames(str(pictures), fps=about["fps"]) as source:
        fps = source.fps or FPS
    return LabelledRecording(
        participant=path.parent.name,
        name=path.name,
        fps=fps,
        labels=_read_labels(path / LABELS),
        read=partial(_frames, pictures, about["fps"]),
        finger=about["finger"],
        touching_hand=about["touching_hand"],
        conditions=about["conditions"],
        is_hover=about["task"] == "hover",
        is_drag=about["task"] == "drag",
        landmarks=_read_landmarks(path / LANDMARKS) if (path / LANDMARKS).is_file() else None,
    )


def _pictures(path: Path) -> Path:
    found = [path / FRAMES] if (path / FRAMES).is_dir() else []
    found += [file for file in sorted(path.iterdir()) if file.stem == "video" and file.suffix.lower() in VIDEO_SUFFIXES]
    if len(found) != 1:
        what = "has neither a video.mp4 nor a folder frames" if not found else f"has {' and '.join(each.name for each in found)}"
        raise SourceError(f"{path} {what}", hint="Put just one of them beside labels.csv")
    return found[0]


def _frames(pictures: Path, fps: float | None) -> Iterator[Frame]:
    with open_frames(str(pictures), fps=fps) as source:
        yield from source


def _read_about(path: Path) -> dict[str, Any]:
    try:
        content = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
        hand, fps, task = content.get("touching_hand"), content.get("fps"), content.get("task", TASKS[0])
        if task not in TASKS:
            raise ValueError(f"task is {task!r}, need one of {', '.join(TASKS)}")
        if unknown := sorted(set(content) - {"fps", "finger", "touching_hand", "task", "conditions"}):
            raise ValueError(f"there is no key {unknown[0]}")
        return {
            "fps": None if fps is None else float(fps),
            "finger": Finger(content.get("finger", Finger.INDEX)),
            "touching_hand": None if hand is None else Handedness(hand),
            "task": task,
            "conditions": {str(name): str(value) for name, value in content.get("conditions", {}).items()},
        }
    except (ValueError, TypeError, AttributeError) as problem:
        raise SourceError(f"{path} is wrong ({problem})", hint="See `egotouch evaluate dataset --help`") from problem


def _read_labels(path: Path) -> dict[int, Label]:
    labels = {}
    for line, row in _read_table(path, ("frame", "touch")):
        try:
            frame, touch = int(row["frame"]), {"0": False, "1": True}[row["touch"].strip()]
            labels[frame] = Label(touch, _number(row.get("force_n")), _number(row.get("hover_mm")))
        except (KeyError, ValueError, SourceError) as problem:
            raise SourceError(
                f"line {line} of {path} is wrong ({problem})", hint="Need frame,touch[,force_n][,hover_mm] with touch 0 or 1"
            ) from problem
    if not labels:
        raise SourceError(f"{path} has no row", hint="Label at least one frame: frame,touch")
    return labels


def _read_landmarks(path: Path) -> dict[int, tuple[HandObservation, ...]]:
    points: dict[int, dict[Handedness, dict[int, tuple[float, ...]]]] = {}
    for line, row in _read_table(path, ("frame", "hand", "joint", *PIXELS, *METRIC)):
        try:
            joint, place = int(row["joint"]), tuple(float(row[name]) for name in (*PIXELS, *METRIC))
            points.setdefault(int(row["frame"]), {}).setdefault(Handedness(row["hand"]), {})[joint] = place
        except ValueError as problem:
            raise SourceError(
                f"line {line} of {path} is wrong ({problem})", hint=f"Need numbers, hand left or right, joint 0 to {NUM_JOINTS - 1}"
            ) from problem
    return {frame: tuple(_hand(path, frame, side, joints) for side, joints in hands.items()) for frame, hands in points.items()}


def _hand(path: Path, frame: int, side: Handedness, joints: dict[int, tuple[float, ...]]) -> HandObservation:
    try:
        table = np.array([joints[number] for number in range(NUM_JOINTS)])
        return hand_from_joints(side, table[:, :3], table[:, 3:] / 1000)
    except (KeyError, FrameError) as problem:
        what = f"joint {problem} is missing" if isinstance(problem, KeyError) else str(problem)
        raise SourceError(
            f"the {side.value} hand of frame {frame} in {path} is wrong ({what})", hint="Give all 21 joints, or leave it out"
        ) from problem


def _read_table(path: Path, columns: tuple[str, ...]) -> Iterator[tuple[int, dict[str, str]]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        reader = csv.DictReader(file)
        if missing := [name for name in columns if name not in (reader.fieldnames or ())]:
            raise SourceError(f"{path} lacks the columns {', '.join(missing)}", hint=f"Its first line is: {','.join(columns)}")
        for row in reader:
            yield reader.line_num, {name: value or "" for name, value in row.items() if name is not None}


def _number(text: str | None) -> float:
    return float(text) if text and text.strip() else nan
