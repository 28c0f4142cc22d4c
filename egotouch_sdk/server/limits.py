"""Every number that bounds what clients may do and how long anything waits."""

from __future__ import annotations

from dataclasses import dataclass, fields

from egotouch_sdk.errors import ConfigError

MILLISECOND_NS = 1_000_000
SECOND_NS = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """The server's limits; all must be above 0. Raises `ConfigError` otherwise.

    `max_clients` connections have passed or are still to pass the Hello, which must come within `hello_timeout_ns`.
    A message has at most `max_message_bytes`; `commands_per_s` of them may come per second on average and `command_burst` at once.
    What a client pushes as the source counts apart: `pushes_per_s` frames, hands or simulated fingers and `push_bytes_per_s`, and up
    to `push_burst_s` seconds' worth of them at once, as after a hitch of the network.
    The server is silent for `heartbeat_ns` at most, for `active_heartbeat_ns` while something touches: a client that hears nothing
    for 300 ms cancels its contacts.
    An edge that waited longer than `input_ttl_ns` must not act any more.
    What waits for a client is bounded by `outbox_messages` and `outbox_bytes`, and the oldest may wait `patience_ns`; a client
    beyond that is closed.
    The journal keeps `journal_edges` edges of the last `journal_ns`, for clients that come back.
    Sources: time to live, ring, queue and command limits are our choice after Centrifugo's (1 MiB queue, recovery of up to 300).
    """

    max_clients: int = 32
    hello_timeout_ns: int = 5 * SECOND_NS
    max_message_bytes: int = 1 << 20
    commands_per_s: int = 20
    command_burst: int = 40
    pushes_per_s: int = 250
    push_bytes_per_s: int = 16 << 20
    push_burst_s: int = 2
    heartbeat_ns: int = 2 * SECOND_NS
    active_heartbeat_ns: int = 100 * MILLISECOND_NS
    input_ttl_ns: int = 250 * MILLISECOND_NS
    outbox_messages: int = 1024
    outbox_bytes: int = 1 << 20
    patience_ns: int = 5 * SECOND_NS
    journal_edges: int = 512
    journal_ns: int = 10 * SECOND_NS

    def __post_init__(self) -> None:
        for field in fields(self):
            if getattr(self, field.name) < 1:
                raise ConfigError(f"Limits.{field.name} is {getattr(self, field.name)}", hint="Give a number above 0")
