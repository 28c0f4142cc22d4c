from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from egotouch_sdk.config import StateConfig, TouchConfig
from egotouch_sdk.errors import ConfigError, FrameError
from egotouch_sdk.events import GrammarVerifier
from egotouch_sdk.frame import Frame
from egotouch_sdk.joints import Finger
from egotouch_sdk.observation import FingertipPatch, GateReason, TouchEstimate
from egotouch_sdk.pipeline import STAGES, FrameResult, TouchPipeline
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch import TouchModel
from egotouch_sdk.touch_event import CancelReason, EventType
from tests.support.datasets import picture, touching_pair
from tests.support.hands import host_hand, palm_centre, pointing_hand
from tests.support.sources import FRAME_NS, ScriptedHands, grey_frame
from tests.support.study import memory_model

ENTER, HOVER, EXIT = EventType.HOVER_ENTER, EventType.HOVER_MOVE, EventType.HOVER_EXIT
DOWN, MOVE, UP, CANCEL = EventType.DOWN, EventType.MOVE, EventType.UP, EventType.CANCEL
CLICK, LONG_CLICK = EventType.CLICK, EventType.LONG_CLICK
HOST = host_hand()
FINGER = pointing_hand(palm_centre(HOST))


class ScriptedTouch(TouchModel):
    """The shipped model, whose answers are replaced by a script so that the stages around it can be seen."""

    touching = False
    memory_size = 0

    def estimate(self, patches: Sequence[FingertipPatch]) -> tuple[TouchEstimate, ...]:
        probability, force_n = (0.99, 1.0) if self.touching else (0.01, 0.0)
        return tuple(TouchEstimate(patch.hand_id, patch.finger, probability, force_n) for patch in patches)


class Wearer:
    """Two scripted hands in front of a whole pipeline."""

    def __init__(self, config: TouchConfig | None = None) -> None:
        self.hands = ScriptedHands()
        self.touch = ScriptedTouch()
        self.pipeline = TouchPipeline(config, hands=self.hands, touch=self.touch)
        self.verifier = GrammarVerifier()
        self.index = 0
        self.result: FrameResult

    def show(self, *hands: object, touching: bool = False, frames: int = 1) -> list[EventType]:
        """Let the camera see these hands for some frames; gives the types of the events."""
        self.hands.hands, self.touch.touching = hands, touching  # type: ignore[assignment]
        types: list[EventType] = []
        for _ in range(frames):
            self.result = self.pipeline.process(grey_frame(self.index))
            self.index += 1
            self.verifier.feed(self.result.events)
            types += [event.type for event in self.result.events]
        assert self.verifier.violations == []
        return types


@pytest.fixture
def wearer() -> Wearer:
    return Wearer()


def test_a_touch_and_a_lift_come_one_frame_late_through_the_median(wearer: Wearer) -> None:
    assert wearer.show(FINGER, HOST, frames=3) == [ENTER, HOVER, HOVER]
    assert wearer.show(FINGER, HOST, touching=True, frames=3) == [HOVER, DOWN, MOVE]
    assert wearer.result.events[0].force_n == 1.0
    assert wearer.show(FINGER, HOST, frames=3) == [MOVE, UP, CLICK, HOVER]


def test_one_wrong_frame_is_no_touch(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=3)
    assert wearer.show(FINGER, HOST, touching=True) == [HOVER]
    assert wearer.show(FINGER, HOST, frames=2) == [HOVER, HOVER]


def test_the_result_tells_what_each_stage_saw(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, touching=True)
    result = wearer.result
    assert result.hands == (FINGER, HOST)
    assert result.gate.reason is GateReason.OPEN
    assert [patch.finger for patch in result.fingertips] == [Finger.INDEX]
    assert [e.touch_probability for e in result.estimates] == [0.99]
    assert [e.touch_probability for e in result.filtered] == [0.0]
    assert tuple(result.stage_ms) == STAGES
    assert all(ms >= 0 for ms in result.stage_ms.values())
    assert result.total_ms == pytest.approx(sum(result.stage_ms.values()))


def test_events_say_where_the_fingertip_is(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST)
    (event,) = wearer.result.events
    x, y = palm_centre(HOST)
    assert (event.image_x, event.image_y) == pytest.approx(((x + 0.5) / 1280, (y + 0.5) / 720), abs=1e-4)
    assert event.timestamp_ns == wearer.result.timestamp_ns
    assert 33 < event.y_mm < 66
    assert abs(event.x_mm) < 17
    assert event.surface is Surface.PALM


def test_no_hands_no_events(wearer: Wearer) -> None:
    assert wearer.show(frames=3) == []
    assert wearer.result.gate.reason is GateReason.NO_HANDS
    assert wearer.result.fingertips == wearer.result.estimates == ()


def test_a_host_hidden_by_the_finger_is_remembered_for_half_a_second(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=2)
    wearer.show(FINGER, HOST, touching=True, frames=2)
    assert wearer.show(FINGER, touching=True, frames=15) == [MOVE] * 12 + [LONG_CLICK] + [MOVE] * 3
    assert wearer.result.hands == (FINGER,)
    assert wearer.show(FINGER, touching=True, frames=4) == [CANCEL, EXIT]
    assert wearer.result.gate.reason is GateReason.NO_HOST


def test_a_finger_that_disappears_is_cancelled(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=2)
    wearer.show(FINGER, HOST, touching=True, frames=2)
    assert wearer.show(HOST, frames=3) == [CANCEL, EXIT]
    assert wearer.result.events[0].reason is CancelReason.TRACKING_LOST


def test_a_short_loss_of_the_finger_is_bridged(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=2)
    wearer.show(FINGER, HOST, touching=True, frames=2)
    assert wearer.show(HOST, frames=2) == []
    assert wearer.show(FINGER, HOST, touching=True, frames=2) == [MOVE, MOVE]


