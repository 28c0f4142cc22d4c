from collections.abc import Iterator

import numpy as np
import pytest

from egotouch_sdk.cli.play import play
from egotouch_sdk.errors import SourceError
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import TouchEstimate
from egotouch_sdk.pipeline import TouchPipeline
from egotouch_sdk.touch import TouchModel
from egotouch_sdk.touch_event import CancelReason, EventType, TouchEvent
from tests.support.hands import host_hand, palm_centre, pointing_hand
from tests.support.sources import ScriptedHands, grey_frame


class TouchingModel(TouchModel):
    """The shipped model with its mind made up: everything touches."""

    memory_size = 0

    def estimate(self, patches):
        return tuple(TouchEstimate(patch.hand_id, patch.finger, 0.99, 1.0) for patch in patches)


@pytest.fixture
def pipeline() -> TouchPipeline:
    """A pipeline over two scripted hands, index fingertip on the palm."""
    host = host_hand()
    hands = ScriptedHands()
    hands.hands = (pointing_hand(palm_centre(host)), host)
    return TouchPipeline(hands=hands, touch=TouchingModel())


def frames(count: int, then: BaseException | None = None) -> Iterator[Frame]:
    yield from (grey_frame(index) for index in range(count))
    if then:
        raise then


def test_a_touch_open_at_the_end_is_cancelled_because_the_source_ended(pipeline: TouchPipeline) -> None:
    events: list[TouchEvent] = []
    run = play(frames(6), pipeline, events.append)
    assert (run.frames, run.interrupted) == (6, False)
    assert [event.type for event in events if event.finger is Finger.INDEX][-2:] == [EventType.CANCEL, EventType.HOVER_EXIT]
    assert {event.reason for event in events if event.type is EventType.CANCEL} == {CancelReason.SOURCE_ENDED}


def test_a_camera_that_fails_cancels_before_its_error_goes_on(pipeline: TouchPipeline) -> None:
    events: list[TouchEvent] = []
    with pytest.raises(SourceError, match="unplugged"):
        play(frames(6, SourceError("unplugged")), pipeline, events.append)
    assert {event.reason for event in events if event.type is EventType.CANCEL} == {CancelReason.SOURCE_STALLED}


def test_ctrl_c_ends_the_run_and_is_told(pipeline: TouchPipeline, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("egotouch_sdk.cli.play.ignore_interrupts", lambda: None)
    events: list[TouchEvent] = []
    run = play(frames(6, KeyboardInterrupt()), pipeline, events.append)
    assert run.interrupted
    assert events[-1].type is EventType.HOVER_EXIT


def test_every_frame_reaches_the_view_with_its_result(pipeline: TouchPipeline) -> None:
    seen: list[tuple[int, int]] = []
    play(frames(4), pipeline, lambda event: None, lambda frame, result: seen.append((frame.index, result.index)))
    assert seen == [(index, index) for index in range(4)]


def test_no_frames_at_all_is_an_empty_run(pipeline: TouchPipeline) -> None:
    run = play(iter(()), pipeline, lambda event: None)
    assert (run.frames, run.last_timestamp_ns) == (0, 0)


def test_pacing_holds_frames_to_their_times(pipeline: TouchPipeline) -> None:
    quick = (Frame(np.zeros((64, 64, 3), np.uint8), index * 50_000_000, index) for index in range(5))
    assert play(quick, pipeline, lambda event: None, paced=True).wall_s >= 0.2
