"""How much latency the event server adds, what a stalled client costs, how well clocks agree, and random messages by the million.

python -m tests.benchmarks.event_server [latency] [stalled] [clock] [fuzz]

Clients run in a process of their own. Latency is from handing a frame's events to the server until they are written to the socket of the
last client, which is what the server adds, and until a client has read the message, which is also up to the machine's other load.
"""

from __future__ import annotations

import asyncio
import json
import os
import random
import signal
import sys
from pathlib import Path
from time import thread_time_ns

from websockets.asyncio.client import connect

from egotouch_sdk.clock import now_ns
from egotouch_sdk.server import EventServer, Journal, Session, Settings
from egotouch_sdk.server.subprotocol import SUBPROTOCOLS
from egotouch_sdk.touch_event import EventType
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.clock_offset import ClockOffset
from tests.support.events import make_event

CLIENTS, RATE_HZ, SECONDS = 32, 90, 10
MESSAGES = 1_000_000
JITTER_NS = 20_000_000
PROBES = (8, 16, 32, 64)
#: From handing over a frame until it is written to the socket of every client, for each frame; and the processor time of that.
WRITTEN_NS: list[int] = []
WORKED_NS: list[int] = []
WORKED = "    processor time of that, which other programs do not lengthen"
HELLO = pb.ClientMessage(hello=pb.Hello(client="benchmark")).SerializeToString()


async def listen(port: int, ages_ns: list[int]) -> None:
    async with connect(f"ws://127.0.0.1:{port}/", subprotocols=["egotouch.v1.pb"], compression=None, proxy=None) as connection:
        await connection.send(HELLO)
        async for data in connection:
            received_ns = now_ns()
            message = pb.ServerMessage.FromString(data)
            if message.HasField("batch"):
                ages_ns.append(received_ns - message.batch.timestamp_ns)


async def clients(port: int, count: int) -> None:
    ages_ns: list[int] = []
    await asyncio.gather(*(listen(port, ages_ns) for _ in range(count)), return_exceptions=True)  # the server's close ends each
    print(json.dumps(ages_ns))


def frame(server: EventServer, index: int) -> None:
    """Two fingers that slide: four events."""
    seen_ns = now_ns()
    kinds = [EventType.HOVER_ENTER, EventType.DOWN] if index == 0 else [EventType.MOVE]
    events = [
        make_event(kind, seen_ns, pointer_id=pointer, contact_id=0 if kind is EventType.HOVER_ENTER else 1, x_mm=float(index % 50))
        for pointer in (1, 2)
        for kind in kinds
    ]
    worked_ns = thread_time_ns()
    time_ns = now_ns()
    server.publish(index, time_ns, events, time_ns)
    WRITTEN_NS.append(now_ns() - time_ns)
    WORKED_NS.append(thread_time_ns() - worked_ns)


async def play(server: EventServer, seconds: float) -> None:
    WRITTEN_NS.clear()
    WORKED_NS.clear()
    start_ns = now_ns()
    for index in range(round(seconds * RATE_HZ)):
        await asyncio.sleep(max(start_ns + index * 1_000_000_000 // RATE_HZ - now_ns(), 0) / 1e9)
        frame(server, index)


async def spawn(port: int, count: int) -> asyncio.subprocess.Process:
    command = (sys.executable, "-m", "tests.benchmarks.event_server", "clients", str(port), str(count))
    return await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE)


async def joined(server: EventServer, count: int) -> None:
    while server.metrics.clients < count:
        await asyncio.sleep(0.05)
    await asyncio.sleep(0.5)


def report(name: str, ages_ns: list[int]) -> float:
    ordered = sorted(ages_ns)
    p50, p95, p99 = (ordered[int(share * (len(ordered) - 1))] / 1e6 for share in (0.5, 0.95, 0.99))
    load = os.getloadavg()[0]
    print(f"{name}: {len(ordered)} times, p50 {p50:.2f} ms, p95 {p95:.2f} ms, p99 {p99:.2f} ms (load average {load:.1f})", flush=True)
    return p99


def resident_kib() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


async def measure(count: int, *, stalled: bool = False, seconds: float = SECONDS) -> tuple[list[int], int, dict[int, int]]:
    """Ages of all messages, growth of the server's memory in KiB and close codes, with `count` clients and maybe a stopped one."""
    server = EventServer(Settings(port=0))
    await server.start()
    listeners = await spawn(server.port, count)
    victim = await spawn(server.port, 1) if stalled else None
    await joined(server, count + (1 if stalled else 0))
    if victim:
        victim.send_signal(signal.SIGSTOP)
    before_kib = resident_kib()
    await play(server, seconds)
    growth_kib = resident_kib() - before_kib
    closed = {int(code): number for code, number in server.metrics.closed.items()}
    if victim:
        victim.kill()
        await victim.communicate()
    await server.stop()
    out, _ = await listeners.communicate()
    return json.loads(out), growth_kib, closed


async def latency() -> None:
    report(f"{CLIENTS} clients at {RATE_HZ} Hz, read by their one process", (await measure(CLIENTS))[0])
    report(f"{CLIENTS} clients at {RATE_HZ} Hz, written to every socket", WRITTEN_NS)
    report(WORKED, WORKED_NS)


async def stalled() -> None:
    """Alone, beside, beside, alone: what changes slowly on the machine meets both alike."""
    written: dict[bool, list[int]] = {False: [], True: []}
    worked: dict[bool, list[int]] = {False: [], True: []}
    growth_kib: dict[bool, int] = {False: 0, True: 0}
    closed: list[dict[int, int]] = []
    for beside in (False, True, True, False):
        _, kib, codes = await measure(8, stalled=beside, seconds=15.0)
        written[beside] += WRITTEN_NS
        worked[beside] += WORKED_NS
        growth_kib[beside] = max(growth_kib[beside], kib)
        closed += [codes] if beside else []
    p99_ms = []
    for beside, name in ((False, "8 clients"), (True, "8 clients beside a stopped one")):
        p99_ms.append(report(f"{name}, written to every socket", written[beside]))
        p99_ms.append(report(WORKED, worked[beside]))
    print(f"p99 {p99_ms[2] - p99_ms[0]:+.2f} ms, of processor time {p99_ms[3] - p99_ms[1]:+.2f} ms")
    print(f"server memory grew by {growth_kib[True]} KiB at most, without the stopped client by {growth_kib[False]} KiB; closed: {closed}")


def probed(session: Session, clock: ClockOffset, dice: random.Random, sent_ns: int) -> None:
    """One probe over a link that takes 0 to 20 ms each way, at a time of the client's clock, which is the server's as well."""
    there_ns, back_ns = (round(dice.uniform(0, JITTER_NS)) for _ in range(2))
    session.receive(pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=sent_ns)).SerializeToString(), sent_ns + there_ns)
    data = session.next_message(sent_ns + there_ns)
    assert isinstance(data, bytes)
    clock.add(pb.ServerMessage.FromString(data).clock_reply, sent_ns + there_ns + back_ns)


