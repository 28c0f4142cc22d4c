"""Hands that an app brings itself, such as a headset's own joints, instead of the built-in tracker."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from threading import Lock

import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import NUM_JOINTS, WEBXR_INDEX, HandJoint, Handedness
from egotouch_sdk.observation import HandObservation

#: Joints of a WebXR hand (WebXR Hand Input Module, section 3.1).
NUM_WEBXR_JOINTS = 25
_IDS = {Handedness.LEFT: 0, Handedness.RIGHT: 1}
_MM_PER_M = 1000.0
_NS_PER_MS = 1_000_000


class JointAxes(StrEnum):
    """Axes of metric joints: IMAGE x right, y down, z away from the camera; WEBXR x right, y up, z towards the viewer."""

    IMAGE = "image"
    WEBXR = "webxr"


@dataclass(frozen=True, slots=True)
class _Pushed:
    timestamp_ns: int
    hands: tuple[HandObservation, ...]


def hand_from_joints(
    handedness: Handedness,
    joints_px: npt.ArrayLike,
    joints_m: npt.ArrayLike,
    *,
    score: float = 1.0,
    axes: JointAxes = JointAxes.IMAGE,
) -> HandObservation:
    """One hand from a headset's joints, either 21 in MediaPipe's order or 25 in WebXR's.

    `joints_px` (N, 2) is where the joints appear in the frame, in pixels; with a third column, z in the same scale, smaller = nearer.
    `joints_m` (N, 3) is metric, in the camera's orientation and with any origin. Without z in pixels it follows from the metric depth.
    Raises `FrameError` for another number of joints, a value that is not finite, or joints that all lie in one point.
    """
    pixels, metres = _joints(joints_px, "joints_px", (2, 3)), _joints(joints_m, "joints_m", (3,))
    if axes is JointAxes.WEBXR:
        metres = metres * (1.0, -1.0, -1.0)
    if pixels.shape[1] == 2:
        depth_m = metres[:, 2] - metres[HandJoint.WRIST, 2]
        pixels = np.column_stack([pixels, depth_m * (_spread(pixels, "joints_px") / _spread(metres[:, :2], "joints_m"))])
    world_mm = (metres - metres.mean(0)) * _MM_PER_M
    return HandObservation(_IDS[handedness], handedness, score, pixels.astype(np.float32), world_mm.astype(np.float32))


class PushedHands:
    """A `HandSource` that answers with the hands which the app pushed for a frame's capture time.

    A frame takes the pushed hands nearest in time, if they are within `max_gap_ms`; otherwise it has no hands.
    `push` may be called from another thread than `track`. Raises `ConfigError` for a negative `max_gap_ms`.
    """

    def __init__(self, max_gap_ms: float = 20.0, capacity: int = 64) -> None:
        if max_gap_ms < 0 or capacity < 1:
            raise ConfigError(f"max_gap_ms={max_gap_ms}, capacity={capacity}: need max_gap_ms >= 0 and capacity >= 1")
        self._max_gap_ns = round(max_gap_ms * _NS_PER_MS)
        self._pushed: deque[_Pushed] = deque(maxlen=capacity)
        self._last_frame_ns = -1
        self._lock = Lock()

    def push(self, timestamp_ns: int, hands: Sequence[HandObservation]) -> None:
        """Add the hands seen at one capture time (same clock as the frames).

        Raises `FrameError` when time does not rise, or for two hands of one side.
        """
        if len({hand.handedness for hand in hands}) != len(hands):
            raise FrameError("two pushed hands are of the same side", hint="Push at most one left and one right hand of the wearer")
        with self._lock:
            if self._pushed and timestamp_ns <= self._pushed[-1].timestamp_ns:
                raise FrameError(
                    f"pushed hands have timestamp_ns={timestamp_ns}, not after {self._pushed[-1].timestamp_ns}",
                    hint="Push in order of capture, or call reset() first",
                )
            self._pushed.append(_Pushed(timestamp_ns, tuple(sorted(hands, key=lambda hand: hand.hand_id))))

    def track(self, frame: Frame) -> tuple[HandObservation, ...]:
        """The pushed hands for this frame; raises `FrameError` when its time does not rise."""
        with self._lock:
            if frame.timestamp_ns <= self._last_frame_ns:
                raise FrameError(f"frame {frame.index} has timestamp_ns={frame.timestamp_ns}, not after {self._last_frame_ns}")
            self._last_frame_ns = frame.timestamp_ns
            nearest = min(self._pushed, key=lambda pushed: abs(pushed.timestamp_ns - frame.timestamp_ns), default=None)
        if nearest is None or abs(nearest.timestamp_ns - frame.timestamp_ns) > self._max_gap_ns:
            return ()
        return nearest.hands

    def reset(self) -> None:
        """Forget all pushed hands."""
        with self._lock:
            self._pushed.clear()
            self._last_frame_ns = -1


def _joints(value: npt.ArrayLike, name: str, columns: tuple[int, ...]) -> npt.NDArray[np.float64]:
    try:
        array = np.asarray(value, np.float64)
    except (TypeError, ValueError) as error:
        raise FrameError(f"{name} is not a table of numbers ({error})") from error
    if array.ndim != 2 or array.shape[0] not in (NUM_JOINTS, NUM_WEBXR_JOINTS) or array.shape[1] not in columns:
        raise FrameError(
            f"{name} has shape {array.shape}, need ({NUM_JOINTS} or {NUM_WEBXR_JOINTS}, {' or '.join(map(str, columns))})",
            hint="Use MediaPipe's 21 landmarks or WebXR's 25 joints in the order of their specification",
        )
    if not np.isfinite(array).all():
        raise FrameError(f"{name} holds a value that is not finite", hint="Leave out a hand whose joints are not all tracked")
    return array[list(WEBXR_INDEX)] if len(array) == NUM_WEBXR_JOINTS else array


def _spread(points: npt.NDArray[np.float64], name: str) -> float:
    spread = float(np.sqrt(((points - points.mean(0)) ** 2).sum(1).mean()))
    if spread == 0:
        raise FrameError(f"all {name} lie in one point")
    return spread
