"""Scripted stages for tests of what joins them."""

from __future__ import annotations

import numpy as np

from egotouch_sdk.frame import Frame
from egotouch_sdk.observation import HandObservation

FRAME_NS = 33_333_333


class ScriptedHands:
    """A hand source that gives the hands it was last told, as a headset would."""

    def __init__(self) -> None:
        self.hands: tuple[HandObservation, ...] = ()
        self.resets = 0

    def track(self, frame: Frame) -> tuple[HandObservation, ...]:
        return self.hands

    def reset(self) -> None:
        self.resets += 1


def grey_frame(index: int, timestamp_ns: int | None = None) -> Frame:
    """A plain 1280 x 720 picture, the `index`-th at 30 fps."""
    return Frame(np.full((720, 1280, 3), 128, np.uint8), index * FRAME_NS if timestamp_ns is None else timestamp_ns, index)
