"""Exact landmarks are told from guessed ones, and located by plain geometry."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from egotouch_sdk.config import HostConfig
from egotouch_sdk.host_frame.exact import has_exact_landmarks, locate_exact
from egotouch_sdk.joints import Finger, Handedness
from egotouch_sdk.observation import HandObservation, TouchPair
from egotouch_sdk.simulator import SimulatedFinger, SimulatedScene, SimulatedView, observe
from egotouch_sdk.surface import Surface


def pair_of(finger: SimulatedFinger, view: SimulatedView | None = None) -> TouchPair:
    (pair,) = observe(SimulatedScene((finger,), view or SimulatedView()), 0, 0).gate.pairs
    return pair


FINGER = SimulatedFinger(Surface.PALM, 12.0, 50.0, pitch_rad=radians(40), yaw_rad=radians(-25))


def mirrored(hand: HandObservation) -> HandObservation:
    """The hand in a mirror image 1280 px wide."""
    pixels, world = hand.landmarks_px * (-1.0, 1.0, 1.0) + (1280.0, 0.0, 0.0), hand.world_mm * (-1.0, 1.0, 1.0)
    return replace(hand, landmarks_px=pixels, world_mm=world)


def test_rigid_hands_are_exact() -> None:
    assert has_exact_landmarks(pair_of(FINGER))


@pytest.mark.parametrize("role", ["host", "touching"])
def test_landmarks_guessed_twice_are_not_exact(role: str) -> None:
    pair = pair_of(FINGER)
    hand: HandObservation = getattr(pair, role)
    noise = np.random.default_rng(1).normal(0.0, 12.0, hand.world_mm.shape)
    assert not has_exact_landmarks(replace(pair, **{role: replace(hand, world_mm=hand.world_mm + noise)}))


def test_hands_known_in_pixels_only_are_not_exact() -> None:
    pair = pair_of(FINGER)
    flat = replace(pair.host, world_mm=np.zeros((21, 3)))
    assert not has_exact_landmarks(replace(pair, host=flat))


@pytest.mark.parametrize("hand", Handedness)
@pytest.mark.parametrize("surface", Surface)
def test_a_mirror_image_changes_nothing(hand: Handedness, surface: Surface) -> None:
    y_mm = 40.0 if surface in (Surface.PALM, Surface.BACK_OF_HAND) else -40.0
    pair = pair_of(replace(FINGER, surface=surface, y_mm=y_mm, hand=hand))
    reflected = replace(pair, host=mirrored(pair.host), touching=mirrored(pair.touching))
    point, same = locate_exact(pair, Finger.INDEX, HostConfig()), locate_exact(reflected, Finger.INDEX, HostConfig(), mirrored=True)
    assert point is not None
    assert same is not None
    assert point.surface is same.surface is surface
    assert (point.x_mm, point.y_mm, point.pitch_rad, point.yaw_rad) == pytest.approx(
        (same.x_mm, same.y_mm, same.pitch_rad, same.yaw_rad), abs=1e-3
    )


def test_a_longer_palm_stretches_the_place() -> None:
    point = locate_exact(pair_of(FINGER), Finger.INDEX, HostConfig(palm_mm=91.3))
    assert point is not None
    assert (point.x_mm, point.y_mm) == pytest.approx((12.0 * 1.1, 50.0 * 1.1), abs=0.01)


def test_a_host_seen_along_its_palm_has_no_place() -> None:
    pair = pair_of(FINGER)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    host = replace(pair.host, world_mm=pair.host.world_mm @ turn, landmarks_px=pair.host.landmarks_px @ turn)
    assert locate_exact(replace(pair, host=host), Finger.INDEX, HostConfig()) is None


def test_a_hand_on_one_spot_has_no_place() -> None:
    pair = pair_of(FINGER)
    spot = replace(pair.host, world_mm=np.zeros((21, 3)), landmarks_px=np.ones((21, 3)))
    assert locate_exact(replace(pair, host=spot), Finger.INDEX, HostConfig()) is None
