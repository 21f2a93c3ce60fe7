# SPDX-License-Identifier: Apache-2.0
"""The addresses of this machine's interfaces, as reported by Linux (netdevice(7), ipv6(7))."""

from __future__ import annotations

import fcntl
import ipaddress
import socket
import struct
from pathlib import Path

from microros_gen.records import dataclass

Address = ipaddress.IPv4Address | ipaddress.IPv6Address

_SIOCGIFADDR = 0x8915
_NAME_BYTES = 16
_LINK_LOCAL = 0x20  # scope in if_inet6: such an address means nothing without the interface of the peer
_IF_INET6 = Path("/proc/net/if_inet6")


@dataclass(frozen=True)
class OwnAddress:
    """An address of this machine and the index of its interface."""

    address: Address
    interface: int


def own_addresses() -> tuple[OwnAddress, ...]:
    """Return the addresses of all interfaces, IPv4 first: the first IPv4 address of each, and every IPv6 address.

    IPv6 addresses that are valid on one link only are left out, as are those that cannot be read.
    """
    return (*_ipv4(), *_ipv6())


def parse_address(text: str) -> Address:
    """Return the address in `text`, also with a zone (`fe80::1%eth0`)."""
    return ipaddress.ip_address(text.partition("%")[0])


def host_of(address: str) -> str:
    """Return the key of the host at an address: for IPv6 its network of 64 bits, in which it may choose addresses."""
    if ":" not in address:
        return address
    return str(ipaddress.IPv6Network((address.partition("%")[0], 64), strict=False))


def _ipv4() -> list[OwnAddress]:
    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as queried:
        for index, name in socket.if_nameindex():
            request = struct.pack("256s", name.encode()[: _NAME_BYTES - 1])
            try:
                answer = fcntl.ioctl(queried, _SIOCGIFADDR, request)
            except OSError:
                continue  # it has none
            found.append(OwnAddress(ipaddress.IPv4Address(answer[20:24]), index))
    return found


def _ipv6() -> list[OwnAddress]:
    try:
        lines = _IF_INET6.read_text(encoding="ascii").splitlines()
    except OSError:
        return []
    found = []
    for line in lines:
        digits, index, _, scope, *_ = line.split()
        if int(scope, 16) != _LINK_LOCAL:
            found.append(OwnAddress(ipaddress.IPv6Address(int(digits, 16)), int(index, 16)))
    return found
