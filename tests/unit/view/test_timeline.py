from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import Finger
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.view.timeline import STATE_AFTER, Timeline, TipState
from tests.support.events import make_event
from tests.unit.view.scene import INDEX, touching_result


def test_every_event_type_leads_to_a_state() -> None:
    assert set(STATE_AFTER) <= set(EventType)


def test_a_touch_shows_as_hover_down_hover() -> None:
    timeline = Timeline()
    states = []
    for frame, kind in enumerate((EventType.HOVER_ENTER, EventType.DOWN, EventType.MOVE, EventType.UP)):
        timeline.add(touching_result(frame, kind))
        states.append(timeline.tracks[INDEX].state)
    assert states == [TipState.HOVER, TipState.DOWN, TipState.DOWN, TipState.HOVER]
    assert timeline.touches == 1


def test_the_ticker_leaves_out_continuous_events_and_keeps_the_newest() -> None:
    timeline = Timeline()
    for frame in range(60):
        timeline.add(touching_result(frame, EventType.MOVE if frame % 2 else EventType.DOWN))
    assert len(timeline.ticker) == timeline.ticker.maxlen
    assert all(event.type.is_edge for event in timeline.ticker)
    assert timeline.ticker[-1].timestamp_ns == touching_result(58, None).timestamp_ns


def test_samples_older_than_the_window_are_forgotten() -> None:
    timeline = Timeline(window_s=1.0)
    for frame in range(90):
        timeline.add(touching_result(frame, None))
    samples = timeline.tracks[INDEX].samples
    assert 30 <= len(samples) <= 31
    assert samples[0].timestamp_ns >= timeline.now_ns - 10**9


def test_a_fingertip_that_has_gone_is_forgotten_after_the_window() -> None:
    timeline = Timeline(window_s=1.0)
    timeline.add(touching_result(0, EventType.DOWN))
    cancel = make_event(EventType.CANCEL, 10**8)
    timeline.add(FrameResult(FrameObservation(1, 10**8, 640, 480), events=(cancel,)))
    assert timeline.tracks[INDEX].state is TipState.HOVER
    timeline.add(FrameResult(FrameObservation(2, 3 * 10**9, 640, 480)))
    assert timeline.tracks == {}


def test_touching_fingertips_come_first() -> None:
    timeline = Timeline()
    timeline.add(touching_result(0, EventType.DOWN))
    timeline.add(touching_result(1, None, finger=Finger.MIDDLE))
    assert [tip[1] for tip, _ in timeline.newest(2)] == [Finger.INDEX, Finger.MIDDLE]
    assert len(timeline.newest(1)) == 1
