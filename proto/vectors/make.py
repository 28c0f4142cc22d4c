"""Makes the golden vectors from simulated fingers, the real event engine and the real server: `python proto/vectors/make.py`.

Made once for each version of the schema: clients need fixed input, not the newest. See README.md for the format.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from google.protobuf.internal.encoder import _VarintBytes

FOLDER = Path(__file__).parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parents[1])]

from reference_client import ReferenceClient  # noqa: E402

from egotouch_sdk.config import TouchConfig  # noqa: E402
from egotouch_sdk.engine import EventEngine  # noqa: E402
from egotouch_sdk.frame_observation import FrameObservation  # noqa: E402
from egotouch_sdk.server import EventHub, Journal, Limits, Session  # noqa: E402
from egotouch_sdk.server.subprotocol import Protobuf  # noqa: E402
from egotouch_sdk.server.welcome import ServerInfo  # noqa: E402
from egotouch_sdk.simulator import observe  # noqa: E402
from egotouch_sdk.simulator.script import parse_script  # noqa: E402
from egotouch_sdk.simulator.timeline import Timeline  # noqa: E402
from egotouch_sdk.wire import decode, to_json  # noqa: E402
from egotouch_sdk.wire.gen import egotouch_pb2 as pb  # noqa: E402

FPS = 30
MS = 1_000_000
#: The server's clock when the script begins, and how long after its capture a frame's events are published.
START_NS, LATENCY_NS = 5_000_000_000, 20 * MS
EPOCH = 0x1122334455667788

#: A message and its JSON; None is a lost connection.
Message = tuple[bytes, dict[str, object]] | None


@dataclass(frozen=True)
class Scene:
    """A script, and what happens to the connection at which time of it.

    From `cut_ms` on there is none until `back_ms`. The client reads nothing between the two times of `busy_ms`. At `restart_ms` the
    server starts anew.
    """

    acts: str
    cut_ms: float = float("inf")
    back_ms: float = float("inf")
    busy_ms: tuple[float, float] = (0.0, 0.0)
    restart_ms: float = float("inf")
    late_edges: bool = False


SCENES = {
    "tap": Scene("[{tap: {at: [0, 50]}}]"),
    "double_tap": Scene("[{double_tap: {at: [0, 50]}}]"),
    "drag": Scene("[{drag: {at: [0, 20], to: [0, 70]}}]"),
    "fling": Scene("[{fling: {at: [10, 20], to: [10, 70]}}]"),
    "long_click": Scene("[{press: {at: [20, 40], duration_ms: 700, force_n: 0.8}}]"),
    "force_press": Scene("[{press: {at: [20, 40], duration_ms: 500, force_n: 3.0}}]"),
    "tracking_lost": Scene("[{drag: {at: [0, 20], to: [0, 70]}}, {vanish: {with_ms: 500, duration_ms: 400}}]"),
    "two_fingers": Scene("[{press: {at: [0, 50]}}, {tap: {at: [-15, 60], finger: middle, with_ms: 300}}]"),
    "slow_reader": Scene("[{drag: {at: [0, 20], to: [0, 70]}}]", busy_ms=(600.0, 800.0)),
    "late": Scene("[{tap: {at: [0, 50]}}, {tap: {at: [0, 50]}}]", busy_ms=(300.0, 1300.0)),
    "late_edges": Scene("[{tap: {at: [0, 50]}}, {tap: {at: [0, 50]}}]", busy_ms=(300.0, 1300.0), late_edges=True),
    "resumed": Scene("[{drag: {at: [0, 20], to: [0, 70], duration_ms: 900}}]", cut_ms=700.0, back_ms=850.0),
    "not_resumed": Scene(
        "[{press: {at: [20, 40], duration_ms: 900, force_n: 3.0}}, {tap: {at: [0, 50]}}]", cut_ms=700.0, back_ms=900.0, restart_ms=800.0
    ),
    "lost": Scene("[{drag: {at: [0, 20], to: [0, 70], duration_ms: 900, force_n: 2.0}}]", cut_ms=800.0),
}


class Connection:
    """A server and one client of it."""

    def __init__(self, scene: Scene) -> None:
        self.messages: list[Message] = []
        self.client = ReferenceClient()
        self._scene = scene
        self._session: Session | None = None
        self.restart(EPOCH)

    def restart(self, epoch: int) -> None:
        """A new run of the server."""
        self.engine = EventEngine(TouchConfig(debug=True))
        self.hub = EventHub(Journal(epoch))

    def open(self, now_ns: int) -> None:
        """Connect and say Hello."""
        info = ServerInfo(version="1.0.0", settings=ServerInfo.of(TouchConfig()).settings)
        self._session = Session(self.hub.journal, Protobuf(), now_ns, limits=Limits(), info=info)
        self.hub.sessions = {self._session}
        self._session.receive(self._hello().SerializeToString(), now_ns)

    def cut(self) -> None:
        """Lose the connection."""
        self._session = None
        self.hub.sessions = set()
        self.client.lose_connection()
        self.messages.append(None)

    def publish(self, observation: FrameObservation, now_ns: int) -> None:
        """One frame on the server's side."""
        self.hub.publish(observation.index, observation.timestamp_ns, self.engine.process(observation).events, now_ns)

    def read(self, now_ns: int) -> None:
        """The client takes all that the server has for it."""
        if self._session is None:
            return
        self._session.tick(now_ns)
        while (data := self._session.next_message(now_ns)) is not None:
            assert isinstance(data, bytes)
            message = decode(pb.ServerMessage, data)
            self.client.receive(message)
            self.messages.append((data, json.loads(to_json(message))))

    def _hello(self) -> pb.ClientMessage:
        hello = pb.Hello(client="vectors", version="1.0.0", subscribe=pb.Subscribe(late_edges=self._scene.late_edges))
        if self.messages:
            hello.resume.CopyFrom(self.client.resume())
        return pb.ClientMessage(hello=hello)


