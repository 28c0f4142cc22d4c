"""The tracker's decisions, with networks that answer from a script; the real networks run in test_parity.py."""

import numpy as np
import pytest

from egotouch_sdk.errors import ConfigError, FrameError, ModelError
from egotouch_sdk.frame import Frame
from egotouch_sdk.hands import palm_detector
from egotouch_sdk.hands import tracker as tracker_module
from egotouch_sdk.hands.association import PALM_JOINTS
from egotouch_sdk.hands.base import HandSource
from egotouch_sdk.hands.boxes import bounding_box
from egotouch_sdk.hands.landmarker import LocatedHand
from egotouch_sdk.hands.palm_detector import PalmDetection
from egotouch_sdk.hands.roi import roi_from_landmarks
from egotouch_sdk.hands.tracker import HandTracker
from egotouch_sdk.model_store import hand_model
from tests.support.located import flat_hand

STEP_NS = 33_000_000
IMAGE = np.zeros((480, 640, 3), np.uint8)


class Scene:
    """What is in front of the camera: {name: (landmarks, P(right))}, seen by scripted networks."""

    def __init__(self):
        self.hands = {}
        self.palm_calls = 0

    def detect(self, image):
        self.palm_calls += 1
        palms = [landmarks[PALM_JOINTS, :2].astype(float) for landmarks, _ in self.hands.values()]
        return [PalmDetection(bounding_box(p), p, 0.9) for p in palms]

    def locate(self, image, roi):
        near = [
            (np.hypot(at.x_px - roi.x_px, at.y_px - roi.y_px), lm, right)
            for lm, right in self.hands.values()
            for at in [roi_from_landmarks(lm)]
        ]
        distance, landmarks, right = min(near, key=lambda item: item[0], default=(np.inf, flat_hand(), 0.5))
        return LocatedHand(landmarks, np.zeros((21, 3), np.float32), 0.95 if distance < roi.size_px / 3 else 0.05, right)


@pytest.fixture
def scene(monkeypatch):
    scene = Scene()
    monkeypatch.setattr(tracker_module, "PalmDetector", lambda *_: scene)
    monkeypatch.setattr(tracker_module, "Landmarker", lambda *_: scene)
    return scene


class Player:
    """Feeds the tracker one frame after another."""

    def __init__(self, **settings):
        self.tracker = HandTracker(**settings)
        self.index = 0

    def step(self, image=IMAGE):
        self.index += 1
        return self.tracker.track(Frame(image, self.index * STEP_NS, self.index))


LEFT, RIGHT = (flat_hand(200, 400), 0.02), (flat_hand(460, 400), 0.98)


def sides(hands):
    return [(hand.hand_id, str(hand.handedness)) for hand in hands]


def test_it_is_a_hand_source(scene):
    assert isinstance(HandTracker(), HandSource)


@pytest.mark.parametrize("threads", [1, 2])
def test_two_hands_get_their_sides(scene, threads):
    scene.hands = {"a": RIGHT, "b": LEFT}
    hands = Player(threads=threads).step()
    assert sorted(str(h.handedness) for h in hands) == ["left", "right"]
    right = next(h for h in hands if h.handedness == "right")
    assert np.array_equal(right.landmarks_px, RIGHT[0])
    assert right.score == pytest.approx(0.95)


def test_a_mirrored_image_swaps_the_sides(scene):
    scene.hands = {"a": RIGHT}
    assert [str(h.handedness) for h in Player(mirrored=True).step()] == ["left"]


def test_palms_are_searched_only_while_a_hand_is_missing(scene):
    player = Player()
    player.step()
    player.step()
    assert scene.palm_calls == 2
    scene.hands = {"a": RIGHT, "b": LEFT}
    player.step()
    for _ in range(5):
        player.step()
    assert scene.palm_calls == 3


def test_palm_every_skips_frames_only_while_a_hand_is_tracked(scene):
    player = Player(palm_every=4)
    for _ in range(3):
        player.step()
    assert scene.palm_calls == 3
    scene.hands = {"a": RIGHT}
    for _ in range(9):
        player.step()
    assert scene.palm_calls == 3 + 1 + 2


def test_one_hand_only_when_asked(scene):
    scene.hands = {"a": RIGHT, "b": LEFT}
    assert len(Player(max_hands=1).step()) == 1


def test_a_hand_that_leaves_and_returns_keeps_its_number(scene):
    player = Player()
    scene.hands = {"a": RIGHT, "b": LEFT}
    before = sides(player.step())
    scene.hands = {}
    assert player.step() == ()
    scene.hands = {"b": LEFT}
    assert set(sides(player.step())) <= set(before)
    scene.hands = {"a": RIGHT, "b": LEFT}
    assert sides(player.step()) == before


