"""Touches with a known answer for `egotouch evaluate host-frame`: the demo clip, rendered stills."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np

from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.evaluation.host_frame import HostCase, seen_pair
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.surface import Surface

#: Stills have participants below this.
_PARTICIPANTS = 32
_STILLS_SEED = 1


def demo_cases() -> Iterator[HostCase]:
    """Every touching frame of the demo clip in which tracker and gate see the pair of hands."""
    from egotouch_sdk.config import GateConfig
    from egotouch_sdk.frame_observation import CLOSED
    from egotouch_sdk.gate import find_pairs
    from egotouch_sdk.hands.tracker import HandTracker
    from egotouch_sdk.sources import open_source

    assets = files("egotouch_sdk") / "assets"
    truths: list[dict[str, Any]] = json.loads((assets / "demo_truth.json").read_text(encoding="utf-8"))["frames"]
    tracker, gate = HandTracker(), CLOSED
    with as_file(assets / "demo.mp4") as clip, open_source(str(clip)) as source:
        for frame, truth in zip(source, truths, strict=True):
            if not isinstance(frame, Frame):
                raise FrameError("the demo clip gives no pictures")
            gate = find_pairs(tracker.track(frame), GateConfig(), gate)
            pair = next((pair for pair in gate.pairs if pair.touching.handedness is Handedness.RIGHT), None)
            if truth["touching"] and pair is not None:
                point = HostPoint(Surface(truth["surface"]), truth["at_mm"][0], truth["at_mm"][1], truth["pitch_rad"], truth["yaw_rad"])
                yield HostCase(pair, Finger(truth["finger"]), point, truth["palm_mm"])


def still_cases(folder: Path, render: int, report: Callable[[str], None]) -> Iterator[HostCase]:
    """Rendered stills in which the tracker finds both hands about where they are."""
    import cv2

    from egotouch_sdk.hands.tracker import HandTracker
    from egotouch_sdk.synthetic.host_truth import HostTruth
    from egotouch_sdk.synthetic.stills import render_stills

    if render:
        render_stills(folder, render, tuple(range(_PARTICIPANTS)), _STILLS_SEED, report)
    truths = sorted(folder.glob("*.json"))
    if not truths:
        raise ConfigError(f"{folder} holds no stills", hint="Add --render 200")
    tracker = HandTracker()
    for path in truths:
        truth = HostTruth.from_dict(json.loads(path.read_text()))
        pair = seen_pair(tracker, cv2.imread(str(path.with_suffix(".jpg"))))
        if pair is not None and _is_on_hands(truth, pair.host.landmarks_px, pair.touching.landmarks_px):
            yield HostCase(pair, truth.finger, truth.point, truth.palm_mm, truth.participant)


def _is_on_hands(truth: Any, host_px: Any, touching_px: Any) -> bool:
    """True when the host is within half a palm and the fingertip within 0.3 palms of where they are; else the tracker erred."""
    host, touching = truth.landmarks_px(truth.host_mm), truth.landmarks_px(truth.touching_mm)
    palm_px = float(np.linalg.norm(host[9, :2] - host[0, :2]))
    off_px = np.linalg.norm(host_px[:, :2] - host[:, :2], axis=1).mean()
    tip_px = np.linalg.norm(touching_px[truth.finger.tip, :2] - touching[truth.finger.tip, :2])
    return bool(off_px < 0.5 * palm_px and tip_px < 0.3 * palm_px)
