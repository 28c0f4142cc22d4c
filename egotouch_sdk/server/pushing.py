"""Clients as the source: what takes the frames, hands or fingers that they push."""

from __future__ import annotations

from abc import abstractmethod
from typing import Protocol

from egotouch_sdk.simulator.live_source import LiveSource
from egotouch_sdk.wire.gen import egotouch_pb2 as pb

Pushed = pb.ClientFrame | pb.ClientHands | pb.SimulatedPointers


class PushTarget(Protocol):
    """Takes what clients push, on the event loop's thread; it must not wait, and keeps the newest only."""

    @property
    @abstractmethod
    def kinds(self) -> frozenset[str]:
        """The bodies of a ClientMessage that it takes: "frame", "hands", "simulated"."""

    @abstractmethod
    def take(self, client: object, pushed: Pushed, now_ns: int) -> tuple[pb.Warning, ...]:
        """Take what `client` pushed, and say what it should know; `ProtocolError` for values that make no sense closes its connection."""

    @abstractmethod
    def leave(self, client: object) -> None:
        """`client` has gone."""


class SimulatorTarget:
    """Plays the fingers of simulator pages on a live simulator."""

    kinds = frozenset({"simulated"})

    def __init__(self, source: LiveSource) -> None:
        self._source = source

    def take(self, client: object, pushed: Pushed, now_ns: int) -> tuple[pb.Warning, ...]:
        """All fingers that one page plays now."""
        del now_ns
        if isinstance(pushed, pb.SimulatedPointers):
            self._source.play(client, pushed)
        return ()

    def leave(self, client: object) -> None:
        """The page has gone; what it touched is cancelled."""
        self._source.leave(client)
