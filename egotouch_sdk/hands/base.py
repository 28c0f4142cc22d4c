"""What the rest of the pipeline needs from anything that finds hands."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from egotouch_sdk.frame import Frame
from egotouch_sdk.observation import HandObservation


@runtime_checkable
class HandSource(Protocol):
    """Turns frames into hands: the built-in tracker, a headset's joints, or your own."""

    def track(self, frame: Frame) -> tuple[HandObservation, ...]:
        """Hands in this frame, at most one per side of the wearer; empty when there are none.

        Raises `FrameError` when `frame.timestamp_ns` does not rise from call to call.
        """
        ...

    def reset(self) -> None:
        """Forget everything seen so far; the next frame may carry any time."""
        ...
