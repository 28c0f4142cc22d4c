"""A labelled recording of any data set: its frames, and for each of them what truly happened."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isfinite, isnan, nan
from pathlib import Path

from egotouch_sdk.errors import SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import FORCE_MAX_N, HandObservation


@dataclass(frozen=True, slots=True)
class Label:
    """The truth of one frame; `force_n` and `hover_mm` are nan where nobody measured, forces above the range count as 3.5 N."""

    touch: bool
    force_n: float = nan
    hover_mm: float = nan

    def __post_init__(self) -> None:
        for name in ("force_n", "hover_mm"):
            value = getattr(self, name)
            if not isnan(value) and not (isfinite(value) and value >= 0):
                raise SourceError(f"{name} of a label is {value}", hint="Need a number from 0, or nothing")
        object.__setattr__(self, "force_n", min(self.force_n, FORCE_MAX_N) if self.force_n == self.force_n else nan)


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelledRecording:
    """One recording.

    `read` opens its frames, one after another; frames are known by `Frame.index`. `labels` has one entry per labelled frame; all
    others are shown to the pipeline but not scored. `touching_hand` is None where either hand may be the one.
    `landmarks` are hands that the data set brings, by frame; None lets the built-in tracker find them.
    `has_host` is False where nothing but the touching hand is ever seen, as on a pad: then the gate is not asked.
    `conditions` has the recording's value of each condition, `is_hover` and `is_drag` say what was asked for.
    """

    participant: str
    name: str
    fps: float
    labels: Mapping[int, Label] = field(repr=False)
    read: Callable[[], Iterator[Frame]] = field(repr=False)
    finger: Finger = Finger.INDEX
    touching_hand: Handedness | None = None
    conditions: Mapping[str, str] = field(default_factory=dict)
    is_hover: bool = False
    is_drag: bool = False
    landmarks: Mapping[int, tuple[HandObservation, ...]] | None = field(default=None, repr=False)
    has_host: bool = True


@dataclass(frozen=True, slots=True)
class RecordingFile:
    """A recording that was found but not yet read; `load` raises `SourceError` naming the file that is wrong."""

    participant: str
    name: str
    path: Path
    load: Callable[[], LabelledRecording] = field(repr=False)


class GivenHands:
    """A `HandSource` that answers with the landmarks of a recording."""

    def __init__(self, landmarks: Mapping[int, tuple[HandObservation, ...]]) -> None:
        self._landmarks = landmarks

    def track(self, frame: Frame) -> tuple[HandObservation, ...]:
        """The hands of this frame."""
        return self._landmarks.get(frame.index, ())

    def reset(self) -> None:
        """Nothing to forget."""