def observations(acts: str) -> Iterator[FrameObservation]:
    """What a camera would have seen of the script."""
    timeline = Timeline(parse_script(f"{{fps: {FPS}, acts: {acts}}}", "vector"), "vector")
    for index in range(1 + int(timeline.duration_ms * FPS / 1000)):
        scene = timeline.scene(index * 1000 / FPS, index)
        if scene is not None:
            yield observe(scene, index, START_NS + round(index * 1e9 / FPS))


def play(scene: Scene) -> tuple[list[Message], ReferenceClient]:
    """All messages of a scene, and the client that took them."""
    link = Connection(scene)
    link.open(START_NS)
    is_open, has_restarted = True, False
    for observation in observations(scene.acts):
        now_ns = observation.timestamp_ns + LATENCY_NS
        at_ms = (observation.timestamp_ns - START_NS) / MS
        if at_ms >= scene.restart_ms and not has_restarted:
            link.restart(EPOCH + 1)
            has_restarted = True
        if is_open and scene.cut_ms <= at_ms < scene.back_ms:
            link.cut()
            is_open = False
        elif not is_open and at_ms >= scene.back_ms:
            link.open(now_ns)
            is_open = True
        link.publish(observation, now_ns)
        if not scene.busy_ms[0] <= at_ms < scene.busy_ms[1]:
            link.read(now_ns)
    if not is_open:
        link.client.cancel_all()
    return link.messages, link.client


def newer_server(messages: list[Message]) -> list[Message]:
    """The same messages with what a later version may add: a kind of message, a type of event and a field that nobody knows yet."""
    result: list[Message] = []
    for number, entry in enumerate(messages):
        assert entry is not None
        message = decode(pb.ServerMessage, entry[0])
        if number == 1:
            unknown_body = pb.ServerMessage(offset=message.offset).SerializeToString() + b"\x9a\x06\x02hi"  # field 99
            result.append((unknown_body, {"offset": str(message.offset), "from_the_future": "hi"}))
        if message.HasField("batch"):
            message.batch.events.append(message.batch.events[-1])
            message.batch.events[-1].type = 99  # type: ignore[assignment]
            content = json.loads(to_json(message))
            content["batch"]["from_the_future"] = "hi"
            batch = message.batch.SerializeToString() + b"\x9a\x06\x02hi"
            rest = pb.ServerMessage(offset=message.offset).SerializeToString()
            result.append((rest + b"\x1a" + _VarintBytes(len(batch)) + batch, content))
        else:
            result.append(entry)
    return result


