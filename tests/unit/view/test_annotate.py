import numpy as np
import pytest

from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.frame_result import FrameResult
from egotouch_sdk.joints import HandJoint
from egotouch_sdk.observation import GateReason, GateResult, HandObservation
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.view import Annotator
from egotouch_sdk.view.annotate import HEIGHT_PX, VIDEO_HEIGHT_PX, VIDEO_WIDTH_PX, WIDTH_PX
from egotouch_sdk.view.hands import BONES
from egotouch_sdk.view.palette import DOWN, HOST_HAND, HOVER, TOUCHING_HAND, Image
from tests.unit.view.scene import HOST, POINTING, blank_frame, touching_result

NOTHING = GateResult(GateReason.NO_HANDS)
VIDEO = (slice(0, VIDEO_HEIGHT_PX), slice(0, VIDEO_WIDTH_PX))
PLOT = (slice(VIDEO_HEIGHT_PX, HEIGHT_PX), slice(0, VIDEO_WIDTH_PX))
PANEL = (slice(0, HEIGHT_PX), slice(VIDEO_WIDTH_PX, WIDTH_PX))


def draw(*kinds: EventType | None, **options: object) -> Image:
    annotator = Annotator("test")
    for index, kind in enumerate(kinds):
        result = touching_result(index, kind, **options)  # type: ignore[arg-type]
        annotator.add(result)
    return annotator.draw(blank_frame(len(kinds) - 1), result)


def draw_empty(size_px: tuple[int, int] = (1280, 720)) -> Image:
    annotator = Annotator("test")
    result = FrameResult(FrameObservation(0, 0, 640, 480))
    annotator.add(result)
    return annotator.draw(blank_frame(size_px=size_px), result)


def count(part: Image, colour: tuple[int, int, int]) -> int:
    return int((part == colour).all(axis=2).sum())


@pytest.mark.parametrize("size_px", [(1280, 720), (640, 480), (480, 640), (32, 32), (3840, 100)])
def test_the_picture_has_one_size_whatever_the_camera(size_px: tuple[int, int]) -> None:
    assert draw_empty(size_px).shape == (HEIGHT_PX, WIDTH_PX, 3)


def test_hands_are_coloured_by_role() -> None:
    video = draw(EventType.HOVER_ENTER)[VIDEO]
    assert count(video, TOUCHING_HAND) > 100
    assert count(video, HOST_HAND) > 100


def test_bones_lie_where_the_joints_are() -> None:
    video = draw(EventType.HOVER_ENTER)[VIDEO]
    scale = VIDEO_WIDTH_PX / 1280
    a, b = HOST.xy_px(HandJoint.WRIST) * scale, HOST.xy_px(HandJoint.INDEX_FINGER_MCP) * scale
    x, y = np.rint((a + b) / 2).astype(int)
    assert tuple(video[y, x]) == HOST_HAND


def test_the_tip_is_filled_only_while_it_touches() -> None:
    x, y = np.rint(POINTING.landmarks_px[HandJoint.INDEX_FINGER_TIP, :2] * VIDEO_WIDTH_PX / 1280).astype(int)
    assert tuple(draw(EventType.HOVER_ENTER, EventType.DOWN)[y, x]) == DOWN
    assert tuple(draw(EventType.HOVER_ENTER)[y, x]) != DOWN


def test_pressing_harder_draws_a_wider_ring() -> None:
    soft, hard = (count(draw(EventType.DOWN, force_n=force_n)[VIDEO], DOWN) for force_n in (0.2, 3.4))
    assert hard > soft


def test_the_panel_shows_the_patch_and_the_state() -> None:
    hovering, down = draw(EventType.HOVER_ENTER)[PANEL], draw(EventType.DOWN)[PANEL]
    red_in_bgr = (0, 0, 255)
    assert count(hovering, red_in_bgr) > 10_000
    assert count(hovering, HOVER) > 300
    assert count(hovering, DOWN) == 0
    assert count(down, DOWN) > 300


def test_force_is_drawn_over_time_only_while_touching() -> None:
    plots = {kind: draw(*[kind, *[None] * 30])[PLOT] for kind in (EventType.HOVER_ENTER, EventType.DOWN)}
    drawn = {kind: int((plot[30:100] > 60).any(axis=2).sum()) for kind, plot in plots.items()}
    assert count(plots[EventType.HOVER_ENTER], DOWN) == 0
    assert count(plots[EventType.DOWN], DOWN) > 300
    assert drawn[EventType.DOWN] > drawn[EventType.HOVER_ENTER] + 1000


def test_the_true_force_is_drawn_where_it_is_known() -> None:
    plots = []
    for true_force_n in (None, 3.0):
        annotator = Annotator()
        for index in range(30):
            annotator.add(touching_result(index, None), true_force_n)
        plots.append(annotator.draw(blank_frame(29), touching_result(29, None))[PLOT])
    white = [int((plot > 150).all(axis=2).sum()) for plot in plots]
    assert white[1] > white[0] + 100


def test_landmarks_far_outside_the_picture_do_no_harm() -> None:
    landmarks = POINTING.landmarks_px.copy()
    landmarks[:, :2] += 1e6
    far = HandObservation(POINTING.hand_id, POINTING.handedness, 1.0, landmarks, POINTING.world_mm)
    assert draw(EventType.DOWN, touching=far).shape == (HEIGHT_PX, WIDTH_PX, 3)


def test_the_frame_itself_is_left_alone() -> None:
    annotator = Annotator()
    result = touching_result(0, EventType.DOWN)
    annotator.add(result)
    frame = blank_frame()
    annotator.draw(frame, result)
    assert not frame.image.any()


def test_bones_join_all_21_joints_into_one_hand() -> None:
    joined = {HandJoint.WRIST}
    for _ in BONES:
        joined |= {joint for bone in BONES if joined & set(bone) for joint in bone}
    assert joined == set(HandJoint)
