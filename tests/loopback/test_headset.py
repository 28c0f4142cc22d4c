"""A headset pushes its camera's frames over a real socket, and the touches in them reach another client."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Coroutine
from itertools import pairwise
from typing import Any

import cv2
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed

from egotouch_sdk.server import CloseCode
from egotouch_sdk.touch_event import CancelReason, EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.headset import CLOCK_NS, FRAME_NS, Headset, fates, frames_done, frames_until, headset_server, jpegs, local_run
from tests.support.socket_client import SocketClient, running_server

E = EventType
#: What shows the index finger's contacts and nothing else.
CONTACTS = pb.Subscribe(types=[pb.EVENT_TYPE_DOWN], fingers=[pb.FINGER_INDEX])


def run(test: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(test, 120))


@pytest.mark.parametrize("own_hands", [False, True], ids=["frames", "frames_and_hands"])
def test_a_headsets_frames_become_touches_at_another_client_as_in_a_local_run(own_hands: bool) -> None:
    expected, hands = local_run()
    assert [event.type for event in expected].count(E.DOWN) == 1

    async def test() -> None:
        async with headset_server() as server:
            listener, headset = SocketClient(server), Headset(server)
            await listener.join()
            await headset.join()
            await headset.show(hands=hands if own_hands else ())
            await listener.hear(*(event.type for event in expected))
            for heard, local in zip(listener.model.heard, expected, strict=True):
                assert (heard.finger, heard.hand, heard.surface) == (local.finger, local.hand, local.surface)
                assert heard.x_mm == pytest.approx(local.x_mm, abs=1.0) and heard.y_mm == pytest.approx(local.y_mm, abs=1.0)
                assert heard.force_n == pytest.approx(local.force_n, abs=0.05)
            times = {event.timestamp_ns: None for event in listener.model.heard}
            assert all(0.9 * FRAME_NS < late - early < 1.1 * FRAME_NS for early, late in pairwise(times))
            assert fates(server) == {"taken": len(jpegs())}

    run(test())


def test_a_headset_that_vanishes_in_a_touch_cancels_it_for_everybody_and_another_goes_on() -> None:
    async def test() -> None:
        async with headset_server() as server:
            listener, headset, second = SocketClient(server), Headset(server), Headset(server)
            await listener.join(subscribe=CONTACTS)
            await headset.join()
            await second.join()
            await headset.show(last=frames_until(E.DOWN))
            await listener.hear(E.HOVER_ENTER, E.DOWN)
            await headset.cut()
            await listener.hear(E.CANCEL, E.HOVER_EXIT)
            assert listener.model.heard[2].reason is CancelReason.DISCONNECTED
            await second.show(last=frames_until(E.UP))
            await listener.hear(E.HOVER_ENTER, E.DOWN, E.UP)

    run(test())


def test_a_headset_that_falls_silent_in_a_touch_cancels_it() -> None:
    async def test() -> None:
        async with headset_server(stall_ms=4000.0) as server:
            listener, headset = SocketClient(server), Headset(server)
            await listener.join(subscribe=CONTACTS)
            await headset.join()
            await headset.show(last=frames_until(E.DOWN))
            await listener.hear(E.HOVER_ENTER, E.DOWN)
            await listener.hear(E.CANCEL, E.HOVER_EXIT)
            assert listener.model.heard[2].reason is CancelReason.SOURCE_STALLED

    run(test())


def test_only_one_client_is_the_source() -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset, second = Headset(server), Headset(server)
            await headset.join()
            await second.join()
            await headset.show(last=1)
            await second.push(jpegs()[0], CLOCK_NS)
            assert await second.warned() == "another_source"
            assert fates(server) == {"taken": 1, "another_source": 1}

    run(test())


def test_a_burst_leaves_only_the_newest_frame_waiting() -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            for index, jpeg in enumerate(jpegs()):
                await headset.push(jpeg, CLOCK_NS + index * FRAME_NS)
            await headset.catch_up()
            await frames_done(server, fates(server).get("taken", 0))
            found = fates(server)
            while sum(found.values()) < len(jpegs()):
                await asyncio.sleep(0.001)
                found = fates(server)
            assert found["replaced"] > 0 and set(found) == {"taken", "replaced"}

    run(test())


def coded(width: int, height: int, suffix: str = ".jpg") -> bytes:
    return bytes(cv2.imencode(suffix, np.zeros((height, width, 3), np.uint8))[1].tobytes())


def claiming(width: int, height: int) -> bytes:
    """A small JPEG whose header claims another size."""
    data = bytearray(coded(64, 64))
    at = data.index(b"\xff\xc0")
    data[at + 5 : at + 9] = height.to_bytes(2) + width.to_bytes(2)
    return bytes(data)


BAD_FRAMES = {
    "nothing": b"",
    "no_picture": b"hello",
    "png": coded(64, 64, ".png"),
    "too_small": coded(16, 64),
    "too_large": coded(3841, 2161),
    "decode_bomb": claiming(65535, 65535),
    "header_only": coded(64, 64)[:20],
}


@pytest.mark.parametrize("jpeg", BAD_FRAMES.values(), ids=BAD_FRAMES)
def test_a_bad_frame_is_a_warning_and_the_next_good_one_counts(jpeg: bytes) -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.push(jpeg, CLOCK_NS - FRAME_NS)
            assert await headset.warned() == "bad_frame"
            await headset.show(last=1)
            assert fates(server) == {"taken": 1, "bad_frame": 1}

    run(test())


def test_a_frame_whose_end_is_missing_is_a_warning_with_the_next_one_or_a_whole_picture() -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.push(jpegs()[0][:700], CLOCK_NS - FRAME_NS)
            while not fates(server):
                await asyncio.sleep(0.001)
            assert fates(server) == {"damaged": 1}
            await headset.show(last=1)
            assert await headset.warned() == "bad_frame"
            assert fates(server) == {"taken": 1, "damaged": 1}

    run(test())


@pytest.mark.parametrize(
    ("time_ns", "code"),
    [
        (CLOCK_NS, "time_not_rising"),
        (CLOCK_NS - 1, "time_not_rising"),
        (-1, "time_not_rising"),
        (CLOCK_NS + 3_600 * 10**9, "time_jump"),
        (2**63 - 1, "time_jump"),
    ],
)
def test_a_time_that_makes_no_sense_is_a_warning(time_ns: int, code: str) -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.show(last=1)
            await headset.push(jpegs()[1], time_ns)
            assert await headset.warned() == code
            await headset.show(first=1, last=2)
            assert fates(server) == {"taken": 2, code: 1}

    run(test())


def test_a_frame_without_its_hands_is_dropped_and_said() -> None:
    async def test() -> None:
        _, hands = local_run()
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.show(last=1, hands=hands)
            for index in (1, 2):
                await headset.push(jpegs()[index], CLOCK_NS + index * FRAME_NS)
            assert await headset.warned() == "hands_missing"
            await headset.send(pb.ClientMessage(hands=hands[2]))
            await frames_done(server, 2)
            assert fates(server) == {"taken": 2, "hands_missing": 1}

    run(test())


def wrong_hands() -> dict[str, pb.ClientHands]:
    good = local_run()[1][0]
    wrong = {name: pb.ClientHands.FromString(good.SerializeToString()) for name in ("few_joints", "not_a_number", "twice", "no_side")}
    del wrong["few_joints"].hands[0].world_mm[3:]
    wrong["not_a_number"].hands[0].landmarks_px[0] = float("nan")
    wrong["twice"].hands.append(wrong["twice"].hands[0])
    wrong["no_side"].hands[0].handedness = pb.HANDEDNESS_UNSPECIFIED
    return wrong


@pytest.mark.parametrize("name", ["few_joints", "not_a_number", "twice", "no_side"])
def test_hands_that_make_no_sense_close(name: str) -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.send(pb.ClientMessage(hands=wrong_hands()[name]))
            assert (await headset.expect_closed())[0] == CloseCode.MALFORMED

    run(test())


def test_a_flood_closes() -> None:
    async def test() -> None:
        async with headset_server() as server:
            headset = Headset(server)
            await headset.join()
            with contextlib.suppress(ConnectionClosed):
                for _ in range(5000):
                    await headset.push(b"", CLOCK_NS)
            assert (await headset.expect_closed())[0] == CloseCode.TOO_MANY_COMMANDS

    run(test())


def test_frames_for_another_source_are_a_warning() -> None:
    async def test() -> None:
        async with running_server() as server:
            headset = Headset(server)
            await headset.join()
            await headset.push(jpegs()[0], CLOCK_NS)
            assert await headset.warned() == "not_a_source"

    run(test())
