"""Ports for servers that must be found again where they were."""

from __future__ import annotations

import random
import socket
from contextlib import suppress

#: Below what Linux gives to outgoing connections, so that no client of another test takes one between two starts of a server.
_PORTS = range(20_000, 30_000)


def free_port() -> int:
    """A port of the loopback address that nobody uses just now."""
    dice = random.SystemRandom()
    while True:
        port = dice.choice(_PORTS)
        with suppress(OSError), socket.socket() as probe:
            probe.bind(("127.0.0.1", port))
            return port
