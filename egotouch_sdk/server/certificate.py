"""A self-signed certificate for the local network: ECDSA P-256, made on first use and kept."""

from __future__ import annotations

import ssl
from collections.abc import Collection
from datetime import UTC, datetime, timedelta
from ipaddress import ip_address
from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.errors import MissingExtraError
from egotouch_sdk.server.secret_store import read_secret, write_secret

if TYPE_CHECKING:
    from cryptography.x509 import Certificate, GeneralName

KEY_FILE = "key.pem"
CERTIFICATE_FILE = "certificate.pem"
#: The longest that Apple's platforms accept (support.apple.com/HT210176).
LIFETIME = timedelta(days=825)
#: Made anew when it ends sooner than this.
RENEW_BEFORE = timedelta(days=30)


def server_certificate(folder: Path, names: Collection[str], now: datetime | None = None) -> tuple[ssl.SSLContext, str]:
    """TLS for a server known under `names` (addresses and host names), and the SHA-256 of its certificate in hexadecimal.

    Key and certificate are kept in `folder`, readable by their owner only. The certificate is made anew, with the same key, when it
    lacks a name or ends soon. Raises `MissingExtraError` without the extra `lan`, `ConfigError` when others can read the key.
    """
    try:
        from cryptography import x509
        from cryptography.hazmat.primitives import hashes
        from cryptography.hazmat.primitives.serialization import Encoding
    except ImportError as error:
        raise MissingExtraError("a server on the local network", "lan") from error
    now = now or datetime.now(UTC)
    key_path, certificate_path = folder / KEY_FILE, folder / CERTIFICATE_FILE
    if not key_path.exists():
        certificate_path.unlink(missing_ok=True)
        write_secret(key_path, _new_key())
    key = read_secret(key_path)
    kept = x509.load_pem_x509_certificate(certificate_path.read_bytes()) if certificate_path.exists() else None
    if kept is None or not _fits(kept, names, now):
        kept = _new_certificate(key, names, now)
        write_secret(certificate_path, kept.public_bytes(Encoding.PEM))
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.load_cert_chain(certificate_path, key_path)
    return context, kept.fingerprint(hashes.SHA256()).hex()


def _new_key() -> bytes:
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

    pem: bytes = ec.generate_private_key(ec.SECP256R1()).private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    return pem


def _new_certificate(key_pem: bytes, names: Collection[str], now: datetime) -> Certificate:
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    key = load_pem_private_key(key_pem, None)
    assert isinstance(key, ec.EllipticCurvePrivateKey)
    subject = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, "egotouch")])
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(hours=1))
        .not_valid_after(now + LIFETIME)
        .add_extension(x509.SubjectAlternativeName([_general_name(name) for name in sorted(names)]), critical=False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(x509.ExtendedKeyUsage([x509.ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        .sign(key, hashes.SHA256())
    )


def _fits(certificate: Certificate, names: Collection[str], now: datetime) -> bool:
    from cryptography import x509

    covered = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    return {_general_name(name) for name in names} <= set(covered) and certificate.not_valid_after_utc - now > RENEW_BEFORE


def _general_name(name: str) -> GeneralName:
    from cryptography import x509

    try:
        return x509.IPAddress(ip_address(name))
    except ValueError:
        return x509.DNSName(name)
