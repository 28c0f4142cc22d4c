"""How many connections are open at all, also those that have not said anything yet."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass

from websockets.asyncio.server import ServerConnection


@dataclass(slots=True)
class Crowd:
    """Connections that are open now, and how many may be."""

    limit: int
    count: int = 0


def counted_in(crowd: Crowd) -> type[ServerConnection]:
    """Connections that count themselves; one too many is cut at once, before it costs anything."""

    class CountedConnection(ServerConnection):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            super().connection_made(transport)
            crowd.count += 1
            if crowd.count > crowd.limit:
                self.transport.abort()

        def connection_lost(self, exc: Exception | None) -> None:
            crowd.count -= 1
            super().connection_lost(exc)

    return CountedConnection
