"""Events republished to a real NATS server, which comes and goes."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Coroutine
from contextlib import asynccontextmanager
from typing import Any

import pytest

from egotouch_sdk.server import EventServer, Limits
from egotouch_sdk.server.limits import SECOND_NS
from egotouch_sdk.server.nats_publisher import CONFIRM_PATIENCE_S, NatsAddress, NatsPublisher
from egotouch_sdk.server.publication import Publication
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire import event_from_proto, from_json
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.nats import NatsServer, listening, nats_server, needs_nats
from tests.support.socket_client import PATIENCE_S, PATIENT, SocketClient, SocketFinger, running_server

E = EventType
pytestmark = needs_nats


def run(test: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(test, 120))


@asynccontextmanager
async def publishing(
    address: NatsAddress, session: str = "lab-1", patience_s: int = CONFIRM_PATIENCE_S, **options: Any
) -> AsyncIterator[tuple[EventServer, Publication]]:
    """A server that republishes its events."""
    async with running_server() as server:
        publication = Publication(session, options.pop("limits", PATIENT), **options)
        publisher = NatsPublisher(address, publication, patience_s)
        server.hub.sinks.append(publisher.offer)
        server.metrics.more.append(publication.lines)
        async with publisher.running():
            yield server, publication


async def until(publication: Publication, *, connected: bool) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while publication.connected is not connected:
            await asyncio.sleep(0.005)


def types(messages: list[Any]) -> list[EventType]:
    return [event_from_proto(pb.TouchEvent.FromString(message.data)).type for message in messages]


def tap(finger: SocketFinger) -> list[EventType]:
    finger.publish(E.HOVER_ENTER)
    finger.publish(E.DOWN)
    finger.publish(E.UP, E.CLICK)
    finger.publish(E.HOVER_EXIT)
    return [E.HOVER_ENTER, E.DOWN, E.UP, E.CLICK, E.HOVER_EXIT]


def test_events_arrive_in_order_under_their_subjects() -> None:
    async def test() -> None:
        with nats_server() as nats:
            async with listening(nats) as listener, publishing(NatsAddress.parse(nats.url)) as (server, publication):
                await until(publication, connected=True)
                expected = tap(SocketFinger(server))
                messages = await listener.hear(len(expected))
                assert types(messages) == expected
                assert [message.subject for message in messages] == [f"egotouch.v1.lab-1.palm.{name.value}" for name in expected]
                assert listener.messages.empty()
                text = server.metrics.text()
                assert 'egotouch_published_total{result="sent"} 5' in text and "egotouch_publisher_connected 1" in text

    run(test())


def test_two_sessions_are_told_apart_and_json_is_readable() -> None:
    async def test() -> None:
        with nats_server() as nats:
            address = NatsAddress.parse(nats.url)
            async with (
                listening(nats, "egotouch.v1.one.*.down") as one,
                listening(nats, "egotouch.v1.*.*.down") as both,
                publishing(address, "one", as_json=True) as (first, first_publication),
                publishing(address, "2nd floor.>*", as_json=True) as (second, second_publication),
            ):
                for publication in (first_publication, second_publication):
                    await until(publication, connected=True)
                tap(SocketFinger(first))
                tap(SocketFinger(second))
                assert [message.subject for message in await one.hear(1)] == ["egotouch.v1.one.palm.down"]
                heard = await both.hear(2)
                assert {message.subject for message in heard} == {"egotouch.v1.one.palm.down", "egotouch.v1.2nd_floor___.palm.down"}
                assert from_json(pb.TouchEvent, heard[0].data).type == pb.EVENT_TYPE_DOWN
                assert one.messages.empty() and both.messages.empty()

    run(test())


def test_a_server_killed_in_a_touch_gets_its_cancel_and_no_late_click_when_it_is_back() -> None:
    async def test() -> None:
        with nats_server() as nats:
            limits = Limits(input_ttl_ns=3 * SECOND_NS)
            async with publishing(NatsAddress.parse(nats.url), limits=limits) as (server, publication):
                finger = SocketFinger(server)
                async with listening(nats) as listener:
                    await until(publication, connected=True)
                    finger.publish(E.HOVER_ENTER)
                    finger.publish(E.DOWN)
                    await listener.hear(2)
                nats.kill()
                await until(publication, connected=False)
                finger.publish(E.UP, E.CLICK)
                finger.publish(E.DOWN)
                await asyncio.sleep(3.2)  # longer than the time to live
                nats.start()
                async with listening(nats) as listener:
                    await until(publication, connected=True)
                    finger.publish(E.MOVE)
                    finger.publish(E.UP, E.CLICK)
                    finger.publish(E.DOWN)
                    messages = [message async for message in _from(listener, E.DOWN)]
                    assert types(messages) in ([E.CANCEL, E.DOWN], [E.DOWN])  # the listener may be later than the CANCEL
                    assert publication.counts["too_old"] == 3 and publication.counts["cancelled"] == 1

    run(test())


async def _from(listener: Any, last: EventType) -> AsyncIterator[Any]:
    while True:
        (message,) = await listener.hear(1)
        yield message
        if types([message]) == [last]:
            return


def test_what_happens_last_is_still_sent() -> None:
    async def test() -> None:
        with nats_server() as nats:
            async with listening(nats) as listener:
                async with publishing(NatsAddress.parse(nats.url)) as (server, publication):
                    await until(publication, connected=True)
                    expected = tap(SocketFinger(server))
                assert types(await listener.hear(len(expected))) == expected

    run(test())


def test_a_server_that_freezes_for_a_moment_holds_nothing_up_and_misses_nothing() -> None:
    async def test() -> None:
        with nats_server() as nats:
            async with listening(nats) as listener, publishing(NatsAddress.parse(nats.url), patience_s=60) as (server, publication):
                client = SocketClient(server)
                await client.join()
                await until(publication, connected=True)
                nats.freeze()
                expected = tap(SocketFinger(server))
                await client.hear(*expected)
                assert publication.connected and listener.messages.empty()
                nats.thaw()
                assert types(await listener.hear(len(expected))) == expected
                assert publication.counts["cancelled"] == 0 and listener.messages.empty()

    run(test())


@pytest.mark.parametrize("touched", [True, False], ids=["touched", "idle"])
def test_a_server_that_stays_frozen_is_given_up(*, touched: bool) -> None:
    async def test() -> None:
        with nats_server() as nats:
            async with publishing(NatsAddress.parse(nats.url)) as (server, publication):
                client, finger = SocketClient(server), SocketFinger(server)
                await client.join()
                await until(publication, connected=True)
                nats.freeze()
                if touched:
                    await client.hear(*tap(finger))
                await until(publication, connected=False)
                await client.hear(*tap(finger))

    run(test())


def test_serving_begins_without_nats_and_publishing_when_it_is_there(caplog: pytest.LogCaptureFixture) -> None:
    async def test() -> None:
        nats = NatsServer()
        address = NatsAddress.parse(f"nats://hermit:s3cret@127.0.0.1:{nats.port}")
        async with publishing(address) as (server, publication):
            client = SocketClient(server)
            await client.join()
            finger = SocketFinger(server)
            await client.hear(*tap(finger))
            async with asyncio.timeout(PATIENCE_S):
                while "cannot be reached; serving goes on" not in caplog.text:
                    await asyncio.sleep(0.005)
            nats.start()
            try:
                await until(publication, connected=True)
                async with listening(nats) as listener:
                    second = SocketFinger(server, 2)
                    expected = tap(second)
                    heard = [message async for message in _from(listener, E.HOVER_EXIT)]
                    assert types(heard) == expected
            finally:
                nats.kill()

    caplog.set_level(logging.DEBUG)
    run(test())
    assert "is there again" in caplog.text
    assert "s3cret" not in caplog.text and "hermit" not in caplog.text


@pytest.mark.parametrize(
    ("options", "right", "login"),
    [
        (("--user", "touch", "--pass", "p@ss:w"), "touch:p%40ss:w", {"user": "touch", "password": "p@ss:w"}),
        (("--auth", "t0ken"), "t0ken", {"token": "t0ken"}),
    ],
    ids=["user", "token"],
)
def test_credentials_from_url_or_environment(
    options: tuple[str, ...], right: str, login: dict[str, str], caplog: pytest.LogCaptureFixture
) -> None:
    async def test() -> None:
        with nats_server(*options) as nats:
            in_url = NatsAddress.parse(nats.url.replace("//", f"//{right}@"))
            in_environment = NatsAddress.parse(nats.url, right)
            assert right not in repr(in_url) and right not in str(in_environment)
            for address in (in_url, in_environment):
                async with listening(nats, **login) as listener, publishing(address) as (server, publication):
                    await until(publication, connected=True)
                    expected = tap(SocketFinger(server))
                    assert types(await listener.hear(len(expected))) == expected
            async with publishing(NatsAddress.parse(nats.url, "wrong")) as (_, publication):
                async with asyncio.timeout(PATIENCE_S):
                    while "refuses the credentials" not in caplog.text:
                        await asyncio.sleep(0.005)
                assert not publication.connected

    run(test())
