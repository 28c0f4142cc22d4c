"""Announcing the server on the local network by mDNS, for native apps; browsers cannot look there."""

from __future__ import annotations

from collections.abc import AsyncIterator, Sequence
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from ipaddress import ip_address

from egotouch_sdk.errors import MissingExtraError

SERVICE = "_egotouch._tcp.local."


def announced(name: str, addresses: Sequence[str], port: int, fingerprint: str) -> AbstractAsyncContextManager[None]:
    """Announce `name` while the block lasts: protocol version, the certificate's SHA-256 and the WebSocket's path, nothing secret.

    Raises `MissingExtraError` without the extra `mdns`.
    """
    try:
        from zeroconf import ServiceInfo
        from zeroconf.asyncio import AsyncZeroconf
    except ImportError as error:
        raise MissingExtraError("announcing the server on the network", "mdns") from error
    info = ServiceInfo(
        SERVICE,
        f"{name}.{SERVICE}",
        port=port,
        addresses=[ip_address(address).packed for address in addresses],
        properties={"v": "1", "fp": fingerprint, "path": "/"},
        server=f"{name}.local.",
    )

    @asynccontextmanager
    async def announcing() -> AsyncIterator[None]:
        zeroconf = AsyncZeroconf(interfaces=list(addresses))
        try:
            await zeroconf.async_register_service(info, allow_name_change=True)
            yield
        finally:
            await zeroconf.async_close()

    return announcing()
