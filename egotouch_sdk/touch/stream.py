"""The touch model over the frames of one stream: what it remembers of a finger is handed on from frame to frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import FingertipPatch, FloatArray, TouchEstimate
from egotouch_sdk.touch.model import TouchModel


@dataclass(frozen=True, slots=True)
class _Remembered:
    """What the model kept of one finger, (M,), and when that finger was seen."""

    memory: FloatArray
    seen_ns: int


class TouchStream:
    """Judges the fingers of one stream frame by frame, each finger of each hand with the model's memory of its earlier frames.

    A finger last seen more than `memory_ms` of capture time before is judged as if it had never been seen. With a model without memory
    every frame is judged alone.
    """

    def __init__(self, model: TouchModel, memory_ms: float) -> None:
        self._model = model
        self._memory_ns = round(memory_ms * 1e6)
        self._nothing = np.zeros(model.memory_size, np.float32)
        self._fingers: dict[tuple[int, Finger], _Remembered] = {}

    def estimate(self, patches: Sequence[FingertipPatch], timestamp_ns: int) -> tuple[TouchEstimate, ...]:
        """One frame's estimates in the order of its patches, at most one patch per finger; frames come in the order of their capture.

        Raises `ModelError` when the network answers with something that is not a number; memories stay as they were then.
        """
        if not self._model.memory_size:
            return self._model.estimate(patches)
        oldest_ns = timestamp_ns - self._memory_ns
        self._fingers = {key: finger for key, finger in self._fingers.items() if finger.seen_ns >= oldest_ns}
        if not patches:
            return ()
        keys = [(patch.hand_id, patch.finger) for patch in patches]
        memories = np.stack([self._fingers[key].memory if key in self._fingers else self._nothing for key in keys])
        estimates, kept = self._model.estimate_next(patches, memories)
        self._fingers.update((key, _Remembered(memory, timestamp_ns)) for key, memory in zip(keys, kept, strict=True))
        return estimates

    def reset(self) -> None:
        """Forget every finger; afterwards the stream behaves like a new one."""
        self._fingers.clear()