def test_a_hand_over_more_than_half_of_the_other_is_kept(scene):
    """MediaPipe's rule would drop one: the squares around these hands overlap by about 80 %."""
    player = Player()
    scene.hands = {"a": RIGHT, "b": LEFT}
    before = sides(player.step())
    for x in range(440, 220, -10):
        scene.hands = {"a": (flat_hand(x, 400), 0.98), "b": LEFT}
        assert sides(player.step()) == before


def test_two_findings_on_one_hand_are_one(scene):
    player = Player()
    scene.hands = {"a": (flat_hand(390, 400), 0.98), "b": (flat_hand(270, 400), 0.02)}
    assert len(player.step()) == 2
    scene.hands = {"a": (flat_hand(330, 400), 0.98)}  # both regions now see the one hand between them
    (hand,) = (h for h in player.step() if h.score >= 0.5)
    assert hand.landmarks_px[0, 0] == 330


def test_a_covered_hand_is_carried_for_four_frames_and_found_again(scene):
    player = Player()
    scene.hands = {"a": (flat_hand(260, 400), 0.98), "b": LEFT}
    for _ in range(4):
        before = sides(player.step())
    scene.hands = {"b": LEFT}
    counts = []
    for _ in range(7):
        hands = player.step()
        counts.append(len(hands))
        assert all((hand.score < 0.5) == (hand.handedness == "right") for hand in hands)
    assert counts == [2, 2, 2, 2, 1, 1, 1]
    scene.hands = {"a": (flat_hand(260, 400), 0.98), "b": LEFT}
    assert sides(player.step()) == before


def test_numbers_stay_distinct_when_both_hands_are_lost_under_a_third(scene):
    player = Player()
    scene.hands = {"a": (flat_hand(300, 400), 0.98), "b": (flat_hand(360, 400), 0.02)}
    for _ in range(5):
        player.step()
    scene.hands = {"c": (flat_hand(330, 250, 60), 0.98)}
    for _ in range(6):
        hands = player.step()
        assert len({hand.hand_id for hand in hands}) == len(hands)
        assert len({hand.handedness for hand in hands}) == len(hands)


def test_a_speck_is_not_a_hand(scene):
    player = Player()
    scene.hands = {"a": RIGHT}
    assert len(player.step()) == 1
    scene.hands = {"a": (flat_hand(460, 330, 0.5), 0.98)}
    assert player.step() == ()


def test_a_hand_that_leaves_alone_is_gone_at_once(scene):
    player = Player()
    scene.hands = {"a": RIGHT}
    for _ in range(5):
        player.step()
    scene.hands = {}
    assert player.step() == ()


def test_time_must_rise_until_reset(scene):
    tracker = HandTracker()
    tracker.track(Frame(IMAGE, 100, 0))
    for time_ns in (100, 99):
        with pytest.raises(FrameError, match="not after 100"):
            tracker.track(Frame(IMAGE, time_ns, 1))
    tracker.reset()
    tracker.track(Frame(IMAGE, 0, 0))


def test_another_frame_size_starts_afresh(scene):
    player = Player()
    scene.hands = {"a": RIGHT, "b": LEFT}
    player.step()
    scene.hands = {}
    player.step(np.zeros((240, 320, 3), np.uint8))
    assert scene.palm_calls == 2
    with pytest.raises(FrameError):
        player.tracker.track(Frame(np.zeros((120, 160, 3), np.uint8), 1, 9))


@pytest.mark.parametrize(
    "settings", [{"max_hands": 3}, {"threads": 0}, {"palm_every": 0}, {"coast_ms": -1}, {"min_presence": 1.0}, {"min_palm_score": 0.0}]
)
def test_wrong_settings_are_refused(settings):
    with pytest.raises(ConfigError):
        HandTracker(**settings)


def test_an_unknown_model_is_refused():
    with pytest.raises(ConfigError, match=r"'huge'.*int8, full, lite"):
        HandTracker(model="huge")


def test_a_model_that_was_not_built_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(palm_detector, "hand_model", lambda name: hand_model(name, tmp_path))
    with pytest.raises(ModelError, match=r"manifest\.json is missing.*pip install"):
        HandTracker()


@pytest.mark.parametrize("size", [(32, 32), (32, 1500), (480, 640)])
@pytest.mark.parametrize("threads", [1, 2])
def test_real_networks_take_any_image(size, threads):
    rng, tracker = np.random.default_rng(0), HandTracker(threads=threads, min_palm_score=0.02, min_presence=0.0)
    images = [rng.integers(0, 256, (*size, 3), dtype=np.uint8), np.zeros((*size, 3), np.uint8), np.full((*size, 3), 255, np.uint8)]
    for index, image in enumerate(images * 2):
        for hand in tracker.track(Frame(image, index, index)):
            assert np.isfinite(hand.landmarks_px).all()