def _truncated(data: bytes) -> bytes:
    """The message without its last bytes, as no link delivers it."""
    return data[:-5]


def _invalid(data: bytes) -> bytes:
    """The message with an event that lies at no place."""
    message = decode(pb.ServerMessage, data)
    message.batch.events[-1].x_mm = float("nan")
    return bytes(message.SerializeToString())


def _write(name: str, messages: list[Message], log: list[str]) -> None:
    _write_bin(FOLDER / f"{name}.bin", [entry and entry[0] for entry in messages])
    lines = ",\n".join(json.dumps(entry and entry[1], separators=(",", ":")) for entry in messages)
    (FOLDER / f"{name}.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")
    (FOLDER / f"{name}.log").write_text("".join(f"{line}\n" for line in log), encoding="utf-8")


def _write_twin(name: str, messages: list[Message], spoil: Callable[[bytes], bytes]) -> None:
    """The messages up to the last with events; that one is spoiled, and nothing follows."""
    datas = [entry and entry[0] for entry in messages]
    spoiled = max(number for number, data in enumerate(datas) if data and decode(pb.ServerMessage, data).HasField("batch"))
    data = datas[spoiled]
    assert data is not None
    _write_bin(FOLDER / f"{name}.bin", [*datas[:spoiled], spoil(data)])


def _write_bin(path: Path, datas: list[bytes | None]) -> None:
    path.write_bytes(b"".join(_VarintBytes(len(data or b"")) + (data or b"") for data in datas))


def client_messages() -> list[pb.ClientMessage]:
    """What a client may say, for tests of its encoder."""
    subscribe = pb.Subscribe(types=[pb.EVENT_TYPE_DOWN, pb.EVENT_TYPE_UP], surfaces=[pb.SURFACE_PALM], max_rate_hz=30.0, latest_only=True)
    held = pb.HeldPointer(pointer_id=3, contact_id=2, dragging=True)
    finger = pb.SimulatedPointer(
        id=1, hand=pb.HANDEDNESS_RIGHT, finger=pb.FINGER_INDEX, surface=pb.SURFACE_PALM, x_mm=-12.5, y_mm=50.0, force_n=1.5, pitch_rad=0.75
    )
    return [
        pb.ClientMessage(hello=pb.Hello(client="demo", version="1.2.3", token="s3cret")),
        pb.ClientMessage(hello=pb.Hello(client="demo", pairing_code="123456", subscribe=subscribe)),
        pb.ClientMessage(hello=pb.Hello(client="demo", resume=pb.Resume(epoch=EPOCH, offset=2**40, held=[held]))),
        pb.ClientMessage(subscribe=subscribe),
        pb.ClientMessage(clock_request=pb.ClockRequest(client_send_ns=2**53 + 1)),
        pb.ClientMessage(heartbeat=pb.Heartbeat()),
        pb.ClientMessage(simulated=pb.SimulatedPointers(pointers=[finger])),
    ]


def main() -> None:
    """Write all files."""
    for name, scene in SCENES.items():
        messages, client = play(scene)
        _write(name, messages, client.log)
        _write_twin(f"{name}_truncated", messages, _truncated)
        _write_twin(f"{name}_invalid", messages, _invalid)
        if name == "tap":
            _write("newer_server", newer_server(messages), client.log)
    sent = client_messages()
    _write_bin(FOLDER / "client_messages.bin", [message.SerializeToString() for message in sent])
    lines = ",\n".join(json.dumps(json.loads(to_json(message)), separators=(",", ":")) for message in sent)
    (FOLDER / "client_messages.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
