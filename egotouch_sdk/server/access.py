"""Who may connect: nobody is asked, a token, or a six-digit code that is exchanged for the token."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from hmac import compare_digest
from typing import Protocol

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.server.limits import SECOND_NS

#: How long a pairing code lives and how many wrong ones it survives; a new one comes at most once in that time, so that guessing
#: one in a million takes months (adb's wireless pairing has the same two ideas; the numbers are our choice).
PAIRING_NS = 120 * SECOND_NS
PAIRING_TRIES = 5
#: 128 bits in hexadecimal.
MIN_TOKEN_CHARACTERS = 32


@dataclass(frozen=True, slots=True)
class Admission:
    """Whether a client may come in, and the token to hand to it when it had only a code."""

    admitted: bool
    token: str = ""


class Access(Protocol):
    """Decides on a client by what its Hello says."""

    @abstractmethod
    def admit(self, token: str, pairing_code: str, now_ns: int) -> Admission:
        """Whether this client may come in."""


class OpenAccess:
    """Everybody who can reach the server may come in; only for loopback."""

    def admit(self, token: str, pairing_code: str, now_ns: int) -> Admission:
        """Always yes."""
        del token, pairing_code, now_ns
        return Admission(True)


class TokenAccess:
    """Only clients with the token may come in, or with the pairing code while it lasts.

    `new_code` makes six digits; `announce` shows each to the person at the server. Without `new_code` there is no pairing.
    Raises `ConfigError` for a token under 128 bits.
    """

    def __init__(self, token: str, new_code: Callable[[], str] | None = None, announce: Callable[[str], None] | None = None) -> None:
        if len(token) < MIN_TOKEN_CHARACTERS:
            raise ConfigError(
                f"the token has {len(token)} characters, need at least {MIN_TOKEN_CHARACTERS}",
                hint="Make one with: python -c 'import secrets; print(secrets.token_hex(16))'",
            )
        self._token = token
        self._new_code = new_code
        self._announce = announce
        self._code = ""
        self._made_ns: int | None = None
        self._tries_left = 0

    def offer_code(self, now_ns: int) -> str:
        """The code that is valid now; a new one when the last is used up and old enough. Empty when there is none."""
        if self._new_code is None:
            return ""
        if self._made_ns is None or now_ns - self._made_ns >= PAIRING_NS:
            self._code, self._made_ns, self._tries_left = self._new_code(), now_ns, PAIRING_TRIES
            if self._announce:
                self._announce(self._code)
        return self._code if self._tries_left > 0 else ""

    def admit(self, token: str, pairing_code: str, now_ns: int) -> Admission:
        """Whether the token is right, or the code. A client that asks with an old code makes the server show a new one."""
        if token:
            return Admission(compare_digest(token.encode(), self._token.encode()))
        if not pairing_code:
            return Admission(False)
        code = self.offer_code(now_ns)
        if not code:
            return Admission(False)
        if compare_digest(pairing_code.encode(), code.encode()):
            self._tries_left = 0
            return Admission(True, self._token)
        self._tries_left -= 1
        return Admission(False)
