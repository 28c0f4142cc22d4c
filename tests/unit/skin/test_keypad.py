"""Keys read from left to right and from top to bottom as the wearer sees them, checked against what a camera at the eyes sees."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from egotouch_sdk.errors import LayoutError
from egotouch_sdk.joints import Handedness
from egotouch_sdk.skin import Reading, SkinKeypad, reading_axes
from egotouch_sdk.surface import Surface
from tests.support.hands import host_frame_xy, make_hand

EVERY_LIMB = list(product(Surface, Handedness))
HAND, FOREARM = (Surface.PALM, Surface.BACK_OF_HAND), (Surface.INNER_FOREARM, Surface.OUTER_FOREARM)


def seen_places(pad: SkinKeypad, reading: Reading) -> dict[str, tuple[float, float]]:
    """Where the keys are in the picture of a camera at the wearer's eyes, in pixels; the limb is held as `reading` says."""
    inner = pad.surface in (Surface.PALM, Surface.INNER_FOREARM)
    across_body_deg = 0.0 if pad.host is Handedness.LEFT else 180.0
    pointing_deg = 90.0 if reading is Reading.ACROSS else across_body_deg
    hand = make_hand(pad.host, palm_up=inner, pointing_deg=pointing_deg, wrist_px=(0.0, 0.0))
    corners = np.array([(0.0, 0.0), (100.0, 0.0), (0.0, 100.0)])
    frames = np.array([host_frame_xy(hand, (float(x), float(y))) for x, y in corners])
    to_host = np.column_stack([frames[1] - frames[0], frames[2] - frames[0]]) * 83.0 / 100.0  # mm per px; the frame is linear
    return {b.label: tuple(np.linalg.solve(to_host, b.region.centre_mm)) for b in pad.buttons}


@pytest.mark.parametrize(("surface", "host"), EVERY_LIMB)
@pytest.mark.parametrize("reading", [None, *Reading])
def test_rows_read_left_to_right_and_lie_one_above_the_other(surface: Surface, host: Handedness, reading: Reading | None) -> None:
    y_mm = 46.0 if surface in HAND else -80.0
    pad = SkinKeypad(
        name="p", surface=surface, host=host, rows=(("1", "2", "3"), ("4", "5", "6")), x_mm=0, y_mm=y_mm, pitch_mm=15, reading=reading
    )
    held = reading or (Reading.ACROSS if surface in HAND else Reading.ALONG)
    seen = seen_places(pad, held)
    for left, right in ("12", "23", "45", "56"):
        assert seen[left][0] < seen[right][0] - 10
        assert seen[left][1] == pytest.approx(seen[right][1], abs=0.1)
    for upper, lower in ("14", "25", "36"):
        assert seen[upper][1] < seen[lower][1] - 10
        assert seen[upper][0] == pytest.approx(seen[lower][0], abs=0.1)


def test_the_left_palm_has_its_thumb_on_the_left() -> None:
    assert reading_axes(Surface.PALM, Handedness.LEFT, Reading.ACROSS).right == (-1, 0)
    assert reading_axes(Surface.PALM, Handedness.RIGHT, Reading.ACROSS).right == (1, 0)


@pytest.mark.parametrize(("surface", "host"), EVERY_LIMB)
def test_view_and_host_frame_are_two_ways_to_say_the_same(surface: Surface, host: Handedness) -> None:
    for reading in Reading:
        axes = reading_axes(surface, host, reading)
        assert axes.to_host(*axes.to_view(3, -5)) == (3, -5)


@pytest.mark.parametrize(("surface", "host"), EVERY_LIMB)
def test_a_phone_keypad_has_twelve_keys_on_its_own_surface(surface: Surface, host: Handedness) -> None:
    pad = SkinKeypad.phone("pad", surface, host)
    assert sorted(button.label for button in pad.buttons) == sorted("0123456789*#")
    for button in pad.buttons:
        assert (button.region.surface, button.region.host) == (surface, host)
        _, low, _, high = button.region.bounds_mm
        assert (low >= 0) if surface in HAND else (high <= 0)


@pytest.mark.parametrize("surface", Surface)
def test_both_hands_use_the_same_skin(surface: Surface) -> None:
    left, right = (sorted(b.region.centre_mm for b in SkinKeypad.phone("p", surface, host).buttons) for host in Handedness)
    assert left == right


@pytest.mark.parametrize("surface", FOREARM)
def test_on_the_forearm_the_keys_run_along_the_arm(surface: Surface) -> None:
    xs, ys = zip(*(b.region.centre_mm for b in SkinKeypad.phone("p", surface, Handedness.LEFT).buttons), strict=True)
    assert max(ys) - min(ys) > 2 * (max(xs) - min(xs))


@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"pitch_mm": 11.9}, "pitch_mm=11.9"),
        ({"gap_mm": 8.0}, "gap_mm=8.0"),
        ({"gap_mm": -1.0}, "gap_mm=-1.0"),
        ({"rows": ()}, "each key once"),
        ({"rows": (("1", "1"),)}, "each key once"),
        ({"rows": (("1", ""),)}, "each key once"),
        ({"rows": (tuple("12345"),)}, "75 mm across"),
        ({"rows": tuple("123456")}, "90 mm along"),
        ({"y_mm": 20.0}, "across the wrist"),
        ({"x_mm": float("inf")}, "no number"),
        ({"name": ""}, "name"),
    ],
)
def test_what_does_not_fit_is_refused(wrong: dict[str, object], what: str) -> None:
    with pytest.raises(LayoutError, match=what):
        replace(SkinKeypad.phone("pad", Surface.PALM, Handedness.LEFT), **wrong)  # type: ignore[arg-type]
