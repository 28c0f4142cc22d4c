"""The ground truth of a clip: true touches, and the events that a perfect view of them would have given. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from egotouch_sdk.config import GestureConfig
from egotouch_sdk.errors import SourceError
from egotouch_sdk.gestures import GestureRecognizer
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent

Tip = tuple[str, str]
Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class TrueTouch:
    """One touch of the ground truth: which fingertip (hand, finger), first and last touching frame's time and number."""

    tip: Tip
    start_ns: int
    end_ns: int
    start_frame: int
    end_frame: int


@dataclass(frozen=True, slots=True)
class ClipTruth:
    """Ground truth of a clip: its touches, and for every touching fingertip and frame number its force and its place.

    `force_n` is in newtons, `place_mm` the touched point in the host frame (x, y). A truth without places has no drags.
    """

    fps: float
    touches: tuple[TrueTouch, ...]
    force_n: Mapping[tuple[Tip, int], float]
    place_mm: Mapping[tuple[Tip, int], Place] = field(default_factory=dict)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> ClipTruth:
        """Read the truth format of the demo clip: `fps`, `frames` (one object per frame) and `touches`.

        Raises `SourceError` naming what is missing.
        """
        try:
            fps = float(data["fps"])
            frames = {int(frame["frame"]): frame for frame in data["frames"]}
            spans = [(int(touch["start_frame"]), int(touch["end_frame"])) for touch in data["touches"]]
            touches = [
                TrueTouch(_tip(frames[start]), round(start * 1e9 / fps), round(end * 1e9 / fps), start, end) for start, end in sorted(spans)
            ]
            force_n = {(_tip(frame), index): float(frame["force_n"]) for index, frame in frames.items() if frame["touching"]}
            place_mm = {
                (_tip(frame), index): (float(frame["at_mm"][0]), float(frame["at_mm"][1]))
                for index, frame in frames.items()
                if frame["touching"] and "at_mm" in frame
            }
        except (KeyError, TypeError, ValueError, IndexError, ZeroDivisionError) as error:
            raise SourceError(f"the ground truth has another form ({error!r})", hint="Compare it with assets/demo_truth.json") from error
        return cls(fps, tuple(touches), force_n, place_mm)

    def force_at_n(self, frame: int) -> float:
        """The largest true force of any fingertip in a frame, 0 where nothing touches."""
        return max((force_n for (_, touched), force_n in self.force_n.items() if touched == frame), default=0.0)

    def until(self, end_ns: int) -> ClipTruth:
        """The truth of a clip that was left at `end_ns`: touches that began by then."""
        return ClipTruth(self.fps, tuple(touch for touch in self.touches if touch.start_ns <= end_ns), self.force_n, self.place_mm)

    def events(self, touch: TrueTouch, config: GestureConfig) -> tuple[TouchEvent, ...]:
        """What the recogniser makes of a true touch when it is told its true places and forces: its true gestures."""
        recognizer = GestureRecognizer(config)
        frames = range(touch.start_frame, touch.end_frame + 2)
        return tuple(event for frame in frames for event in recognizer.feed([self._raw_event(touch, frame)]))

    def _raw_event(self, touch: TrueTouch, frame: int) -> TouchEvent:
        is_up = frame > touch.end_frame
        place = touch.tip, min(frame, touch.end_frame)
        x_mm, y_mm = self.place_mm.get(place, (0.0, 0.0))
        start_x_mm, start_y_mm = self.place_mm.get((touch.tip, touch.start_frame), (0.0, 0.0))
        return TouchEvent(
            type=EventType.UP if is_up else EventType.DOWN if frame == touch.start_frame else EventType.MOVE,
            pointer_id=1,
            contact_id=1,
            timestamp_ns=round(frame * 1e9 / self.fps),
            down_time_ns=touch.start_ns,
            hand=Handedness(touch.tip[0]),
            finger=Finger(touch.tip[1]),
            surface=Surface.PALM,
            touch_probability=0.0 if is_up else 1.0,
            force_n=0.0 if is_up else self.force_n.get(place, 0.0),
            x_mm=x_mm,
            y_mm=y_mm,
            dx_mm=x_mm - start_x_mm,
            dy_mm=y_mm - start_y_mm,
            pitch_rad=0.0,
            yaw_rad=0.0,
            image_x=0.0,
            image_y=0.0,
        )


def _tip(frame: Mapping[str, Any]) -> Tip:
    return str(frame["hand"]), str(frame["finger"])