def test_a_stall_cancels_and_forgets_the_touch(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=2)
    wearer.show(FINGER, HOST, touching=True, frames=3)
    wearer.index += 8
    assert wearer.show(FINGER, HOST, touching=True) == [CANCEL, EXIT, ENTER]
    assert wearer.result.events[0].reason is CancelReason.SOURCE_STALLED
    assert wearer.result.filtered[0].touch_probability == 0.0


def test_finish_cancels_what_is_open_and_makes_ready_for_another_source(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=2)
    wearer.show(FINGER, HOST, touching=True, frames=2)
    events = wearer.pipeline.finish(wearer.index * FRAME_NS)
    assert [event.type for event in events] == [CANCEL, EXIT]
    assert events[0].reason is CancelReason.SOURCE_ENDED
    assert wearer.hands.resets == 1
    assert wearer.pipeline.finish(wearer.index * FRAME_NS) == ()
    assert wearer.pipeline.process(grey_frame(0)).events[0].pointer_id == 2


def test_frames_out_of_order_are_refused_and_change_nothing(wearer: Wearer) -> None:
    wearer.show(FINGER, HOST, frames=3)
    with pytest.raises(FrameError, match="not after"):
        wearer.pipeline.process(grey_frame(1))
    assert wearer.show(FINGER, HOST) == [HOVER]


def test_configured_thresholds_replace_the_models() -> None:
    wearer = Wearer(TouchConfig(state=StateConfig(down_probability=0.995, up_probability=0.9)))
    assert DOWN not in wearer.show(FINGER, HOST, touching=True, frames=5)


def test_a_threshold_that_contradicts_the_models_is_refused() -> None:
    with pytest.raises(ConfigError, match="thresholds"):
        TouchPipeline(TouchConfig(state=StateConfig(down_probability=0.01)), hands=ScriptedHands())


def test_stages_are_timed_with_the_given_clock() -> None:
    ticks = iter(range(0, 100_000_000, 1_000_000))
    pipeline = TouchPipeline(hands=ScriptedHands(), touch=ScriptedTouch(), now_ns=lambda: next(ticks))
    assert pipeline.process(grey_frame(0)).stage_ms == dict.fromkeys(STAGES, 1.0)


def test_the_real_stages_run_together_on_a_picture_without_hands() -> None:
    pipeline = TouchPipeline()
    result = pipeline.process(grey_frame(0))
    assert (result.hands, result.events) == ((), ())
    assert pipeline.finish(FRAME_NS) == ()


class RememberedFinger:
    """A fingertip on a palm in front of a pipeline whose model tells by the force how many of its frames it remembers."""

    def __init__(self, folder: Path, config: TouchConfig | None = None, now_ns: Callable[[], int] = lambda: 0) -> None:
        self.hands = ScriptedHands()
        self.pipeline = TouchPipeline(config, hands=self.hands, touch=TouchModel(memory_model(folder)), now_ns=now_ns)
        self.index = 0

    def film(self, letters: str) -> list[FrameResult]:
        """One frame per letter: `#` looks like a touch, `.` does not, `x` shows no finger."""
        return [self._show(letter) for letter in letters]

    def remembered(self, letters: str) -> list[int]:
        """How many frames of the finger are remembered wherever it is seen."""
        return [round(each.force_n / 0.1) for result in self.film(letters) for each in result.estimates]

    def _show(self, letter: str) -> FrameResult:
        finger, host = touching_pair()
        self.hands.hands = (host,) if letter == "x" else (finger, host)
        self.index += 1
        return self.pipeline.process(Frame(picture(letter), self.index * FRAME_NS, self.index))


def test_a_finger_is_remembered_from_frame_to_frame_and_through_a_short_loss(tmp_path: Path) -> None:
    assert RememberedFinger(tmp_path).remembered("#..xxx.#") == [1, 2, 3, 4, 5]


def test_a_finger_that_is_away_for_longer_than_is_set_is_forgotten(tmp_path: Path) -> None:
    assert RememberedFinger(tmp_path).remembered("#..xxxx.#") == [1, 2, 3, 1, 2]
    assert RememberedFinger(tmp_path, TouchConfig(touch={"memory_ms": 40.0})).remembered("#..x.#") == [1, 2, 3, 1, 2]


def test_a_stall_forgets_the_finger_however_long_it_would_be_remembered(tmp_path: Path) -> None:
    finger = RememberedFinger(tmp_path, TouchConfig(touch={"memory_ms": 10_000.0}))
    finger.film("#..")
    finger.index += 5
    assert finger.remembered(".") == [4]
    finger.index += 8
    assert finger.remembered("..") == [1, 2]


def test_another_source_finds_every_finger_forgotten(tmp_path: Path) -> None:
    finger = RememberedFinger(tmp_path)
    finger.film("#..")
    finger.pipeline.finish((finger.index + 1) * FRAME_NS)
    finger.index += 1
    assert finger.remembered("..") == [1, 2]


def test_a_replay_of_remembered_fingers_gives_the_same_events(tmp_path: Path) -> None:
    letters = "....######..xx..####xxxxx..####....."
    seconds_ns = iter(range(0, 10**15, 10**9))
    live, replay = RememberedFinger(tmp_path), RememberedFinger(tmp_path, now_ns=lambda: next(seconds_ns))
    told = [result.events for result in live.film(letters)]
    assert {DOWN, UP, CANCEL} <= {event.type for events in told for event in events}
    assert [result.events for result in replay.film(letters)] == told
    replay.pipeline.finish(replay.index * FRAME_NS)
    replay.index = 0
    assert [[each.type for each in result.events] for result in replay.film(letters)] == [[each.type for each in events] for events in told]
