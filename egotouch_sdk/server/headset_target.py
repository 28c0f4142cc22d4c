"""A headset as the source: one client at a time pushes its camera's frames, with or without its own hands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from egotouch_sdk.errors import FrameError
from egotouch_sdk.server.client_clock import ClientClock
from egotouch_sdk.server.headset_hands import Hands, hands_from_message
from egotouch_sdk.server.headset_source import HeadsetSource, Picture
from egotouch_sdk.server.jpeg import jpeg_size
from egotouch_sdk.server.limits import SECOND_NS
from egotouch_sdk.server.metrics import family, labelled
from egotouch_sdk.server.pushing import Pushed
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

#: A client that sent no usable frame for this long is the source no more; its clock is learned anew when it goes on.
SEAT_NS = 2 * SECOND_NS
#: A frame that comes this much earlier or later than those before it has a wrong time.
MAX_JUMP_NS = 5 * SECOND_NS
#: One warning of a kind per client in this time.
WARNING_PAUSE_NS = SECOND_NS


@dataclass(slots=True, eq=False)
class _Seat:
    """The client that is the source, and what waits for its other half: a frame for its hands or hands for their frame."""

    client: object
    used_ns: int
    clock: ClientClock = field(default_factory=ClientClock)
    captured_ns: int = -1
    sends_hands: bool = False
    frame: tuple[int, Picture] | None = None
    hands: tuple[int, Hands] | None = None


class HeadsetTarget:
    """Decides which pushed frames the source gets.

    - The first client that pushes is the source until it leaves or sends no usable frame for 2 seconds; all others are warned
      (`another_source`) and what they push is dropped.
    - `timestamp_ns` must rise from frame to frame (`time_not_rising`) and keep pace with the server's clock to 5 seconds
      (`time_jump`); `ClientClock` maps it to that clock.
    - A frame is a JPEG of 32 px a side to 3840 x 2160 px (`bad_frame`); its header is looked at before it is unpacked.
    - Once a client has sent hands, each of its frames needs the ClientHands of the very same `timestamp_ns`, before or after it, also
      where no hand is seen; a frame that is overtaken without them is dropped (`hands_missing`), hands without their frame likewise
      (`frame_missing`).
    A warning of one kind comes at most once a second. `counts` has the frames that did not reach the source, by reason.
    """

    kinds = frozenset({"frame", "hands"})

    def __init__(self, source: HeadsetSource) -> None:
        self._source = source
        self._seat: _Seat | None = None
        self._stamp_ns = -1
        self._warned_ns: dict[tuple[object, str], int] = {}
        self.counts = dict.fromkeys(("another_source", "time_not_rising", "time_jump", "bad_frame", "hands_missing", "frame_missing"), 0)

    def take(self, client: object, pushed: Pushed, now_ns: int) -> tuple[pb.Warning, ...]:
        """Take a frame or hands; `ProtocolError` for hands that make no sense."""
        seat = self._seat_of(client, now_ns)
        if seat is None:
            return self._warn(client, "another_source", "another client is the source; it has to leave first", now_ns)
        if isinstance(pushed, pb.ClientHands):
            return self._take_hands(seat, pushed, now_ns)
        return self._take_frame(seat, pushed, now_ns) if isinstance(pushed, pb.ClientFrame) else ()

    def leave(self, client: object) -> None:
        """`client` has gone; when it was the source, what it touched is cancelled and another may push."""
        for key in [key for key in self._warned_ns if key[0] is client]:
            del self._warned_ns[key]
        if self._seat is not None and self._seat.client is client:
            self._give_up()

    def lines(self) -> Iterator[str]:
        """Both sides' counts in Prometheus' text format."""
        fates = {name: self._source.counts[name] for name in ("taken", "replaced", "damaged")} | self.counts
        yield from family("egotouch_pushed_total", "counter", "Frames and hands pushed, by their fate.", labelled("fate", fates))

    def _seat_of(self, client: object, now_ns: int) -> _Seat | None:
        if self._seat is not None and now_ns - self._seat.used_ns > SEAT_NS:
            self._give_up()
        if self._seat is None:
            self._seat = _Seat(client, now_ns)
        return self._seat if self._seat.client is client else None

    def _give_up(self) -> None:
        if self._seat is not None and self._seat.captured_ns >= 0:
            self._source.leave(self._stamp_ns)
        self._seat = None

    def _take_frame(self, seat: _Seat, message: pb.ClientFrame, now_ns: int) -> tuple[pb.Warning, ...]:
        captured_ns = message.timestamp_ns
        if captured_ns <= seat.captured_ns:
            return self._warn(seat.client, "time_not_rising", f"timestamp_ns {captured_ns} is not after {seat.captured_ns}", now_ns)
        if abs(seat.clock.lag_ns(captured_ns, now_ns)) > MAX_JUMP_NS:
            return self._warn(seat.client, "time_jump", "timestamp_ns jumps by over 5 s against the server's clock", now_ns)
        try:
            jpeg_size(message.jpeg)
        except FrameError as error:
            return self._warn(seat.client, "bad_frame", str(error), now_ns)
        seat.captured_ns, seat.used_ns = captured_ns, now_ns
        self._stamp_ns = max(seat.clock.to_server(captured_ns, now_ns), self._stamp_ns + 1)
        picture = Picture(message.jpeg, self._stamp_ns)
        damage = self._source.pop_damage()
        warnings = self._warn(seat.client, "bad_frame", damage, now_ns, counted=False) if damage else ()
        if not seat.sends_hands:
            self._source.put(picture)
        elif seat.hands is not None and seat.hands[0] == captured_ns:
            self._join(seat, picture, seat.hands[1])
        else:
            if seat.frame is not None:
                text = f"no hands came for the frame of {seat.frame[0]}; send ClientHands for every frame, empty without hands"
                warnings += self._warn(seat.client, "hands_missing", text, now_ns)
            seat.frame = captured_ns, picture
        return warnings

    def _take_hands(self, seat: _Seat, message: pb.ClientHands, now_ns: int) -> tuple[pb.Warning, ...]:
        hands = hands_from_message(message)
        seat.sends_hands = True
        if seat.frame is not None and seat.frame[0] == message.timestamp_ns:
            self._join(seat, seat.frame[1], hands)
            return ()
        lost, seat.hands = seat.hands is not None, (message.timestamp_ns, hands)
        text = "hands came twice without their frame; send a ClientFrame of the same timestamp_ns"
        return self._warn(seat.client, "frame_missing", text, now_ns) if lost else ()

    def _join(self, seat: _Seat, picture: Picture, hands: Hands) -> None:
        seat.frame = seat.hands = None
        self._source.put(Picture(picture.jpeg, picture.timestamp_ns, hands))

    def _warn(self, client: object, code: str, text: str, now_ns: int, *, counted: bool = True) -> tuple[pb.Warning, ...]:
        self.counts[code] += counted
        last_ns = self._warned_ns.get((client, code))
        if last_ns is not None and now_ns - last_ns < WARNING_PAUSE_NS:
            return ()
        self._warned_ns[client, code] = now_ns
        return (pb.Warning(code=code, message=text),)
