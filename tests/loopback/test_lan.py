"""The server as `--lan` runs it: TLS with its own certificate, a token, a pairing code, and what a stranger gets."""

from __future__ import annotations

import asyncio
import os
import re
import signal
import socket
import ssl
import stat
import subprocess
import sys
from collections.abc import AsyncIterator, Coroutine
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidMessage
from websockets.typing import Subprotocol

from egotouch_sdk.server import CloseCode, EventServer
from egotouch_sdk.server.access import PAIRING_NS, PAIRING_TRIES, Access, Admission, TokenAccess
from egotouch_sdk.server.door import Door
from egotouch_sdk.server.network import host_names, lan_addresses
from egotouch_sdk.touch_event import EventType as E
from egotouch_sdk.wire.gen import egotouch_pb2 as pb
from tests.support.client_model import ClientModel
from tests.support.ports import free_port
from tests.support.socket_client import PATIENCE_S, SocketClient, SocketFinger, running_server

pytest.importorskip("cryptography", reason="needs the extra lan")
pytest.importorskip("segno", reason="needs the extra lan")

from egotouch_sdk.server.certificate import CERTIFICATE_FILE, KEY_FILE, server_certificate
from egotouch_sdk.server.secret_store import TOKEN_FILE, load_token

TAPS = "egotouch_sdk/assets/scripts/taps.yaml"
NAMES = ("127.0.0.1", "localhost")
CODE = "271828"
WRONG_CODE = "314159"
WRONG_TOKEN = "0" * 32
SUBPROTOCOL = Subprotocol("egotouch.v1.pb")


def run(test: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(test, 120))


def trust(folder: Path) -> ssl.SSLContext:
    """Trusts this server's certificate and nothing else, by the strict rules that Python itself uses from 3.13 on."""
    context = ssl.create_default_context(cafile=folder / CERTIFICATE_FILE)
    context.verify_flags |= ssl.VERIFY_X509_STRICT
    return context


class LanClient(SocketClient):
    """A client that trusts the certificate in a folder."""

    def __init__(self, server: EventServer, folder: Path) -> None:
        super().__init__(server)
        self._tls = trust(folder)

    async def open(self, **options: Any) -> None:
        """Open the WebSocket over TLS and say nothing."""
        await super().open(ssl=self._tls, proxy=None, **options)

    async def refused(self, hello: pb.Hello | None = None, **options: Any) -> int:
        """The close code that a Hello gets."""
        await self.open(**options)
        if hello is not None:
            await self.send(pb.ClientMessage(hello=hello))
        return (await self.expect_closed())[0]


class LaterAccess:
    """The same decisions some time later."""

    def __init__(self, access: TokenAccess, later_ns: int) -> None:
        self.access = access
        self.later_ns = later_ns

    def admit(self, token: str, pairing_code: str, now_ns: int) -> Admission:
        """What the access decides then."""
        return self.access.admit(token, pairing_code, now_ns + self.later_ns)


@asynccontextmanager
async def lan_server(folder: Path, access: Access | None = None) -> AsyncIterator[EventServer]:
    """A server with the certificate and token in a folder, and one pairing code."""
    tls, _ = server_certificate(folder, NAMES)
    token = load_token(folder / TOKEN_FILE)
    access = access or TokenAccess(token, lambda: CODE)
    async with running_server(tls=tls, token=token, access=access, door=Door.of(NAMES)) as server:
        yield server


async def get(server: EventServer, folder: Path, path: str, *headers: bytes, host: str = "127.0.0.1") -> int:
    """The status of a plain HTTP request over TLS."""
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port, ssl=trust(folder))
    writer.write(b"\r\n".join((f"GET {path} HTTP/1.1\r\nHost: {host}:{server.port}".encode(), *headers, b"", b"")))
    async with asyncio.timeout(PATIENCE_S):
        answer = await reader.read()
    writer.close()
    await writer.wait_closed()
    return int(answer.split()[1])


# ------------------------------------------------------------------------------------------------------------ who may come in


