"""A round through the touch model, the three-frame median and the touch state machine, as in live use. No I/O, no clock."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from egotouch_sdk.capture_time import CaptureTime
from egotouch_sdk.config import StateConfig, TouchModelConfig
from egotouch_sdk.filters import MedianFilter
from egotouch_sdk.joints import Handedness
from egotouch_sdk.observation import FingertipPatch, HostPoint, TouchEstimate
from egotouch_sdk.patches import PATCH_PX_PER_MM
from egotouch_sdk.state import FingertipSample, PointerState, Thresholds, TouchStateMachine
from egotouch_sdk.study_data import StudyRound
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch import TouchModel, TouchStream
from egotouch_sdk.touch_event import TouchEvent

#: Patches shown to the model at once (our choice; more is no faster on two cores).
BATCH = 64
_HAND_ID = 1
_TIP_PX = (0.0, 0.0)
_PLACE = HostPoint(Surface.PALM, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Answers:
    """What was told in each frame of a round.

    `probability` and `force_n` (T,) come from the model, `median_probability` and `median_force_n` (T,) from the causal three-frame
    median, which shows everything one frame late; all are nan where the gate was closed. `live` (T,) is True from DOWN to UP or
    CANCEL of the state machine.
    """

    probability: npt.NDArray[np.float64]
    force_n: npt.NDArray[np.float64]
    median_probability: npt.NDArray[np.float64]
    median_force_n: npt.NDArray[np.float64]
    live: npt.NDArray[np.bool_]


def answer(study_round: StudyRound, model: TouchModel, config: StateConfig | None = None) -> Answers:
    """Everything the product would have told about a round; thresholds are the model's own unless `config` sets others."""
    own, config = Thresholds(model.manifest.down_probability, model.manifest.up_probability), config or StateConfig()
    return follow(study_round.timestamp_ns.tolist(), estimate_frames(study_round, model, config.stall_ms), own, config)


def estimate_frames(study_round: StudyRound, model: TouchModel, stall_ms: float) -> dict[int, TouchEstimate]:
    """The model's answer for every frame whose gate is open, by frame number.

    A model with memory sees the frames one after another and remembers the finger as long as the default settings say.
    """
    meta = study_round.meta
    shown = {
        int(frame): FingertipPatch(
            hand_id=_HAND_ID,
            handedness=meta.touching_hand,
            finger=meta.finger,
            tip_px=_TIP_PX,
            px_per_mm=PATCH_PX_PER_MM,
            r_palms=float(study_round.polar[frame, 0]),
            theta_rad=float(study_round.polar[frame, 1]),
            image=study_round.patches[frame],
        )
        for frame in np.flatnonzero(study_round.gate)
    }
    if model.memory_size:
        return _estimate_film(study_round.timestamp_ns.tolist(), shown, model, stall_ms)
    patches = list(shown.values())
    estimates = [told for start in range(0, len(patches), BATCH) for told in model.estimate(patches[start : start + BATCH])]
    return dict(zip(shown, estimates, strict=True))


def _estimate_film(
    times_ns: Sequence[int], shown: Mapping[int, FingertipPatch], model: TouchModel, stall_ms: float
) -> dict[int, TouchEstimate]:
    stream, time, told = TouchStream(model, TouchModelConfig().memory_ms), CaptureTime(stall_ms), {}
    for frame, timestamp_ns in enumerate(times_ns):
        if not time.advance(timestamp_ns):
            stream.reset()
        if frame in shown:
            (told[frame],) = stream.estimate([shown[frame]], timestamp_ns)
    return told


def follow(times_ns: Sequence[int], estimates: Mapping[int, TouchEstimate], thresholds: Thresholds, config: StateConfig) -> Answers:
    """Run one finger's estimates, by number of the frame in `times_ns` (T,), through the median and the state machine.

    Frames without an estimate count as not seen.
    """
    chain = StillFingers(thresholds.overridden_by(config), config)
    sides = {estimate.hand_id: Handedness.RIGHT for estimate in estimates.values()}
    told = np.full((4, len(times_ns)), np.nan)
    live = np.zeros(len(times_ns), bool)
    for frame, timestamp_ns in enumerate(times_ns):
        raw = [estimates[frame]] if frame in estimates else []
        filtered, _ = chain.step(raw, timestamp_ns, sides)
        for own, smooth in zip(raw, filtered, strict=True):
            told[:, frame] = own.touch_probability, own.force_n, smooth.touch_probability, smooth.force_n
        live[frame] = chain.is_touching
    return Answers(told[0], told[1], told[2], told[3], live)


class StillFingers:
    """The live chain behind the touch model, for fingers of which only pictures are known: each stays where it is on the skin.

    Settings of `config` are those of `state`; `thresholds` count as they are.
    """

    def __init__(self, thresholds: Thresholds, config: StateConfig) -> None:
        self._median = MedianFilter(config.coast_frames)
        self._machine = TouchStateMachine(config, thresholds)
        self._stall_ns = config.stall_ms * 1e6
        self._last_ns: int | None = None

    def step(
        self, estimates: Sequence[TouchEstimate], timestamp_ns: int, sides: Mapping[int, Handedness]
    ) -> tuple[tuple[TouchEstimate, ...], tuple[TouchEvent, ...]]:
        """One frame's estimates, filtered, and the events they cause; `sides` tells the hand of each `hand_id`."""
        if self._last_ns is not None and timestamp_ns - self._last_ns > self._stall_ns:
            self._median.reset()
        self._last_ns = timestamp_ns
        filtered = self._median.apply(estimates)
        return filtered, self._machine.step([_sample(each, sides[each.hand_id]) for each in filtered], timestamp_ns)

    @property
    def is_touching(self) -> bool:
        """True while any finger touches."""
        return any(state is PointerState.TOUCH for state, _ in self._machine.pointers.values())


def _sample(estimate: TouchEstimate, side: Handedness) -> FingertipSample:
    return FingertipSample(
        hand_id=estimate.hand_id,
        handedness=side,
        finger=estimate.finger,
        touch_probability=estimate.touch_probability,
        force_n=estimate.force_n,
        tip_px=_TIP_PX,
        px_per_mm=PATCH_PX_PER_MM,
        image_xy=(0.5, 0.5),
        point=_PLACE,
    )
