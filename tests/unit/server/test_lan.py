from __future__ import annotations

import stat
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from cryptography import x509

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.server.certificate import CERTIFICATE_FILE, KEY_FILE, LIFETIME, server_certificate
from egotouch_sdk.server.door import Door
from egotouch_sdk.server.lan import Lan, page_url, qr_code
from egotouch_sdk.server.network import host_names, lan_addresses
from egotouch_sdk.server.pages import Pages
from egotouch_sdk.server.secret_store import config_folder, load_token, new_pairing_code

NAMES = ("192.168.1.5", "fd00::5", "laptop", "laptop.local")
NOW = datetime(2026, 5, 1, tzinfo=UTC)


def certificate_in(folder: Path) -> x509.Certificate:
    return x509.load_pem_x509_certificate((folder / CERTIFICATE_FILE).read_bytes())


def test_the_certificate_names_every_address_and_is_kept(tmp_path: Path) -> None:
    _, fingerprint = server_certificate(tmp_path / "new", NAMES, NOW)
    names = certificate_in(tmp_path / "new").extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert {str(name.value) for name in names} == set(NAMES)
    _, again = server_certificate(tmp_path / "new", NAMES[:2], NOW)
    assert again == fingerprint and len(fingerprint) == 64


@pytest.mark.parametrize(("names", "later"), [((*NAMES, "10.0.0.7"), timedelta(0)), (NAMES, LIFETIME - timedelta(days=20))])
def test_a_certificate_that_no_longer_fits_is_made_anew_with_the_same_key(tmp_path: Path, names: tuple[str, ...], later: timedelta) -> None:
    server_certificate(tmp_path, NAMES, NOW)
    before = certificate_in(tmp_path)
    server_certificate(tmp_path, names, NOW + later)
    after = certificate_in(tmp_path)
    assert before != after and before.public_key() == after.public_key()


def test_a_lost_key_gets_a_new_certificate(tmp_path: Path) -> None:
    _, before = server_certificate(tmp_path, NAMES, NOW)
    (tmp_path / KEY_FILE).unlink()
    _, after = server_certificate(tmp_path, NAMES, NOW)
    assert before != after


def test_only_the_owner_can_read_what_is_kept(tmp_path: Path) -> None:
    folder = tmp_path / "egotouch"
    server_certificate(folder, NAMES, NOW)
    token = load_token(folder / "token")
    assert len(bytes.fromhex(token)) == 16 and load_token(folder / "token") == token
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert {stat.S_IMODE(path.stat().st_mode) for path in folder.iterdir()} == {0o600}


def test_a_token_that_others_can_read_is_refused(tmp_path: Path) -> None:
    load_token(tmp_path / "token")
    (tmp_path / "token").chmod(0o644)
    with pytest.raises(ConfigError, match="chmod 600"):
        load_token(tmp_path / "token")


def test_a_short_token_is_refused(tmp_path: Path) -> None:
    (tmp_path / "token").write_text("1234")
    (tmp_path / "token").chmod(0o600)
    with pytest.raises(ConfigError, match="too short"):
        load_token(tmp_path / "token")


def test_the_pairing_address_hides_its_secrets_in_the_fragment(tmp_path: Path) -> None:
    context, fingerprint = server_certificate(tmp_path, NAMES, NOW)
    lan = Lan(("fd00::5",), ("laptop",), context, fingerprint, "0" * 32)
    url = lan.pairing_url(8765, "123456")
    address, _, fragment = url.partition("#")
    assert address == "https://[fd00::5]:8765/" and fragment == f"c=123456&fp={fingerprint}"
    assert len(qr_code(url).splitlines()) > 10


def test_codes_are_six_digits_that_differ() -> None:
    codes = {new_pairing_code() for _ in range(50)}
    assert len(codes) > 40 and all(len(code) == 6 and code.isdigit() for code in codes)


@pytest.mark.parametrize(
    ("environ", "folder"),
    [
        ({}, "/home/me/.config/egotouch"),
        ({"XDG_CONFIG_HOME": "/settings"}, "/settings/egotouch"),
        ({"EGOTOUCH_CONFIG": "/mine", "XDG_CONFIG_HOME": "/settings"}, "/mine"),
    ],
)
def test_where_things_are_kept(environ: dict[str, str], folder: str) -> None:
    assert config_folder(environ, Path("/home/me")) == Path(folder)


def test_this_machine_knows_its_names_and_no_loopback_address() -> None:
    assert not {"127.0.0.1", "::1"} & set(lan_addresses())
    assert all(name == name.lower() for name in host_names())


@pytest.mark.parametrize(
    ("host", "origin", "code"),
    [
        ("127.0.0.1:8765", None, None),
        ("localhost", "http://localhost:5173", None),
        ("[::1]:8765", "http://[::1]:8765", None),
        ("192.168.1.5:8765", "https://192.168.1.5:8765", None),
        ("LAPTOP.local:8765", "https://laptop.local:8765", None),
        ("127.0.0.1", "https://app.example", None),
        ("192.168.1.5:8765", "https://192.168.1.5:9999", 4403),
        ("127.0.0.1", "https://app.example.evil", 4403),
        ("127.0.0.1", "https://localhost.evil", 4403),
        ("127.0.0.1", "null", 4403),
        ("127.0.0.1", "http://[", 4403),
        ("evil.example", None, 4421),
        ("127.0.0.1.evil.example", None, 4421),
        ("evil.example@127.0.0.1.evil", None, 4421),
        ("", None, 4421),
        ("[", None, 4421),
    ],
)
def test_the_door(host: str, origin: str | None, code: int | None) -> None:
    door = Door.of(("192.168.1.5", "laptop.local"), ("https://app.example/",))
    refusal = door.refusal({"Host": host} | ({"Origin": origin} if origin else {}))
    assert (refusal and refusal.code) == code


def test_addresses_as_people_read_them() -> None:
    assert page_url("http", "127.0.0.1", 80) == "http://127.0.0.1:80/"


def test_only_known_kinds_of_files_are_served(tmp_path: Path) -> None:
    for name in ("index.html", "deep/app.js", "notes.py", "key.pem"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(name)
    pages = Pages(tmp_path)
    assert {path for path in ("/", "/index.html", "/deep/app.js", "/notes.py", "/key.pem") if pages.find(path)} == {
        "/", "/index.html", "/deep/app.js"
    }  # fmt: skip
    assert Pages(None).find("/") is None


def test_a_folder_with_an_index_is_served_under_its_path_with_a_slash(tmp_path: Path) -> None:
    for name in ("app/index.html", "bare/app.js"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(name)
    pages = Pages(tmp_path)
    index = pages.find("/app/index.html")
    assert index is not None and pages.find("/app/?x=1") is index
    assert [pages.is_folder(path) for path in ("/app", "/app/", "/bare", "")] == [True, False, False, False]
    assert pages.find("/app") is None
