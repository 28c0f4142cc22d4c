"""From fingertip samples to touch events: one small state machine per finger of each side.

Timing cases. One letter per frame: C = touch probability at or above `down`, b = between the thresholds, L = below `up`,
- = not seen. Coasting is 2 frames, a stall 250 ms; both are settings.

    L C          hover_enter, down
    C C          hover_enter, down           a finger that appears touching goes down one frame later
    L b b        hover_enter, 2 hover_move   between the thresholds nothing begins
    C C b C      ... down, 2 move            and nothing ends
    C C L L      ... down, up, hover_move
    C C - - C    ... down, move              up to 2 unseen frames are bridged, silently
    C C - - L    ... down, up                a lift seen after a bridge is a lift
    C C - - -    ... down, cancel(tracking_lost), hover_exit          at the third unseen frame
    L - - -      hover_enter, hover_exit
    C C | C      ... down, cancel(source_stalled), hover_exit, hover_enter     "|" = more than 250 ms between two frames
    C C ! C      ... down, cancel(hand_swapped), hover_exit, hover_enter       "!" = farther on the limb than a finger can
                 have moved, or another hand_id on this side, or the same hand_id on the other side
    C C end      ... down, cancel(source_ended), hover_exit

Not handled here: a touch that lifts and lands again between two frames is one touch; a touch shorter than the filter before
this stage is none; a source that stops without another frame cannot be noticed from its frames: call `finish`.
All times are capture times; no clock is read.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from egotouch_sdk.config import StateConfig
from egotouch_sdk.errors import FrameError
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.state.inputs import Thresholds, has_jumped
from egotouch_sdk.state.sample import FingertipSample
from egotouch_sdk.state.table import INPUT_OF_REASON, REASONS, TABLE, Input, PointerState
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent

_WITH_FORCE = (EventType.DOWN, EventType.MOVE)


@dataclass(slots=True)
class _Pointer:
    """One fingertip from HOVER_ENTER to HOVER_EXIT."""

    pointer_id: int
    last: FingertipSample
    seen_ns: int
    state: PointerState = PointerState.ABSENT
    contact_id: int = 0
    missed_frames: int = 0
    down_ns: int = 0
    down: HostPoint = field(init=False)

    def __post_init__(self) -> None:
        self.down = self.last.point


class TouchStateMachine:
    """Turns the samples of one frame after another into events that keep the grammar.

    At most one pointer is open per finger of each side; `pointer_id` counts up and is never used twice.
    """

    def __init__(self, config: StateConfig, thresholds: Thresholds) -> None:
        self._config = config
        self._thresholds = thresholds
        self._stall_ns = round(config.stall_ms * 1e6)
        self._pointers: dict[tuple[Handedness, Finger], _Pointer] = {}
        self._next_id = 1
        self._time_ns = -1

    def step(self, samples: Sequence[FingertipSample], timestamp_ns: int) -> tuple[TouchEvent, ...]:
        """Advance by one frame; call it for every frame, also with no samples.

        Raises `FrameError` when time does not rise, or when two samples are of the same finger and side; the state is then as before.
        """
        if timestamp_ns <= self._time_ns:
            raise FrameError(f"frame time {timestamp_ns} ns is not after {self._time_ns} ns", hint="Use the capture time of each frame")
        seen = {(sample.handedness, sample.finger): sample for sample in samples}
        if len(seen) < len(samples):
            raise FrameError("two fingertip samples are of the same finger and side", hint="Give one hand per side")
        stalled = self._pointers and timestamp_ns - self._time_ns > self._stall_ns
        self._time_ns = timestamp_ns
        events = [*self._end_all(Input.STALLED)] if stalled else []
        hand_sides = {sample.hand_id: sample.handedness for sample in samples}
        for slot, pointer in tuple(self._pointers.items()):
            cause = self._read(pointer, seen.get(slot), hand_sides)
            if cause in (Input.CONTACT, Input.BETWEEN, Input.LIFTED):
                pointer.last, pointer.seen_ns, pointer.missed_frames = seen[slot], timestamp_ns, 0
            events += self._advance(slot, pointer, cause)
        for slot, sample in seen.items():
            if slot not in self._pointers:
                pointer = self._pointers[slot] = _Pointer(self._next_id, sample, timestamp_ns)
                self._next_id += 1
                events += self._advance(slot, pointer, self._thresholds.read(sample.touch_probability))
        return tuple(events)

    @property
    def pointers(self) -> dict[int, tuple[PointerState, int]]:
        """State and number of unseen frames of every open pointer, by its id."""
        return {pointer.pointer_id: (pointer.state, pointer.missed_frames) for pointer in self._pointers.values()}

    def finish(self, timestamp_ns: int, reason: CancelReason) -> tuple[TouchEvent, ...]:
        """Cancel every touch and let every pointer leave; stamped no earlier than the last frame.

        The next frame may carry any time, so the machine can go on with another source.
        """
        self._time_ns = max(self._time_ns, timestamp_ns)
        events = tuple(self._end_all(INPUT_OF_REASON.get(reason, Input.ENDED), reason))
        self._time_ns = -1
        return events

    def _read(self, pointer: _Pointer, sample: FingertipSample | None, hand_sides: dict[int, Handedness]) -> Input:
        if sample is None:
            if hand_sides.get(pointer.last.hand_id, pointer.last.handedness) is not pointer.last.handedness:
                return Input.SWAPPED
            pointer.missed_frames += 1
            return Input.LOST if pointer.missed_frames > self._config.coast_frames else Input.MISSING
        if sample.hand_id != pointer.last.hand_id or self._has_jumped(pointer, sample):
            return Input.SWAPPED
        return self._thresholds.read(sample.touch_probability)

    def _has_jumped(self, pointer: _Pointer, sample: FingertipSample) -> bool:
        is_touching = pointer.state is PointerState.TOUCH
        return has_jumped(pointer.last, sample, self._time_ns - pointer.seen_ns, self._config, is_touching=is_touching)

    def _end_all(self, cause: Input, reason: CancelReason | None = None) -> Iterator[TouchEvent]:
        for slot, pointer in tuple(self._pointers.items()):
            yield from self._advance(slot, pointer, cause, reason)

    def _advance(
        self, slot: tuple[Handedness, Finger], pointer: _Pointer, cause: Input, reason: CancelReason | None = None
    ) -> Iterator[TouchEvent]:
        pointer.state, types = TABLE[pointer.state, cause]
        if pointer.state is PointerState.ABSENT:
            del self._pointers[slot]
        for event_type in types:
            if event_type is EventType.DOWN:
                pointer.contact_id += 1
                pointer.down_ns, pointer.down = self._time_ns, pointer.last.point
            yield self._event(event_type, pointer, (reason or REASONS[cause]) if event_type is EventType.CANCEL else None)

    def _event(self, event_type: EventType, pointer: _Pointer, reason: CancelReason | None) -> TouchEvent:
        sample, point, down = pointer.last, pointer.last.point, pointer.down
        is_hover = event_type.is_hover
        return TouchEvent(
            type=event_type,
            pointer_id=pointer.pointer_id,
            contact_id=pointer.contact_id,
            timestamp_ns=self._time_ns,
            down_time_ns=None if is_hover else pointer.down_ns,
            hand=sample.handedness,
            finger=sample.finger,
            surface=point.surface,
            touch_probability=sample.touch_probability,
            force_n=sample.force_n if event_type in _WITH_FORCE else 0.0,
            force_sigma_n=sample.force_sigma_n if event_type in _WITH_FORCE else None,
            x_mm=point.x_mm,
            y_mm=point.y_mm,
            dx_mm=0.0 if is_hover else point.x_mm - down.x_mm,
            dy_mm=0.0 if is_hover else point.y_mm - down.y_mm,
            pitch_rad=point.pitch_rad,
            yaw_rad=point.yaw_rad,
            image_x=sample.image_xy[0],
            image_y=sample.image_xy[1],
            reason=reason,
        )
