"""The camera's picture leaves the server only with --debug-view, only for those who may, and only when somebody looks."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

import cv2
import numpy as np
import pytest

from egotouch_sdk.frame import Frame
from egotouch_sdk.server import EventServer
from egotouch_sdk.server.debug_video import DebugVideo
from tests.support.socket_client import running_server

TOKEN = "0123456789abcdef" * 2


def run(test: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(test, 120))


async def ask(server: EventServer, *headers: str) -> tuple[int, bytes]:
    """Status and body of /debug.jpg."""
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
    lines = ["GET /debug.jpg?at=1 HTTP/1.1", f"Host: 127.0.0.1:{server.port}", *headers]
    writer.write("\r\n".join((*lines, "", "")).encode())
    answer = await reader.read()
    writer.close()
    await writer.wait_closed()
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]), body


def picture(width_px: int, height_px: int, blue: int = 200) -> Frame:
    return Frame(np.full((height_px, width_px, 3), (blue, 0, 0), np.uint8), 0, 0)


def size_of(jpeg: bytes) -> tuple[int, int]:
    height_px, width_px, _ = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR).shape
    return width_px, height_px


def test_there_is_no_video_without_a_debug_view() -> None:
    async def test() -> None:
        async with running_server() as server:
            assert (await ask(server))[0] == 404

    run(test())


def test_the_newest_picture_comes_once_somebody_looks() -> None:
    async def test() -> None:
        video = DebugVideo()
        async with running_server(video=video) as server:
            video.show(picture(1280, 720))
            assert await ask(server) == (204, b"")
            video.show(picture(1280, 720))
            status, jpeg = await ask(server)
            assert (status, size_of(jpeg)) == (200, (640, 360))

    run(test())


def test_video_needs_the_token_where_clients_do() -> None:
    async def test() -> None:
        video = DebugVideo()
        video.newest()
        video.show(picture(64, 48))
        async with running_server(video=video, token=TOKEN) as server:
            assert (await ask(server))[0] == 401
            assert (await ask(server, f"Authorization: Bearer {TOKEN[::-1]}"))[0] == 401
            assert (await ask(server, f"Authorization: Bearer {TOKEN}"))[0] == 200

    run(test())


def test_only_what_is_looked_at_is_coded(monkeypatch: pytest.MonkeyPatch) -> None:
    coded: list[int] = []
    encode = cv2.imencode
    monkeypatch.setattr(cv2, "imencode", lambda *arguments: coded.append(1) or encode(*arguments))
    video = DebugVideo()
    for _ in range(3):
        video.show(picture(64, 48))
    assert coded == []
    assert video.newest() is None
    video.show("an observation has no picture")
    for _ in range(3):
        video.show(picture(64, 48))
    assert len(coded) == 1
    assert size_of(video.newest() or b"") == (64, 48)