def clock() -> None:
    """A thousand clients that probe by the rule in proto/PROTOCOL.md; the true offset is 0."""
    dice, errors_ns = random.Random(1), {count: list[int]() for count in PROBES}
    for _ in range(1000):
        session, estimate = Session(Journal(1), SUBPROTOCOLS["egotouch.v1.pb"], 0), ClockOffset()
        session.receive(HELLO, 0)
        session.next_message(0)
        for index in range(max(PROBES)):
            probed(session, estimate, dice, index * 250_000_000)
            if index + 1 in errors_ns:
                errors_ns[index + 1].append(round(abs(estimate.offset_ns)))
    for count, errors in errors_ns.items():
        report(f"clock offset error after {count} probes, jitter 0 to 20 ms each way", errors)


def fuzz() -> None:
    """Random bytes, mutated and true messages to sessions in both spellings; any exception ends the run."""
    dice, codes, start_ns = random.Random(2), {}, now_ns()
    seeds = [
        HELLO,
        pb.ClientMessage(subscribe=pb.Subscribe(types=[4, 5], max_rate_hz=30)).SerializeToString(),
        pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=5)).SerializeToString(),
        b'{"hello": {"client": "x", "resume": {"epoch": "1", "offset": "2"}}}',
        b'{"subscribe": {"types": ["EVENT_TYPE_CLICK"], "max_rate_hz": 10}}',
    ]
    session, name = None, ""
    for index in range(MESSAGES):
        if session is None or session.close is not None or index % 50 == 0:
            if session is not None and session.close is not None:
                codes[session.close.code.name] = codes.get(session.close.code.name, 0) + 1
            name = dice.choice(sorted(SUBPROTOCOLS))
            session = Session(Journal(1), SUBPROTOCOLS[name], index)
            if dice.random() < 0.5:
                session.receive(HELLO if name.endswith("pb") else '{"hello": {}}', index)
        data = bytearray(dice.choice(seeds) if dice.random() < 0.8 else dice.randbytes(dice.randrange(80)))
        for _ in range(dice.randrange(4)):
            if data:
                data[dice.randrange(len(data))] = dice.randrange(256)
        session.receive(data.decode("latin-1") if name.endswith("json") else bytes(data), index)
        while session.next_message(index) is not None:
            pass
    print(f"{MESSAGES} random and mutated messages in {(now_ns() - start_ns) / 1e9:.0f} s, no exception, closed: {codes}")


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["clients"]:
        asyncio.run(clients(int(arguments[1]), int(arguments[2])))
        return
    for name in arguments or ["latency", "clock", "fuzz", "stalled"]:
        if name in {"latency", "stalled"}:
            asyncio.run(latency() if name == "latency" else stalled())
        else:
            {"clock": clock, "fuzz": fuzz}[name]()


if __name__ == "__main__":
    main(sys.argv[1:])
