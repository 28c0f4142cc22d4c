"""Which requests may reach the server: by Host, by Origin, by how many there are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from urllib.parse import urlsplit

from egotouch_sdk.server.close_code import Close, CloseCode

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})


@dataclass(frozen=True, slots=True)
class Door:
    """Names under which the server may be asked for, and pages that may connect besides its own.

    Checking the Host header keeps DNS rebinding out: a foreign page whose name points at this machine still sends its own name.
    Pages of this very server and of this machine's loopback addresses may connect, and those of `origins` (`https://example.org`).
    Programs send no Origin and are asked for the token only, where there is one.
    """

    hosts: frozenset[str]
    origins: frozenset[str] = frozenset()

    @classmethod
    def of(cls, hosts: Iterable[str], origins: Iterable[str] = ()) -> Door:
        """The door of a server that is known by `hosts` and, on its own machine, by the loopback names."""
        return cls(LOOPBACK_NAMES | {host.lower() for host in hosts}, frozenset(origin.rstrip("/").lower() for origin in origins))

    def refusal(self, headers: Mapping[str, str]) -> Close | None:
        """Why a request with these headers may not come in; None when it may."""
        host = headers.get("Host", "")
        if _name(f"//{host}") not in self.hosts:
            return Close(CloseCode.WRONG_HOST, "the Host header names another machine")
        origin = headers.get("Origin")
        if origin is not None and not self._is_welcome(origin.lower(), host.lower()):
            return Close(CloseCode.WRONG_ORIGIN, "pages from there may not connect; see --allow-origin")
        return None

    def _is_welcome(self, origin: str, host: str) -> bool:
        return origin in self.origins or _name(origin) in LOOPBACK_NAMES or origin in {f"http://{host}", f"https://{host}"}


def _name(url: str) -> str:
    try:
        return (urlsplit(url).hostname or "").lower()
    except ValueError:
        return ""
