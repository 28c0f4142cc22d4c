"""Why a connection ends, and whether the client should come back."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class CloseCode(IntEnum):
    """WebSocket close codes of `egotouch.v1`; 4000 to 4099 mean "reconnect", everything else here means "do not".

    Besides these a connection may end with the codes of RFC 6455 that the WebSocket layer itself sends: 1000 after the client's own
    close, 1002 for bytes that are no WebSocket frames, 1007 for text that is not UTF-8, 1011 when the client stopped answering pings.
    """

    SERVER_STOPPING = 4001
    """The server ends; all contacts were cancelled."""
    TOO_SLOW = 4008
    """More waits for the client than the server keeps for it."""
    SERVER_ERROR = 4011
    """A defect of the server met this connection only."""
    WRONG_VERSION = 4400
    """None of the client's subprotocols is `egotouch.v1.pb` or `egotouch.v1.json`."""
    WRONG_TOKEN = 4401
    """Token or pairing code are missing, wrong or used up."""
    WRONG_ORIGIN = 4403
    """The page that opened the connection comes from somewhere else."""
    WRONG_ORDER = 4405
    """The first message was no Hello, or a second Hello came."""
    HELLO_TIMEOUT = 4408
    """No Hello within 5 seconds."""
    TOO_MANY_CLIENTS = 4409
    """The server has as many clients as it takes."""
    WRONG_HOST = 4421
    """The Host header names another machine (DNS rebinding)."""
    MALFORMED = 4422
    """A message that is no ClientMessage, or a value in it that makes no sense."""
    TOO_MANY_COMMANDS = 4429
    """More commands per second than the server takes."""
    TOO_LARGE = 1009
    """A message over 1 MiB; RFC 6455 has its own code for this."""

    @property
    def reconnect(self) -> bool:
        """True when the same client may succeed if it tries again, with growing pauses."""
        return 4000 <= self <= 4099


@dataclass(frozen=True, slots=True)
class Close:
    """The end of one connection: a code, and words for the developer (at most 123 bytes, as WebSocket allows)."""

    code: CloseCode
    reason: str = ""

    def __post_init__(self) -> None:
        if len(self.reason.encode()) > 123:
            raise ValueError(f"close reason is longer than 123 bytes: {self.reason}")
