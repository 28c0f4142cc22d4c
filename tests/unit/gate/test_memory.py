from __future__ import annotations

import pytest

from egotouch_sdk.config import GateConfig
from egotouch_sdk.gate import HostMemory, find_pairs
from egotouch_sdk.joints import Handedness
from tests.support.hands import host_hand, make_hand, palm_centre, pointing_hand

HOLD_NS = 500
HOST = host_hand()
FINGER = pointing_hand(palm_centre(HOST))


@pytest.fixture
def memory() -> HostMemory:
    """A memory that saw an open gate at time 1000."""
    memory = HostMemory(HOLD_NS)
    memory.note(find_pairs([FINGER, HOST], GateConfig()), 1000)
    return memory


def test_a_host_that_vanishes_is_remembered_for_a_while(memory: HostMemory) -> None:
    hands = memory.complete((FINGER,), 1500)
    assert [hand.hand_id for hand in hands] == [1, 2]
    assert hands[1].score == 0.0
    assert memory.complete((FINGER,), 1501) == (FINGER,)


def test_a_remembered_host_does_not_keep_itself_alive(memory: HostMemory) -> None:
    for time in (1100, 1300, 1500):
        memory.note(find_pairs(memory.complete((FINGER,), time), GateConfig()), time)
    assert memory.complete((FINGER,), 1501) == (FINGER,)


def test_nothing_is_added_beside_a_seen_host(memory: HostMemory) -> None:
    assert memory.complete((FINGER, HOST), 1100) == (FINGER, HOST)


def test_nothing_is_added_without_its_touching_hand(memory: HostMemory) -> None:
    other = make_hand(hand_id=9)
    assert memory.complete((other,), 1100) == (other,)
    assert memory.complete((), 1100) == ()


def test_nothing_is_added_beside_another_hand_of_its_side(memory: HostMemory) -> None:
    left = make_hand(Handedness.LEFT, hand_id=9, wrist_px=(100, 500))
    assert memory.complete((FINGER, left), 1100) == (FINGER, left)


def test_a_closed_gate_leaves_no_memory() -> None:
    memory = HostMemory(HOLD_NS)
    memory.note(find_pairs([pointing_hand((3000, 400)), HOST], GateConfig()), 1000)
    assert memory.complete((FINGER,), 1001) == (FINGER,)


def test_reset_forgets(memory: HostMemory) -> None:
    memory.reset()
    assert memory.complete((FINGER,), 1001) == (FINGER,)
