"""Palmpad (CHI'25): index finger on the opposite palm, one RGB camera, touch from an impedance sensor, no force.

    group_1/user-3/user-3_0.avi      a video
    group_1/user-3/user-3_0.txt      one line per frame: `<timestamp> <downsample> <raw>`, behind a heading

`downsample` is the touch, 0 or 1. The unit of the timestamps is not stated: it is taken from their pace. Users are numbered from
anew in each group, so a participant is a group and a user.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from math import isfinite
from pathlib import Path

import numpy as np

from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.datasets.recording import Label, LabelledRecording, RecordingFile
from egotouch_sdk.frame import Frame
from egotouch_sdk.sources import open_frames

_USER = re.compile(r"user-(.+)")
_GROUP = re.compile(r"group_(.+)")
#: Lines that may be missing or left over at the end of a recording (our choice: one tenth of a second at 30 fps).
LINES_TOLERATED = 3
#: Frame intervals that a camera can have; no two units give one step both within them.
INTERVALS_NS = (1e9 / 480, 1e9 / 4)
#: Nanoseconds per second, millisecond, microsecond and nanosecond.
_UNITS_NS = (1_000_000_000, 1_000_000, 1_000, 1)


def find_palmpad(folder: Path) -> list[RecordingFile]:
    """All recordings below the data set's folder; raises `SourceError` when there is none."""
    videos = sorted(folder.glob("group_*/user-*/*.avi"))
    if not videos:
        raise SourceError(f"there is no group_1/user-.../*.avi in {folder}", hint="Give the folder that holds group_1 and group_2")
    return [RecordingFile(_participant(video), video.stem, video, partial(load_palmpad, video)) for video in videos]


def load_palmpad(video: Path) -> LabelledRecording:
    """One video with its labels."""
    table = video.with_suffix(".txt")
    times, touches = _read_table(table)
    if not times:
        raise SourceError(f"{table} has no line with a label", hint="Each line is: timestamp downsample raw")
    times_ns = _nanoseconds(times)
    fps = 30.0 if times_ns is None else 1e9 / float(np.median(np.diff(times_ns)))
    return LabelledRecording(
        participant=_participant(video),
        name=video.stem,
        fps=fps,
        labels={frame: Label(touch) for frame, touch in enumerate(touches)},
        read=partial(_frames, video, table, times_ns, len(touches)),
        conditions={"group": _after(_GROUP, video.parent.parent.name)},
    )


def _participant(video: Path) -> str:
    return f"g{_after(_GROUP, video.parent.parent.name)}-u{_after(_USER, video.parent.name):0>2}"


def _after(pattern: re.Pattern[str], name: str) -> str:
    match = pattern.fullmatch(name)
    return match.group(1) if match else name


def _read_table(table: Path) -> tuple[list[float], list[bool]]:
    try:
        lines = table.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as problem:
        raise SourceError(f"{table} is missing or unreadable", hint="Each .avi of Palmpad has a .txt of the same name") from problem
    times, touches = [], []
    for number, line in enumerate(lines, 1):
        words = line.split()
        if not words or (number == 1 and not _is_number(words[0])):
            continue
        if len(words) < 2 or not _is_number(words[0]) or words[1] not in {"0", "1", "0.0", "1.0"}:
            raise SourceError(f"line {number} of {table} is {line!r}", hint="Need: timestamp, 0 or 1, raw value")
        times.append(float(words[0]))
        touches.append(words[1].startswith("1"))
    return times, touches


def _is_number(text: str) -> bool:
    try:
        return isfinite(float(text))
    except ValueError:
        return False


def _nanoseconds(times: list[float]) -> list[int] | None:
    """Times from 0 in nanoseconds, in the unit that makes them a camera's; None when they do not rise or none does."""
    steps = np.diff(times)
    if not len(steps) or (steps <= 0).any():
        return None
    step = float(np.median(steps))
    unit_ns = next((unit for unit in _UNITS_NS if INTERVALS_NS[0] <= step * unit <= INTERVALS_NS[1]), None)
    return None if unit_ns is None else [round((time - times[0]) * unit_ns) for time in times]


def _frames(video: Path, table: Path, times_ns: list[int] | None, lines: int) -> Iterator[Frame]:
    count = 0
    with open_frames(str(video)) as source:
        for frame in source:
            count += 1
            if times_ns is None:
                yield frame
            elif frame.index < len(times_ns):
                yield replace(frame, timestamp_ns=times_ns[frame.index])
    if abs(count - lines) > LINES_TOLERATED:
        raise SourceError(
            f"{video} has {count} frames but {table.name} {lines} labels", hint="They must belong together, one line per frame"
        )
