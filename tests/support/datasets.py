"""Tiny data sets in the exact formats of their readers, made by code.

In all of them `#` is a frame that touches and shows red skin, `.` one that does not and shows blue skin (see `colour_model`).
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np

from egotouch_sdk.joints import Finger, HandJoint
from egotouch_sdk.observation import HandObservation
from tests.support.hands import host_hand, palm_centre, pointing_hand

SIZE_PX = (640, 480)
RED, BLUE = (60, 80, 200), (200, 80, 60)
#: The egocentric camera of the tiny EgoPressure: half a metre straight above the pad, its picture's right along the pad's +x.
LENS = {"fx": 600.0, "fy": 600.0, "cx": 320.0, "cy": 240.0}
HEIGHT_M = 0.5


def picture(letter: str) -> np.ndarray:
    return np.full((SIZE_PX[1], SIZE_PX[0], 3), RED if letter == "#" else BLUE, np.uint8)


def write_video(path: Path, pictures: Iterable[np.ndarray], fps: float = 30.0) -> None:
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), fps, SIZE_PX)
    assert writer.isOpened()
    for image in pictures:
        writer.write(image)
    writer.release()


def touching_pair() -> tuple[HandObservation, HandObservation]:
    """A pointing right hand whose index fingertip is over a left palm."""
    host = host_hand(wrist_px=(300.0, 430.0))
    return pointing_hand(palm_centre(host)), host


def write_landmarks(path: Path, frames: int, hands: tuple[HandObservation, ...]) -> None:
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["frame", "hand", "joint", "x_px", "y_px", "z_px", "x_mm", "y_mm", "z_mm"])
        for frame in range(frames):
            for hand in hands:
                for joint in range(21):
                    rows.writerow([frame, hand.handedness.value, joint, *hand.landmarks_px[joint], *hand.world_mm[joint]])


def write_folder(folder: Path, recordings: dict[str, str], *, landmarks: bool = True, about: dict[str, object] | None = None) -> Path:
    """The plain layout: `recordings` are touches by `participant/recording`."""
    for name, touch in recordings.items():
        path = folder / name
        path.mkdir(parents=True)
        write_video(path / "video.avi", map(picture, touch))
        rows = [f"{frame},{int(letter == '#')},{1.2 if letter == '#' else ''},\n" for frame, letter in enumerate(touch)]
        (path / "labels.csv").write_text("frame,touch,force_n,hover_mm\n" + "".join(rows))
        if landmarks:
            write_landmarks(path / "landmarks.csv", len(touch), touching_pair())
        (path / "about.json").write_text(json.dumps(about or {}))
    return folder


def write_palmpad(
    folder: Path, group: int, user: int, touch: str, pictures: Iterable[np.ndarray] | None = None, take: int = 0, unit: float = 1e6
) -> Path:
    """One recording of Palmpad; `unit` is how many of its timestamps are a second."""
    path = folder / f"group_{group}" / f"user-{user}" / f"user-{user}_{take}.avi"
    path.parent.mkdir(parents=True, exist_ok=True)
    write_video(path, map(picture, touch) if pictures is None else pictures)
    start = 1.7e9 * unit
    lines = [f"{start + frame / 30 * unit:.0f} {int(letter == '#')} {611 + frame}" for frame, letter in enumerate(touch)]
    path.with_suffix(".txt").write_text("\n".join(["Timestamp downsample raw", *lines]) + "\n")
    return path


def write_egopressure(folder: Path, participant: str, gesture: str, touch: str, *, hand: str = "right", dropped: int | None = None) -> Path:
    """One sequence of EgoPressure: `x` in `touch` is a frame without annotation; `dropped` a frame without a picture."""
    import pyarrow as pa
    from pyarrow import parquet

    name = f"{participant}_index_press_{gesture}_{hand}"
    path, config = folder / "data" / participant / name, folder / "configs" / participant / f"{name}.json"
    path.mkdir(parents=True)
    config.parent.mkdir(parents=True, exist_ok=True)
    config.write_text(json.dumps({"participant": {"id": participant}, "camera_calibrations": {"0": {**LENS, "k1": 0.1}}}))
    frames = list(range(1, len(touch) + 1))
    shown = [(frame, letter) for frame, letter in zip(frames, touch, strict=True) if frame != dropped]
    images = [{"bytes": cv2.imencode(".jpg", picture(letter))[1].tobytes(), "path": f"{frame}.jpg"} for frame, letter in shown]
    parquet.write_table(pa.table({"frame": [frame for frame, _ in shown], "image": images}), path / "cam-d.color.parquet", row_group_size=4)
    parquet.write_table(pa.table({"frame": frames, "force": [pad(letter).ravel().tolist() for letter in touch]}), path / "pressure.parquet")
    joints = [None if letter == "x" else joints_m(0.0 if letter == "#" else 0.012).ravel().tolist() for letter in touch]
    poses = {"ego_R": [np.eye(3).ravel().tolist()] * len(touch), "ego_T": [[0.0, 0.0, HEIGHT_M]] * len(touch)}
    columns = {"frame": frames, "has_annotation": [letter != "x" for letter in touch], "joint_position": joints, **poses}
    parquet.write_table(pa.table({**columns, "hand_side": [hand] * len(touch)}), path / "annotation.parquet")
    return path


def pad(letter: str) -> np.ndarray:
    """Counts of the pad: 2 N under the finger while it touches."""
    counts = np.zeros((105, 185), np.float32)
    if letter == "#":
        counts[50:54, 90:95] = 2 * 1736 / 20
    return counts


def joints_m(hover_m: float) -> np.ndarray:
    """Joints (21, 3) in the pad's frame, z down: the fingers along -y, the index fingertip `hover_m` above the pad's centre."""
    hand = pointing_hand((0.0, 0.0), px_per_mm=1.0)
    points = np.column_stack([hand.landmarks_px[:, :2], -20.0 * np.ones(21)]) / 1000
    points[HandJoint.INDEX_FINGER_TIP] = (0.0, 0.0, -hover_m)
    points[Finger.INDEX.dip] = (0.0, 0.016, -0.008 - hover_m)
    return points
