"""What skin views are told, in the finger's language. Button a lies at x -10..10, y 10..30 of the left palm; b touches it above."""

from __future__ import annotations

import pytest

from egotouch_sdk.errors import GrammarError, LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import KeyPress, Region, SkinButton, SkinKeypad, SkinSlider, SkinView, SkinViewGroup, SliderChange
from egotouch_sdk.surface import Surface
from egotouch_sdk.touch_event import EventType, TouchEvent
from tests.support.skin import SkinFinger, ViewLog

A = SkinButton(name="a", region=Region.rectangle(Surface.PALM, 0, 20, 20, 20))
B = SkinButton(name="b", region=Region.rectangle(Surface.PALM, 0, 40, 20, 20))


@pytest.fixture
def group() -> SkinViewGroup:
    return SkinViewGroup([A, B])


@pytest.fixture
def log(group: SkinViewGroup) -> ViewLog:
    return ViewLog(group)


@pytest.fixture
def finger(group: SkinViewGroup) -> SkinFinger:
    return SkinFinger(group)


def test_a_tap_clicks(finger: SkinFinger, log: ViewLog) -> None:
    finger.hover(0, 20)
    finger.tap(0, 20)
    log.expect("a.onHoverEnter", "a.onHoverExit", "a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_the_click_gets_the_event_of_the_lift(group: SkinViewGroup, finger: SkinFinger) -> None:
    clicks: list[TouchEvent] = []
    group.view("a").onClick(clicks.append)
    finger.touch(0, 20)
    up = finger.lift()
    assert clicks == [up]


def test_a_finger_that_slides_within_the_button_still_clicks(finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(-8, 12)
    finger.slide(8, 28)
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_within_the_slop_is_still_inside(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.slide(14.9, 20)
    assert group.view("a").is_pressed
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_beyond_the_slop_it_is_released_and_does_not_click(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.slide(15.1, 20)
    assert not group.view("a").is_pressed
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onTouchUp")
    log.expect_nothing_else()


def test_a_finger_that_returns_presses_again_and_clicks(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.slide(40, 20)
    finger.slide(0, 20)
    assert group.view("a").is_pressed
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onTouchMove", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_captured_view_gets_the_whole_contact_even_above_another(finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.slide(0, 45)
    finger.derive(EventType.DRAG_START)
    finger.derive(EventType.DRAG)
    finger.derive(EventType.DRAG_END)
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onDragStart", "a.onDrag", "a.onDragEnd", "a.onTouchUp")
    log.expect_nothing_else()


def test_a_lost_touch_never_clicks(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.cancel()
    finger.leave()
    assert not group.view("a").is_pressed
    log.expect("a.onTouchDown", "a.onTouchCancel")
    log.expect_nothing_else()


def test_a_contact_that_began_on_bare_skin_concerns_no_view(finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(50, 20)
    finger.slide(0, 20)
    finger.rest()
    finger.derive(EventType.FORCE_ENTER)
    finger.derive(EventType.FORCE_EXIT)
    finger.lift()
    log.expect_nothing_else()


def test_hovering_highlights_one_view_after_the_other(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.hover(0, 20)
    assert group.view("a").is_hovered
    finger.hover(0, 21)
    finger.hover(0, 40)
    assert not group.view("a").is_hovered and group.view("b").is_hovered
    finger.hover(40, 40)
    assert not group.view("b").is_hovered
    log.expect("a.onHoverEnter", "a.onHoverMove", "a.onHoverExit", "b.onHoverEnter", "b.onHoverExit")
    log.expect_nothing_else()


def test_a_finger_that_leaves_ends_the_hover(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.hover(0, 20)
    finger.leave()
    log.expect("a.onHoverEnter", "a.onHoverExit")
    log.expect_nothing_else()
    assert group.snapshot().fingers == ()


def test_noise_at_the_edge_between_two_views_does_not_flicker(finger: SkinFinger, log: ViewLog) -> None:
    for y_mm in (29, 31, 29, 32, 31):
        finger.hover(0, y_mm)
    log.expect("a.onHoverEnter", *["a.onHoverMove"] * 4)
    finger.hover(0, 33)
    finger.hover(0, 29)
    log.expect("a.onHoverExit", "b.onHoverEnter", "b.onHoverMove")
    log.expect_nothing_else()


def test_a_press_goes_to_the_view_that_is_highlighted(finger: SkinFinger, log: ViewLog) -> None:
    finger.hover(0, 29)
    finger.tap(0, 31)
    log.expect("a.onHoverEnter", "a.onHoverExit", "a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_without_a_highlight_the_slop_is_not_part_of_the_view(finger: SkinFinger, log: ViewLog) -> None:
    finger.tap(0, 9)
    log.expect_nothing_else()


def test_a_hovering_finger_may_press_bare_skin(finger: SkinFinger, log: ViewLog) -> None:
    finger.hover(0, 20)
    finger.tap(40, 20)
    log.expect("a.onHoverEnter", "a.onHoverExit")
    log.expect_nothing_else()


def test_the_topmost_view_is_hit() -> None:
    group = SkinViewGroup([A, SkinButton(name="top", region=Region.circle(Surface.PALM, 0, 20, 5))])
    finger, log = SkinFinger(group), ViewLog(group)
    finger.hover(8, 20)
    finger.hover(0, 20)
    finger.tap(0, 20)
    finger.tap(8, 12)
    log.expect("a.onHoverEnter", "a.onHoverExit", "top.onHoverEnter", "top.onHoverExit")
    log.expect("top.onTouchDown", "top.onTouchUp", "top.onClick", "a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_long_click_is_told_and_a_click_follows(finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    assert finger.rest() is False
    finger.lift()
    log.expect("a.onTouchDown", "a.onLongClick", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_consumed_long_click_keeps_its_own_contact_from_clicking(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    group.view("a").onLongClick(lambda event: True)
    finger.touch(0, 20)
    assert finger.rest() is True
    finger.lift()
    log.expect("a.onTouchDown", "a.onLongClick", "a.onTouchUp")
    finger.tap(0, 20)
    log.expect("a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_only_true_consumes(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    group.view("a").onLongClick(lambda event: 1)  # type: ignore[arg-type, return-value]
    finger.touch(0, 20)
    assert finger.rest() is False
    finger.lift()
    log.expect("a.onTouchDown", "a.onLongClick", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_long_click_outside_is_not_told(finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.slide(40, 20)
    assert finger.rest() is False
    log.expect("a.onTouchDown", "a.onTouchMove")
    log.expect_nothing_else()


def test_force_belongs_to_the_pressed_view(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20, force_n=0.5)
    assert group.view("a").force_n == 0.5
    finger.slide(0, 20, force_n=2.0)
    finger.derive(EventType.FORCE_ENTER, force_n=2.0)
    assert (group.view("a").force_n, group.view("b").force_n) == (2.0, 0.0)
    finger.derive(EventType.FORCE_EXIT, force_n=0.0)
    finger.lift()
    assert group.view("a").force_n == 0.0
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onForce", "a.onForce", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_two_fingers_press_two_buttons(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    second = SkinFinger(group, pointer_id=2)
    finger.touch(0, 20)
    second.touch(0, 40)
    assert group.view("a").is_pressed and group.view("b").is_pressed
    finger.lift()
    second.lift()
    log.expect("a.onTouchDown", "b.onTouchDown", "a.onTouchUp", "a.onClick", "b.onTouchUp", "b.onClick")
    log.expect_nothing_else()


def test_a_second_finger_on_a_held_view_is_ignored_until_it_is_lifted(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    second = SkinFinger(group, pointer_id=2)
    finger.touch(0, 20)
    second.touch(0, 22)
    finger.lift()
    second.slide(0, 21)
    second.lift()
    log.expect("a.onTouchDown", "a.onTouchUp", "a.onClick")
    second.tap(0, 21)
    log.expect("a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_second_finger_does_not_fall_through_to_the_view_below() -> None:
    group = SkinViewGroup([A, SkinButton(name="top", region=Region.circle(Surface.PALM, 0, 20, 5))])
    first, second, log = SkinFinger(group), SkinFinger(group, pointer_id=2), ViewLog(group)
    first.touch(0, 20)
    second.tap(1, 20)
    log.expect("top.onTouchDown")
    log.expect_nothing_else()


def test_another_surface_is_another_place(finger: SkinFinger, log: ViewLog) -> None:
    finger.surface = Surface.BACK_OF_HAND
    finger.hover(0, 20)
    finger.tap(0, 20)
    log.expect_nothing_else()


def test_sliding_to_the_other_side_of_the_limb_releases(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    finger.surface = Surface.BACK_OF_HAND
    finger.slide(0, 20)
    assert not group.view("a").is_pressed
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchMove", "a.onTouchUp")
    log.expect_nothing_else()


def test_the_wrist_is_no_border_for_a_pressing_finger() -> None:
    group = SkinViewGroup([SkinButton(name="wrist", region=Region.rectangle(Surface.PALM, 0, 8, 20, 16))])
    finger, log = SkinFinger(group), ViewLog(group)
    finger.touch(0, 1)
    finger.surface = Surface.INNER_FOREARM
    finger.slide(0, -2)
    assert group.view("wrist").is_pressed
    finger.lift()
    log.expect("wrist.onTouchDown", "wrist.onTouchMove", "wrist.onTouchUp", "wrist.onClick")
    log.expect_nothing_else()


def test_a_region_can_belong_to_one_hand() -> None:
    region = Region.rectangle(Surface.PALM, 0, 20, 20, 20, host=Handedness.LEFT)
    group = SkinViewGroup([SkinButton(name="left", region=region)])
    log = ViewLog(group)
    SkinFinger(group, 1, hand=Handedness.LEFT).tap(0, 20)
    log.expect_nothing_else()
    SkinFinger(group, 2, hand=Handedness.RIGHT).tap(0, 20)
    log.expect("left.onTouchDown", "left.onTouchUp", "left.onClick")
    log.expect_nothing_else()


def test_listeners_can_be_filtered_and_removed(group: SkinViewGroup, finger: SkinFinger) -> None:
    heard: list[str] = []

    @group.view("a").onClick(finger="index")
    def index(event: TouchEvent) -> None:
        heard.append("index")

    group.view("a").onClick(lambda event: heard.append("thumb"), finger="thumb")
    finger.tap(0, 20)
    index.remove()
    finger.tap(0, 20)
    assert heard == ["index"]


def test_a_throwing_listener_harms_no_other_and_no_state(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    def broken(event: TouchEvent) -> None:
        raise RuntimeError("broken")

    group.view("a").onTouchDown(broken)
    group.view("a").onTouchUp(broken)
    group.view("a").onClick(broken)
    with pytest.raises(RuntimeError, match="broken"):
        finger.touch(0, 20)
    assert group.view("a").is_pressed
    with pytest.raises(ExceptionGroup) as caught:
        finger.lift()
    assert len(caught.value.exceptions) == 2
    log.expect("a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_group_that_joins_during_a_touch_waits_for_the_next(finger: SkinFinger, log: ViewLog) -> None:
    stranger = SkinFinger(SkinViewGroup([]), pointer_id=1)
    stranger.touch(0, 20)
    stranger.group = finger.group
    stranger.slide(0, 20)
    stranger.lift()
    log.expect_nothing_else()


def test_an_event_that_cannot_follow_is_refused_and_changes_nothing(group: SkinViewGroup, finger: SkinFinger, log: ViewLog) -> None:
    finger.touch(0, 20)
    with pytest.raises(GrammarError):
        finger.hover(0, 20)
    assert group.view("a").is_pressed
    finger.lift()
    log.expect("a.onTouchDown", "a.onTouchUp", "a.onClick")
    log.expect_nothing_else()


def test_a_snapshot_does_not_change(group: SkinViewGroup, finger: SkinFinger) -> None:
    before = group.snapshot()
    finger.touch(0, 20, force_n=1.5)
    during = group.snapshot()
    finger.lift()
    assert [view.is_pressed for view in before.views] == [False, False]
    assert [(view.name, view.is_pressed, view.force_n) for view in during.views] == [("a", True, 1.5), ("b", False, 0.0)]
    assert [(f.x_mm, f.y_mm, f.force_n, f.is_touching, f.host) for f in during.fingers] == [(0, 20, 1.5, True, Handedness.LEFT)]
    assert group.snapshot().fingers[0].is_touching is False


def test_views_sliders_and_keypads_are_found_by_name(group: SkinViewGroup) -> None:
    assert group.view("a").view is A
    with pytest.raises(LayoutError, match=r"no view 'aa'\. Did you mean a\?"):
        group.view("aa")
    with pytest.raises(LayoutError, match="no slider 'a'"):
        group.slider("a")
    with pytest.raises(LayoutError, match="no keypad 'a'"):
        group.keypad("a")


class TestSlider:
    """A slider along y 20..70 of the palm, x -10..10."""

    SLIDER = SkinSlider(
        name="volume", region=Region.rectangle(Surface.PALM, 0, 45, 20, 60), start_mm=(0, 20), end_mm=(0, 70), step=0.1, value=0.5
    )

    @pytest.fixture
    def group(self) -> SkinViewGroup:
        return SkinViewGroup([self.SLIDER])

    @pytest.fixture
    def values(self, group: SkinViewGroup) -> list[float]:
        changes: list[float] = []

        @group.slider("volume").onChange
        def note(change: SliderChange) -> None:
            assert change.value == group.slider("volume").value
            changes.append(change.value)

        return changes

    def test_the_value_follows_the_finger_in_steps_and_stays_when_it_lifts(
        self, group: SkinViewGroup, finger: SkinFinger, values: list[float]
    ) -> None:
        assert group.slider("volume").value == 0.5
        finger.touch(0, 31)
        finger.slide(5, 32)
        finger.slide(5, 40.5)
        finger.lift()
        assert values == [0.2, 0.4]
        assert group.slider("volume").value == 0.4

    def test_beyond_its_ends_and_beside_it_the_finger_still_holds_it(self, finger: SkinFinger, values: list[float]) -> None:
        finger.touch(0, 45)
        finger.slide(60, 300)
        finger.slide(60, -300)
        finger.lift()
        assert values == [1.0, 0.0]

    def test_hovering_does_not_move_it(self, finger: SkinFinger, values: list[float]) -> None:
        finger.hover(0, 60)
        finger.hover(0, 30)
        assert values == []

    def test_on_the_other_side_of_the_limb_it_waits(self, finger: SkinFinger, values: list[float]) -> None:
        finger.touch(0, 60)
        finger.surface = Surface.BACK_OF_HAND
        finger.slide(0, 30)
        finger.surface = Surface.PALM
        finger.slide(0, 40)
        assert values == [0.8, 0.4]

    def test_a_lost_touch_keeps_the_value(self, group: SkinViewGroup, finger: SkinFinger, values: list[float]) -> None:
        finger.touch(0, 60)
        finger.cancel()
        assert values == [0.8]
        assert group.slider("volume").value == 0.8

    @pytest.mark.parametrize(
        "wrong", [{"step": 0.3}, {"step": -1}, {"value": 2}, {"end_mm": (0, 21)}, {"end_mm": (0, float("nan"))}, {"slop_mm": -1}]
    )
    def test_wrong_sliders_are_refused(self, wrong: dict[str, float]) -> None:
        right = {"name": "s", "region": self.SLIDER.region, "start_mm": (0, 20), "end_mm": (0, 70)}
        SkinSlider(**right)  # type: ignore[arg-type]
        with pytest.raises(LayoutError):
            SkinSlider(**{**right, **wrong})  # type: ignore[arg-type]


class TestKeypad:
    PAD = SkinKeypad.phone("pad", Surface.PALM, Handedness.LEFT)

    def test_keys_are_clicked_and_long_clicked(self) -> None:
        group = SkinViewGroup([self.PAD])
        finger, heard = SkinFinger(group), []
        pad = group.keypad("pad")
        pad.onKey(lambda press: heard.append(press.key))

        @pad.onLongKey
        def long(press: KeyPress) -> bool:
            heard.append(f"long {press.key}")
            return press.key == "0"

        places = {button.label: button.region.centre_mm for button in self.PAD.buttons}
        for key in "12*":
            finger.tap(*places[key])
        for key in "09":
            finger.touch(*places[key])
            finger.rest()
            finger.lift()
        assert heard == ["1", "2", "*", "long 0", "long 9", "9"]

    def test_a_key_can_be_found_by_itself(self) -> None:
        group = SkinViewGroup([self.PAD])
        assert group.view("pad/5") is group.keypad("pad").keys["5"]

    def test_names_are_unique(self) -> None:
        with pytest.raises(LayoutError, match="pad/5 is used twice"):
            SkinViewGroup([self.PAD, SkinView(name="pad/5", region=A.region)])
