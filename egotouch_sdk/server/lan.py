"""What a server on the local network needs: TLS, a token, a pairing code, and something to scan."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path
from ssl import SSLContext

from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.server.access import TokenAccess
from egotouch_sdk.server.certificate import server_certificate
from egotouch_sdk.server.network import host_names, lan_addresses
from egotouch_sdk.server.secret_store import TOKEN_FILE, load_token, new_pairing_code


@dataclass(frozen=True, slots=True)
class Lan:
    """How this machine is known on the network, and what proves it."""

    addresses: tuple[str, ...]
    names: tuple[str, ...]
    tls: SSLContext
    fingerprint: str
    token: str

    @classmethod
    def prepare(cls, folder: Path, token_file: Path | None = None, more_names: Collection[str] = ()) -> Lan:
        """Find the addresses, and make or load certificate and token in `folder`.

        Raises `ConfigError` when this machine is on no network, `MissingExtraError` without the extra `lan`.
        """
        addresses = lan_addresses()
        if not addresses:
            raise ConfigError("this machine has no address on a network", hint="Connect it, or serve without --lan")
        names = (*host_names(), *more_names)
        tls, fingerprint = server_certificate(folder, {*addresses, *names, "localhost", "127.0.0.1"})
        return cls(addresses, names, tls, fingerprint, load_token(token_file or folder / TOKEN_FILE))

    def access(self, show_code: Callable[[str], None]) -> TokenAccess:
        """Asks clients for the token or for a pairing code; `show_code` shows each code to the person at the server."""
        return TokenAccess(self.token, new_pairing_code, show_code)

    def pairing_url(self, port: int, code: str, page: str = "") -> str:
        """What to open on the headset: code and fingerprint are in the fragment, which browsers keep to themselves."""
        return f"{page_url('https', self.addresses[0], port)}{page}#c={code}&fp={self.fingerprint}"


def page_url(scheme: str, host: str, port: int) -> str:
    """The server's page; an IPv6 address in its brackets."""
    return f"{scheme}://{f'[{host}]' if ':' in host else host}:{port}/"


def qr_code(text: str) -> str:
    """A QR code made of block characters, for a terminal; raises `MissingExtraError` without the extra `lan`."""
    from io import StringIO

    try:
        import segno
    except ImportError as error:
        raise MissingExtraError("a QR code in the terminal", "lan") from error
    out = StringIO()
    segno.make(text, error="l").terminal(out, compact=True, border=2)
    return out.getvalue()
