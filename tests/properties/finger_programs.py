"""Random observation streams, written as short programs of bytes: every byte string is one, and a shorter one is simpler.

Hypothesis draws and shrinks the bytes. Each byte is an instruction for one of four fingertips, two on either side, or lets frames
go by, so that even a few bytes make touches that are held, drag, press, coast, jump and are cut off.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from egotouch_sdk.config import GestureConfig, StateConfig
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.gestures import GestureRecognizer
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HostPoint
from egotouch_sdk.state import FingertipSample, Thresholds, TouchStateMachine
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import CancelReason, TouchEvent

SLOTS = tuple((hand, finger) for hand in (Handedness.RIGHT, Handedness.LEFT) for finger in (Finger.INDEX, Finger.THUMB))
#: Usual frame times, and at the edges of what coasting, stalls and clocks allow.
GAPS_NS = (33_333_333, 11_111_111, 16_666_667, 66_666_667, 100_000_000, 250_000_000, 250_000_001, 1)
COUNTS = (1, 2, 3, 13)
PROBABILITIES = (0.9, 0.1, 0.5, 0.6, 0.4, 0.9, 0.1, 0.0)
FORCES_N = (1.0, 1.5, 1.6, 2.5, 3.5, 1.3, 0.5, 0.0)
STEPS_MM = ((0.0, 0.0), (1.0, 0.0), (0.0, 3.5), (-3.5, 0.0), (10.0, 10.0), (-15.0, 0.0), (60.0, 0.0), (0.0, -400.0))
STATE_CONFIGS = tuple(StateConfig(coast_frames=frames) for frames in range(4))
GESTURE_CONFIGS = (
    GestureConfig(),
    GestureConfig(long_press_timeout_ms=30, tap_timeout_ms=0, double_tap_min_ms=0, double_tap_timeout_ms=2000, force_step_n=0),
)
THRESHOLDS = Thresholds(0.6, 0.4)


@dataclass(slots=True)
class _Tip:
    """One fingertip as the program left it; `sample` is what a frame shows of it, None while it is out of sight."""

    slot: int
    hand_id: int
    probability: float = 0.1
    force_n: float = 1.0
    x_mm: float = 0.0
    y_mm: float = 0.0
    sample: FingertipSample | None = None

    def show(self) -> None:
        """Make it visible as it is now."""
        hand, finger = SLOTS[self.slot]
        x_px, y_px = 500 + 2 * self.x_mm, 500 + 2 * self.y_mm
        point = HostPoint(Surface.PALM if self.y_mm >= 0 else Surface.INNER_FOREARM, self.x_mm, self.y_mm, 0.7, 0.0)
        self.sample = FingertipSample(
            self.hand_id, hand, finger, self.probability, self.force_n, (x_px, y_px), 2.0, (x_px / 1000, y_px / 1000), point
        )


def frames_of(program: bytes) -> Iterator[tuple[int, list[FingertipSample]] | CancelReason]:
    """The frames of a program: the time since the frame before and what is seen, or why the source ended."""
    tips = [_Tip(slot, 1 + slot // 2) for slot in range(len(SLOTS))]
    for byte in program:
        instruction, argument, tip = byte >> 5, byte & 7, tips[(byte >> 3) & 3]
        frames, gap_ns = 1, GAPS_NS[0]
        if instruction <= 1:
            tip.probability = 0.1 if tip.probability > 0.5 else 0.9
            tip.show()
            gap_ns = GAPS_NS[argument] if instruction == 0 else gap_ns
        elif instruction == 2:
            tip.x_mm, tip.y_mm = tip.x_mm + STEPS_MM[argument][0], tip.y_mm + STEPS_MM[argument][1]
            tip.show()
        elif instruction == 3:
            tip.force_n = FORCES_N[argument]
            tip.show()
        elif instruction == 4:
            tip.probability = PROBABILITIES[argument]
            tip.show()
        elif instruction == 5:
            tip.sample = None
            frames = argument & 3
        elif instruction == 6:
            frames, gap_ns = COUNTS[byte >> 3 & 3], GAPS_NS[argument]
        elif argument < 3:
            yield list(CancelReason)[argument + 3]
            continue
        elif argument < 5:
            tip.hand_id = 3 - tip.hand_id if argument == 3 else tip.hand_id + 2
            tip.show()
        seen = [tip.sample for tip in tips if tip.sample is not None]
        for _ in range(frames):
            yield gap_ns, seen


def play(program: bytes, verifier: GrammarVerifier) -> list[TouchEvent]:
    """Drive a new state machine and gestures through a program; its first byte chooses the settings, the end is the source's."""
    choice = program[0] if program else 0
    machine = TouchStateMachine(STATE_CONFIGS[choice & 3], THRESHOLDS)
    gestures = GestureRecognizer(GESTURE_CONFIGS[choice >> 2 & 1])
    events: list[TouchEvent] = []
    time_ns = 0
    for frame in frames_of(program[1:]):
        if isinstance(frame, CancelReason):
            raw = machine.finish(time_ns, frame)
        else:
            time_ns += frame[0]
            raw = machine.step(frame[1], time_ns)
        new = gestures.feed(raw)
        verifier.feed(new)
        events += new
    new = gestures.feed(machine.finish(time_ns, CancelReason.SOURCE_ENDED))
    verifier.feed(new)
    verifier.close()
    return [*events, *new]
