"""A labelled recording through the product's own chain: hands, gate, patches, touch model, median, state machine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from egotouch_sdk.capture_time import CaptureTime
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import SourceError
from egotouch_sdk.evaluation.datasets.recording import GivenHands, LabelledRecording
from egotouch_sdk.evaluation.false_touches import nobody
from egotouch_sdk.evaluation.round_score import RoundScore, score_round
from egotouch_sdk.evaluation.round_truth import Truth
from egotouch_sdk.evaluation.study_run import Answers, follow
from egotouch_sdk.frame import Frame
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.joints import Handedness
from egotouch_sdk.observation import TouchEstimate, TouchPair
from egotouch_sdk.patches import extract
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.state import PointerState, Thresholds
from egotouch_sdk.touch import TouchModel, TouchStream

OnFrame = Callable[[Frame], object]


@dataclass(frozen=True, slots=True)
class _Seen:
    """One frame: what the model said about the labelled finger, if it was looked at, and what came of it."""

    index: int
    timestamp_ns: int
    own: TouchEstimate | None
    smooth: TouchEstimate | None = None
    live: bool = False


def score_recording(
    recording: LabelledRecording,
    model: TouchModel,
    config: TouchConfig | None = None,
    hands: HandSource | None = None,
    done: OnFrame | None = None,
) -> RoundScore:
    """Score one recording; `hands` finds the hands where the data set brings none (None: the built-in tracker), `done` hears of frames.

    Raises `SourceError` naming what cannot be read, or a recording without a single frame.
    """
    config = config or TouchConfig()
    seen = list(_through_pipeline(recording, model, config, hands, done) if recording.has_host else _alone(recording, model, config, done))
    if not seen:
        raise SourceError(f"recording {recording.name} of {recording.participant} has no frame", hint="Leave it out, or record it again")
    own = Thresholds(model.manifest.down_probability, model.manifest.up_probability).overridden_by(config.state)
    if not recording.has_host:
        times_ns, estimates = [each.timestamp_ns for each in seen], {n: each.own for n, each in enumerate(seen) if each.own is not None}
        return score_round(_truth(recording, seen), follow(times_ns, estimates, own, config.state), own.down)
    told = np.full((4, len(seen)), np.nan)
    for number, each in enumerate(seen):
        if each.own is not None and each.smooth is not None:
            told[:, number] = each.own.touch_probability, each.own.force_n, each.smooth.touch_probability, each.smooth.force_n
    live = np.array([each.live for each in seen])
    return score_round(_truth(recording, seen), Answers(told[0], told[1], told[2], told[3], live), own.down)


def _truth(recording: LabelledRecording, seen: list[_Seen]) -> Truth:
    labels = [recording.labels.get(each.index) for each in seen]
    return Truth(
        participant=recording.participant,
        name=recording.name,
        conditions=recording.conditions,
        is_hover=recording.is_hover,
        is_drag=recording.is_drag,
        fps=recording.fps,
        timestamp_ns=np.array([each.timestamp_ns for each in seen], np.int64),
        touch=np.array([label is not None and label.touch for label in labels]),
        force_n=np.array([np.nan if label is None else label.force_n for label in labels]),
        hover_mm=np.array([np.nan if label is None else label.hover_mm for label in labels]),
        gate=np.array([label is not None and each.own is not None for label, each in zip(labels, seen, strict=True)]),
    )


def _through_pipeline(
    recording: LabelledRecording, model: TouchModel, config: TouchConfig, hands: HandSource | None, done: OnFrame | None
) -> list[_Seen]:
    given = hands if recording.landmarks is None else GivenHands(recording.landmarks)
    pipeline, seen = TouchPipeline(config, hands=given, touch=model), []
    for frame in recording.read():
        seen.append(_look(recording, pipeline.process(frame), pipeline))
        if done is not None:
            done(frame)
    if seen:
        pipeline.finish(seen[-1].timestamp_ns)
    return seen


def _look(recording: LabelledRecording, result: FrameResult, pipeline: TouchPipeline) -> _Seen:
    """The labelled finger in one frame; where two hands could be meant, the one that surely touches more."""

    def is_meant(hand: Handedness) -> bool:
        return recording.touching_hand in (None, hand)

    meant = [
        (own, smooth)
        for tip, own, smooth in zip(result.fingertips, result.estimates, result.filtered, strict=True)
        if tip.finger is recording.finger and is_meant(tip.handedness)
    ]
    own, smooth = max(meant, key=lambda pair: pair[0].touch_probability, default=(None, None))
    live = any(
        each.touch is PointerState.TOUCH and each.finger is recording.finger and is_meant(each.hand) for each in pipeline.engine.pointers
    )
    return _Seen(result.index, result.timestamp_ns, own, smooth, live)


def _alone(recording: LabelledRecording, model: TouchModel, config: TouchConfig, done: OnFrame | None) -> list[_Seen]:
    """Every frame's patch cut by the given joints, host unknown."""
    stream, time, seen = TouchStream(model, config.touch.memory_ms), CaptureTime(config.state.stall_ms), []
    for frame in recording.read():
        if not time.advance(frame.timestamp_ns):
            stream.reset()
        hands = (recording.landmarks or {}).get(frame.index, ())
        pairs = [TouchPair(hand, nobody(hand), 0.0, (recording.finger,)) for hand in hands]
        patches = [patch for pair in pairs for patch in extract(frame, pair, config.patches, mirrored=config.hands.mirrored)]
        own = next(iter(stream.estimate(patches[:1], frame.timestamp_ns)), None)
        seen.append(_Seen(frame.index, frame.timestamp_ns, own))
        if done is not None:
            done(frame)
    return seen
