"""The server's token, key and certificate: made on first use, kept in a folder that only its owner can read."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Mapping
from pathlib import Path

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.server.access import MIN_TOKEN_CHARACTERS

FOLDER_MODE = 0o700
FILE_MODE = 0o600
TOKEN_FILE = "token"
TOKEN_BYTES = 16


def config_folder(environ: Mapping[str, str], home: Path) -> Path:
    """Where the command keeps what must outlive it: `EGOTOUCH_CONFIG`, else the platform's place for settings."""
    if given := environ.get("EGOTOUCH_CONFIG"):
        return Path(given)
    base = environ.get("APPDATA") or environ.get("XDG_CONFIG_HOME")
    return (Path(base) if base else home / ".config") / "egotouch"


def write_secret(path: Path, data: bytes) -> None:
    """Write a file that only its owner can read, whole or not at all."""
    path.parent.mkdir(mode=FOLDER_MODE, parents=True, exist_ok=True)
    part = path.with_suffix(".part")
    part.unlink(missing_ok=True)
    with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, FILE_MODE), "wb") as file:
        file.write(data)
    part.replace(path)


def read_secret(path: Path) -> bytes:
    """A file's content; `ConfigError` when others can read it too."""
    if os.name == "posix" and path.stat().st_mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise ConfigError(f"others on this machine can read {path}", hint=f"Run: chmod 600 {path}")
    return path.read_bytes()


def load_token(path: Path) -> str:
    """The token in a file; a new one of 128 bits is written there first when the file does not exist.

    Raises `ConfigError` for a file that others can read, or a token that is too short.
    """
    if not path.exists():
        write_secret(path, f"{secrets.token_hex(TOKEN_BYTES)}\n".encode())
    token = read_secret(path).decode(errors="replace").strip()
    if len(token) < MIN_TOKEN_CHARACTERS:
        raise ConfigError(f"the token in {path} is too short", hint="Delete the file and a new one is made")
    return token


def new_pairing_code() -> str:
    """Six random digits."""
    return f"{secrets.randbelow(1_000_000):06}"
