"""Send touches on skin to anything that understands TUIO 1.1: TouchDesigner, Ventuz, Unity, Processing ...

python examples/tuio_bridge/app.py [SOURCE] [--surface palm] [--to 127.0.0.1:3333]

SOURCE: camera index (default 0), video, recording or simulator script. Needs: pip install 'egotouch-sdk[tuio]'
"""

import argparse
import socket
import sys
from contextlib import suppress
from threading import Event, Lock, Thread

from tuio import ADDRESS, SCREENS, Message, TuioCursors

from egotouch_sdk import EgoTouch, EgoTouchError, MissingExtraError, Surface, TouchEvent, TouchListener

try:
    from pythonosc.osc_bundle_builder import IMMEDIATELY, OscBundleBuilder
    from pythonosc.osc_message_builder import OscMessageBuilder
except ModuleNotFoundError:
    sys.exit(f"app.py: {MissingExtraError('the TUIO bridge', 'tuio')}")

#: What was sent last is repeated this often, as TUIO's own trackers do.
REFRESH_S = 1.0


def encode(messages: list[Message]) -> bytes:
    """One OSC bundle; Python's int, float and str become OSC's int32, float32 and string."""
    bundle = OscBundleBuilder(IMMEDIATELY)
    for arguments in messages:
        message = OscMessageBuilder(ADDRESS)
        for argument in arguments:
            message.add_arg(argument)
        bundle.add_content(message.build())
    return bundle.build().dgram


class TuioSender(TouchListener):
    """Sends every change of a cursor at once, and all cursors again every second, until it is closed."""

    def __init__(self, cursors: TuioCursors, receiver: tuple[str, int]) -> None:
        self._cursors = cursors
        self._receiver = receiver
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._lock = Lock()
        self._closing = Event()
        self._repeater = Thread(target=self._repeat, name="tuio-refresh", daemon=True)
        self._repeater.start()

    def onTouchDown(self, event: TouchEvent) -> None:
        with self._lock:
            self._send(self._cursors.feed(event))

    onTouchMove = onTouchUp = onTouchCancel = onTouchDown

    def close(self) -> None:
        """Say once more what is left, and end."""
        self._closing.set()
        self._repeater.join()
        self._send(self._cursors.refresh())
        self._socket.close()

    def _repeat(self) -> None:
        while not self._closing.wait(REFRESH_S):
            with self._lock:
                self._send(self._cursors.refresh())

    def _send(self, messages: list[Message]) -> None:
        if messages:
            with suppress(OSError):  # UDP promises nothing; once the network is back, the next bundle says all that counts
                self._socket.sendto(encode(messages), self._receiver)


def receiver(text: str) -> tuple[str, int]:
    """`host:port`, where the port may be left out."""
    host, _, port = text.partition(":")
    try:
        address, number = socket.gethostbyname(host), int(port or 3333)
    except (OSError, ValueError):
        number = 0
    if not 0 < number < 65536:
        raise argparse.ArgumentTypeError(f"{text} is no receiver; give host:port such as 127.0.0.1:3333")
    return address, number


def main() -> None:
    parser = argparse.ArgumentParser(description="Send touches on skin as TUIO 1.1 cursors.")
    parser.add_argument("source", nargs="?", default="0", help="camera index, video, recording or simulator script (default 0)")
    parser.add_argument("--surface", choices=list(Surface), default=Surface.PALM, type=Surface, help="the skin that is the screen (palm)")
    parser.add_argument("--to", type=receiver, default=("127.0.0.1", 3333), help="host:port of the receiver (default 127.0.0.1:3333)")
    parser.add_argument("--fast", action="store_true", help="play a file as fast as it can be read")
    options = parser.parse_args()

    sender = TuioSender(TuioCursors(SCREENS[options.surface]), options.to)
    try:
        with EgoTouch(options.source, realtime=False if options.fast else None) as et:
            et.addListener(sender)
            et.run()
    finally:
        sender.close()


if __name__ == "__main__":
    try:
        main()
    except EgoTouchError as error:
        sys.exit(f"app.py: {error}")