def test_the_token_opens_and_nothing_else_does(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            token = load_token(tmp_path / TOKEN_FILE)
            client, finger = LanClient(server, tmp_path), SocketFinger(server)
            assert (await client.join(token=token)).token == "", "the token is not sent to who has it"
            for wrong in ("", WRONG_TOKEN, token[:-1], f"{token}0", token.upper() + "é"):
                assert await LanClient(server, tmp_path).refused(pb.Hello(token=wrong)) == CloseCode.WRONG_TOKEN
            finger.publish(E.HOVER_ENTER)
            finger.publish(E.DOWN)
            finger.publish(E.UP, E.CLICK)
            await client.hear(E.HOVER_ENTER, E.DOWN, E.UP, E.CLICK)

    run(test())


def test_a_client_that_does_not_know_the_certificate_sends_no_token(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path / "server") as server:
            server_certificate(tmp_path / "stranger", NAMES)
            with pytest.raises(ssl.SSLCertVerificationError):
                await LanClient(server, tmp_path / "stranger").join(token=load_token(tmp_path / "server" / TOKEN_FILE))
            await LanClient(server, tmp_path / "server").join(token=load_token(tmp_path / "server" / TOKEN_FILE))

    run(test())


def test_a_pairing_code_is_exchanged_for_the_token_once(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            token = (await LanClient(server, tmp_path).join(pairing_code=CODE)).token
            assert token == load_token(tmp_path / TOKEN_FILE)
            assert await LanClient(server, tmp_path).refused(pb.Hello(pairing_code=CODE)) == CloseCode.WRONG_TOKEN
            await LanClient(server, tmp_path).join(token=token)

    run(test())


def test_five_wrong_codes_lock_out_the_right_one_too_but_not_the_token(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            for _ in range(PAIRING_TRIES):
                assert await LanClient(server, tmp_path).refused(pb.Hello(pairing_code=WRONG_CODE)) == CloseCode.WRONG_TOKEN
            assert await LanClient(server, tmp_path).refused(pb.Hello(pairing_code=CODE)) == CloseCode.WRONG_TOKEN
            await LanClient(server, tmp_path).join(token=load_token(tmp_path / TOKEN_FILE))

    run(test())


def test_a_code_is_refused_once_two_minutes_are_over_and_the_new_one_works(tmp_path: Path) -> None:
    async def test() -> None:
        codes, shown = iter((CODE, WRONG_CODE)), list[str]()
        access = LaterAccess(TokenAccess(load_token(tmp_path / TOKEN_FILE), lambda: next(codes), shown.append), later_ns=0)
        async with lan_server(tmp_path, access) as server:
            assert await LanClient(server, tmp_path).refused(pb.Hello(pairing_code="000000")) == CloseCode.WRONG_TOKEN
            access.later_ns = PAIRING_NS
            assert await LanClient(server, tmp_path).refused(pb.Hello(pairing_code=CODE)) == CloseCode.WRONG_TOKEN
            assert shown == [CODE, WRONG_CODE]
            assert (await LanClient(server, tmp_path).join(pairing_code=WRONG_CODE)).token

    run(test())


# ------------------------------------------------------------------------------------------------------------ strangers


def test_pages_from_elsewhere_and_other_names_are_refused_even_with_the_token(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            hello = pb.Hello(token=load_token(tmp_path / TOKEN_FILE))
            for origin in ("https://evil.example", "null", f"https://127.0.0.1.evil.example:{server.port}"):
                assert await LanClient(server, tmp_path).refused(origin=origin) == CloseCode.WRONG_ORIGIN
            here: dict[str, Any]
            url, here = f"wss://evil.example:{server.port}/", {"host": "127.0.0.1", "port": server.port, "server_hostname": "127.0.0.1"}
            async with connect(url, ssl=trust(tmp_path), proxy=None, subprotocols=[SUBPROTOCOL], **here) as connection:
                await connection.wait_closed()
                assert connection.close_code == CloseCode.WRONG_HOST
            for path in ("/", "/healthz", "/metrics"):
                assert await get(server, tmp_path, path, host="evil.example") == 421
            own = LanClient(server, tmp_path)
            await own.open(origin=f"https://127.0.0.1:{server.port}")
            await own.send(pb.ClientMessage(hello=hello))
            assert (await own.receive()).HasField("welcome")

    run(test())


def test_a_client_without_tls_fails_and_harms_nobody(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            client, finger = LanClient(server, tmp_path), SocketFinger(server)
            await client.join(token=load_token(tmp_path / TOKEN_FILE))
            for _ in range(5):
                with pytest.raises((InvalidMessage, ConnectionError)):
                    await connect(f"ws://127.0.0.1:{server.port}/", proxy=None, open_timeout=PATIENCE_S, subprotocols=[SUBPROTOCOL])
            finger.publish(E.HOVER_ENTER)
            await client.hear(E.HOVER_ENTER)
            await client.catch_up()
            assert client.model.acted == []

    run(test())
    assert not [record for record in caplog.records if not record.name.startswith("websockets.client")]


def test_health_is_open_and_metrics_need_the_token(tmp_path: Path) -> None:
    async def test() -> None:
        async with lan_server(tmp_path) as server:
            token = load_token(tmp_path / TOKEN_FILE).encode()
            assert await get(server, tmp_path, "/healthz") == 200
            assert await get(server, tmp_path, "/metrics", b"Authorization: Bearer " + token) == 200
            for headers in (
                (),
                (b"Authorization: Bearer " + WRONG_TOKEN.encode(),),
                (b"Authorization: " + token,),
                (b"Authorization: \xff",),
            ):
                assert await get(server, tmp_path, "/metrics", *headers) == 401
            assert await get(server, tmp_path, f"/metrics?token={token.decode()}") == 401, "no secrets in addresses"

    run(test())


# ------------------------------------------------------------------------------------------------------------ the command


class LanCommand:
    """`egotouch serve taps.yaml --lan` in a process of its own, up to the pairing code."""

    def __init__(self, config: Path, port: int) -> None:
        self.config, self.port = config, port
        command = [sys.executable, "-m", "egotouch_sdk", "serve", TAPS, "--lan", "--host", "127.0.0.1", "--port", str(port)]
        environ = os.environ | {"EGOTOUCH_CONFIG": str(config), "PYTHONUNBUFFERED": "1", "PYTHONIOENCODING": "utf-8"}
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, encoding="utf-8", env=environ)
        self.said = ""
        assert self._process.stdout is not None
        while "or open" not in self.said:
            line = self._process.stdout.readline()
            assert line, self._process.communicate()[1]
            self.said += line

    def found(self, pattern: str) -> str:
        """What the command has printed here."""
        found = re.search(pattern, self.said, re.MULTILINE)
        assert found is not None, self.said
        return found[1]

    async def hello(self, **fields: Any) -> pb.Welcome | int:
        """The Welcome that a Hello gets, or the close code."""
        url = f"wss://127.0.0.1:{self.port}/"
        async with connect(url, ssl=trust(self.config), proxy=None, subprotocols=[SUBPROTOCOL], compression=None) as connection:
            await connection.send(ClientModel().hello(**fields).SerializeToString())
            try:
                async with asyncio.timeout(PATIENCE_S):
                    data = await connection.recv(decode=False)
            except ConnectionClosed:
                return connection.close_code or 0
            welcome: pb.Welcome = pb.ServerMessage.FromString(data).welcome
            return welcome

    def stop(self) -> tuple[int, str]:
        """Ctrl-C; the exit code and what it said on stderr."""
        self._process.send_signal(signal.SIGINT)
        rest, errors = self._process.communicate(timeout=60)
        self.said += rest
        return self._process.returncode, errors

    def kill(self) -> None:
        """End it whatever it is up to."""
        self._process.kill()
        self._process.communicate()


@pytest.mark.skipif(not lan_addresses(), reason="this machine is on no network")
def test_the_command_tells_its_code_once_and_its_token_never_and_keeps_both_token_and_certificate(tmp_path: Path) -> None:
    port = free_port()  # `--lan` wants one that can be opened in a firewall, so not 0
    config = tmp_path / "config"
    served = LanCommand(config, port)
    try:
        code, fingerprint = served.found(r"^  pairing    (\d{6})  "), served.found(r"^  SHA-256    ([0-9a-f]{64})  ")
        paired = asyncio.run(served.hello(pairing_code=code))
        assert isinstance(paired, pb.Welcome) and paired.token == load_token(config / TOKEN_FILE)
        assert isinstance(asyncio.run(served.hello(token=paired.token)), pb.Welcome)
        for wrong in ({"token": f"{paired.token}0"}, {"pairing_code": code}, {}):
            assert asyncio.run(served.hello(**wrong)) == CloseCode.WRONG_TOKEN
        assert served.stop() == (130, "egotouch: interrupted\n")
    finally:
        served.kill()
    shown = [line for line in served.said.splitlines() if code in line]
    assert [line.split()[:2] for line in shown] == [["pairing", code], ["or", "open"]]
    assert shown[1].partition("#")[2] == f"c={code}&fp={fingerprint}" and code not in shown[1].partition("#")[0]
    assert paired.token not in served.said

    kept = {path.name: path.read_bytes() for path in config.iterdir()}
    assert set(kept) == {CERTIFICATE_FILE, KEY_FILE, TOKEN_FILE}
    assert {stat.S_IMODE(path.stat().st_mode) for path in config.iterdir()} == {0o600} and stat.S_IMODE(config.stat().st_mode) == 0o700
    again = LanCommand(config, port)
    try:
        assert again.found(r"^  SHA-256    ([0-9a-f]{64})  ") == fingerprint
        assert isinstance(asyncio.run(again.hello(token=paired.token)), pb.Welcome)
    finally:
        again.kill()
    assert {path.name: path.read_bytes() for path in config.iterdir()} == kept
    assert_names_this_machine(kept[CERTIFICATE_FILE])


def assert_names_this_machine(pem: bytes) -> None:
    """The certificate holds every address and name under which headsets may open the server, and the loopback ones."""
    from cryptography import x509

    names = x509.load_pem_x509_certificate(pem).extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert {str(address) for address in names.get_values_for_type(x509.IPAddress)} == {*lan_addresses(), "127.0.0.1"}
    assert set(names.get_values_for_type(x509.DNSName)) == {*host_names(), "localhost"}
    assert f"{socket.gethostname().partition('.')[0].lower()}.local" in names.get_values_for_type(x509.DNSName)


# ------------------------------------------------------------------------------------------------------------ mDNS


def test_apps_find_the_server_by_mdns_and_see_it_go() -> None:
    zeroconf = pytest.importorskip("zeroconf", reason="needs the extra mdns")
    from zeroconf.asyncio import AsyncServiceBrowser, AsyncZeroconf

    from egotouch_sdk.server.announce import SERVICE, announced

    async def test() -> None:
        fingerprint, seen = "ab" * 32, asyncio.Queue[tuple[str, Any]]()

        def note(name: str, state_change: Any, **_: Any) -> None:
            seen.put_nowait((name, state_change))

        try:
            browsing = AsyncZeroconf(interfaces=["127.0.0.1"])
        except OSError as error:
            pytest.skip(f"multicast does not work on this machine's loopback interface: {error}")
        browser = AsyncServiceBrowser(browsing.zeroconf, SERVICE, handlers=[note])
        try:
            async with announced("egotouch-test", ["127.0.0.1"], 8765, fingerprint):
                name, change = await asyncio.wait_for(seen.get(), PATIENCE_S)
                assert (name, change) == (f"egotouch-test.{SERVICE}", zeroconf.ServiceStateChange.Added)
                info = await browsing.async_get_service_info(SERVICE, name)
                assert (info.parsed_addresses(), info.port, info.server) == (["127.0.0.1"], 8765, "egotouch-test.local.")
                assert info.properties == {b"v": b"1", b"fp": fingerprint.encode(), b"path": b"/"}
            name, change = await asyncio.wait_for(seen.get(), PATIENCE_S)
            assert (name, change) == (f"egotouch-test.{SERVICE}", zeroconf.ServiceStateChange.Removed)
        finally:
            await browser.async_cancel()
            await browsing.async_close()

    run(test())
