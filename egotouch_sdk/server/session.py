"""One client's side of the protocol: its messages in, the server's messages out. No sockets, no clock."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable
from enum import StrEnum
from math import ceil

from egotouch_sdk.errors import ProtocolError
from egotouch_sdk.server.access import Access, OpenAccess
from egotouch_sdk.server.batch import Batch
from egotouch_sdk.server.batch_message import batch_message
from egotouch_sdk.server.close_code import Close, CloseCode
from egotouch_sdk.server.journal import Journal
from egotouch_sdk.server.limits import MILLISECOND_NS, SECOND_NS, Limits
from egotouch_sdk.server.outbox import Outbox
from egotouch_sdk.server.pointer_view import PointerView
from egotouch_sdk.server.pushing import PushTarget
from egotouch_sdk.server.rate import TokenBucket
from egotouch_sdk.server.resuming import held_pointers, missed_batches
from egotouch_sdk.server.subprotocol import Subprotocol
from egotouch_sdk.server.subscription import Subscription
from egotouch_sdk.server.welcome import PROTOCOL_MINOR, ServerInfo
from egotouch_sdk.wire import event_to_proto
from egotouch_sdk.wire.gen import egotouch_pb2 as pb


class State(StrEnum):
    """Where a connection is."""

    AWAITING_HELLO = "awaiting_hello"
    LIVE = "live"
    CLOSED = "closed"


class Session:
    """One connection, from its first byte to its close code.

    `receive` takes the client's messages, `offer` the server's batches, `tick` lets time pass; `next_message` gives what to send next
    and is called whenever the transport has room. Once `close` is set, nothing more is sent and nothing more is taken.
    `push` takes what a client pushes as the server's source; without it such messages are answered by a Warning.
    `drops` counts what did not go out as it came in, by the classes of `metrics.DROPS`.
    """

    def __init__(
        self,
        journal: Journal,
        subprotocol: Subprotocol,
        now_ns: int,
        *,
        access: Access | None = None,
        limits: Limits | None = None,
        info: ServerInfo | None = None,
        push: PushTarget | None = None,
        drops: Counter[str] | None = None,
    ) -> None:
        self.state = State.AWAITING_HELLO
        self.close: Close | None = None
        self.client = ""
        self.subscription = Subscription()
        self._journal = journal
        self._subprotocol = subprotocol
        self._access = access or OpenAccess()
        self._limits = limits or Limits()
        self._info = info or ServerInfo()
        self._push = push
        self._drops = Counter() if drops is None else drops
        self._commands = TokenBucket(self._limits.commands_per_s, self._limits.command_burst, now_ns)
        burst_s = self._limits.push_burst_s
        self._pushes = TokenBucket(self._limits.pushes_per_s, self._limits.pushes_per_s * burst_s, now_ns)
        self._push_bytes = TokenBucket(self._limits.push_bytes_per_s, self._limits.push_bytes_per_s * burst_s, now_ns)
        self._view = PointerView(self.subscription)
        self._outbox = Outbox(self._limits)
        self._control: deque[pb.ServerMessage] = deque()
        self._offset = 0
        self._hello_due_ns = now_ns + self._limits.hello_timeout_ns
        self._sent_ns = now_ns
        self._progress_ns = now_ns
        self._next_stream_ns = now_ns

    @property
    def merged(self) -> int:
        """Batches that became part of a later one because the client was slow or wants fewer."""
        return self._outbox.merged

    @property
    def has_waiting(self) -> bool:
        """True when something waits to be sent."""
        return bool(self._control or len(self._outbox))

    # ---------------------------------------------------------------------------------------------------------- client to server

    def receive(self, data: bytes | str, now_ns: int) -> None:
        """Take one WebSocket message."""
        if self.close:
            return
        if len(data) > self._limits.max_message_bytes:
            self.end(CloseCode.TOO_LARGE, f"messages have at most {self._limits.max_message_bytes} bytes")
            return
        try:
            message = self._subprotocol.decode(data)
            self._handle(message, now_ns)
        except ProtocolError as error:
            self.end(CloseCode.MALFORMED, str(error))

    def _handle(self, message: pb.ClientMessage, now_ns: int) -> None:
        kind = message.WhichOneof("body")
        if kind not in _PUSHES and not self._commands.take(now_ns):
            self.end(CloseCode.TOO_MANY_COMMANDS, f"at most {self._limits.commands_per_s} commands per second")
            return
        handler = _HANDLERS[self.state].get(kind)
        if handler is not None:
            handler(self, message, now_ns)
        elif self.state is State.LIVE and kind is None:
            self._warn("unknown_message", "a message of this kind is not known here; both sides work on without it")
        else:
            self.end(CloseCode.WRONG_ORDER, f"a {kind or 'message of an unknown kind'} came while {self.state.replace('_', ' ')}")

    def _on_hello(self, message: pb.ClientMessage, now_ns: int) -> None:
        hello = message.hello
        admission = self._access.admit(hello.token, hello.pairing_code, now_ns)
        if not admission.admitted:
            self.end(CloseCode.WRONG_TOKEN, "token or pairing code are missing, wrong or used up")
            return
        self.client = hello.client
        self.subscription = Subscription.from_proto(hello.subscribe)
        held = held_pointers(hello.resume)
        missed = missed_batches(self._journal, hello.resume, held, now_ns) if hello.HasField("resume") else None
        self._view = PointerView(self.subscription, held if missed is not None else None)
        self._offset = self._journal.offset if missed is None else hello.resume.offset
        self.state = State.LIVE
        self._control.append(pb.ServerMessage(welcome=self._welcome(hello, admission.token, missed is not None, now_ns)))
        if hello.protocol_minor > PROTOCOL_MINOR:
            self._warn("older_server", f"the server speaks minor {PROTOCOL_MINOR}; see Welcome.features for what it can do")
        for batch in missed or ():
            self._outbox.push(batch)
        self._progress_ns = now_ns

    def _welcome(self, hello: pb.Hello, token: str, recovered: bool, now_ns: int) -> pb.Welcome:
        wanted = [event_to_proto(event) for event in self._journal.pointers if self.subscription.wants_place(event)]
        return pb.Welcome(
            epoch=self._journal.epoch,
            recovered=recovered,
            resume_requested=hello.HasField("resume"),
            protocol_minor=PROTOCOL_MINOR,
            server_version=self._info.version,
            heartbeat_ms=self._limits.heartbeat_ns // MILLISECOND_NS,
            active_heartbeat_ms=self._limits.active_heartbeat_ns // MILLISECOND_NS,
            input_ttl_ms=self._limits.input_ttl_ns // MILLISECOND_NS,
            features=self._info.features,
            settings=self._info.settings,
            snapshot=pb.Snapshot(pointers=wanted),
            server_now_ns=now_ns,
            token=token,
        )

    def _on_subscribe(self, message: pb.ClientMessage, now_ns: int) -> None:
        del now_ns
        self.subscription = self._view.subscription = Subscription.from_proto(message.subscribe)

    def _on_clock_request(self, message: pb.ClientMessage, now_ns: int) -> None:
        reply = pb.ClockReply(client_send_ns=message.clock_request.client_send_ns, server_receive_ns=now_ns)
        self._control.append(pb.ServerMessage(clock_reply=reply))

    def _on_heartbeat(self, message: pb.ClientMessage, now_ns: int) -> None:
        """Nothing to do: that it came is all it says."""

    def _on_push(self, message: pb.ClientMessage, now_ns: int) -> None:
        kind = message.WhichOneof("body")
        if self._push is not None and kind is not None and kind in self._push.kinds:
            if self._pushes.take(now_ns) and self._push_bytes.take(now_ns, message.ByteSize()):
                warnings = self._push.take(self, getattr(message, kind), now_ns)
                self._control.extend(pb.ServerMessage(warning=warning) for warning in warnings)
            else:
                self.end(CloseCode.TOO_MANY_COMMANDS, "more is pushed than this server takes")
        elif self._commands.take(now_ns):
            self._warn("not_a_source", "this server's source does not take what this client pushes")
        else:
            self.end(CloseCode.TOO_MANY_COMMANDS, "this server's source does not take what this client pushes")

    # ---------------------------------------------------------------------------------------------------------- server to client

    def offer(self, batch: Batch, now_ns: int) -> None:
        """Take the newest batch; the client is closed when too much waits for it."""
        if self.state is not State.LIVE:
            return
        if not self.has_waiting:
            self._progress_ns = now_ns
        self._drops["move"] += self._outbox.push(batch)
        if self._outbox.is_overfull:
            self._end_slow()

    def offer_status(self, status: pb.Status) -> None:
        """Take the newest status, for clients that asked; left out while others wait."""
        if self.state is not State.LIVE or not self.subscription.status:
            return
        if self._control:
            self._drops["status"] += 1
            return
        mine = pb.Status()
        mine.CopyFrom(status)
        mine.merged = self.merged
        self._control.append(pb.ServerMessage(status=mine))

    def offer_hands(self, hands: pb.HandsView) -> None:
        """Take the newest landmarks, for clients that asked; left out while others wait."""
        if self.state is not State.LIVE or not self.subscription.landmarks:
            return
        if self.has_waiting:
            self._drops["status"] += 1
        else:
            self._control.append(pb.ServerMessage(hands=hands))

    def next_message(self, now_ns: int) -> bytes | str | None:
        """The next message to send now, None when there is none."""
        self._progress_ns = now_ns
        if self.close:
            return None
        if self._control:
            return self._finish(self._control.popleft(), now_ns)
        while len(self._outbox) and not self._is_holding(now_ns):
            batch = self._outbox.pop()
            stale = now_ns - batch.published_ns > self._limits.input_ttl_ns
            withheld_before = self._view.withheld
            shown = self._view.apply(batch.events, stale=stale, replay=batch.replay)
            self._drops["late_edge"] += self._view.withheld - withheld_before
            self._offset = batch.offset
            if shown[1]:
                self._sent_ns = now_ns
                if self.subscription.max_rate_hz:
                    self._next_stream_ns = now_ns + ceil(SECOND_NS / self.subscription.max_rate_hz)
                return batch_message(batch, shown, self._offset, now_ns, self._subprotocol, latest_only=self.subscription.latest_only)
        return None

    def tick(self, now_ns: int) -> None:
        """Let time pass: a missing Hello, a client that stopped reading, or a heartbeat that is due."""
        if self.close:
            return
        if self.state is State.AWAITING_HELLO:
            if now_ns >= self._hello_due_ns:
                self.end(CloseCode.HELLO_TIMEOUT, "no Hello came")
        elif self.has_waiting and now_ns - self._progress_ns > self._limits.patience_ns:
            self._end_slow()
        elif now_ns - self._sent_ns >= self._silence_ns and (not self.has_waiting or self._is_holding(now_ns)):
            active = len(self._journal.contacts)
            self._control.append(pb.ServerMessage(heartbeat=pb.Heartbeat(active_contacts=active)))

    def end(self, code: CloseCode, reason: str = "") -> None:
        """Close the connection; the first reason counts."""
        if self.close is None:
            self.close = Close(code, _shortened(reason))
        self.state = State.CLOSED

    def _is_holding(self, now_ns: int) -> bool:
        """True when all that waits is held back by the client's own rate."""
        head = self._outbox.head
        only_moves = head is not None and not head.has_edges and len(self._outbox) == 1
        return only_moves and not self._control and now_ns < self._next_stream_ns

    @property
    def _silence_ns(self) -> int:
        return self._limits.active_heartbeat_ns if self._journal.contacts else self._limits.heartbeat_ns

    def _end_slow(self) -> None:
        self.end(CloseCode.TOO_SLOW, "the client reads too slowly")

    def _warn(self, code: str, text: str) -> None:
        self._control.append(pb.ServerMessage(warning=pb.Warning(code=code, message=text)))

    def _finish(self, message: pb.ServerMessage, now_ns: int) -> bytes | str:
        message.offset = self._offset
        if message.HasField("clock_reply"):
            message.clock_reply.server_send_ns = now_ns
        elif message.HasField("heartbeat"):
            message.heartbeat.sent_ns = now_ns
        self._sent_ns = now_ns
        return self._subprotocol.encode(message)


_Handler = Callable[[Session, pb.ClientMessage, int], None]
_PUSHES = frozenset({"frame", "hands", "simulated"})

#: What a client may say in which state; everything else closes the connection.
_HANDLERS: dict[State, dict[str | None, _Handler]] = {
    State.AWAITING_HELLO: {"hello": Session._on_hello},
    State.LIVE: {
        "subscribe": Session._on_subscribe,
        "clock_request": Session._on_clock_request,
        "heartbeat": Session._on_heartbeat,
        "frame": Session._on_push,
        "hands": Session._on_push,
        "simulated": Session._on_push,
    },
    State.CLOSED: {},
}


def _shortened(reason: str) -> str:
    return reason if len(reason.encode()) <= 123 else reason.encode()[:120].decode(errors="ignore") + "..."
