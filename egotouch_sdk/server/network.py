"""This machine's own names and addresses."""

from __future__ import annotations

import contextlib
import socket
import struct
from ipaddress import ip_address

_SIOCGIFADDR = 0x8915
#: Reserved for documentation (RFC 5737, RFC 3849): asking for the way there sends nothing and tells the address of the main interface.
_FAR_AWAY = ((socket.AF_INET, "192.0.2.1"), (socket.AF_INET6, "2001:db8::1"))


def host_names() -> tuple[str, ...]:
    """This machine's name, and the one under which mDNS knows it."""
    name = socket.gethostname().partition(".")[0].lower()
    return (name, f"{name}.local") if name else ()


def lan_addresses() -> tuple[str, ...]:
    """Addresses under which other machines on the network may reach this one; that of the main interface first."""
    found = [*_main_addresses(), *_interface_addresses(), *_resolved_addresses()]
    usable = (address for address in found if not (ip_address(address).is_loopback or ip_address(address).is_link_local))
    return tuple(dict.fromkeys(usable))


def _main_addresses() -> list[str]:
    addresses = []
    for family, target in _FAR_AWAY:
        with contextlib.suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((target, 9))
            addresses.append(str(probe.getsockname()[0]))
    return addresses


def _interface_addresses() -> list[str]:
    """IPv4 addresses of all interfaces; only Linux tells them this way."""
    try:
        from fcntl import ioctl
    except ImportError:
        return []
    addresses = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        for _, name in socket.if_nameindex():
            with contextlib.suppress(OSError):
                answer = ioctl(probe.fileno(), _SIOCGIFADDR, struct.pack("256s", name.encode()[:15]))
                addresses.append(socket.inet_ntoa(answer[20:24]))
    return addresses


def _resolved_addresses() -> list[str]:
    with contextlib.suppress(OSError):
        return [str(entry[4][0]).partition("%")[0] for entry in socket.getaddrinfo(socket.gethostname(), None)]
    return []
