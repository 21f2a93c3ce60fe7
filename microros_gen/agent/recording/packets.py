# SPDX-License-Identifier: Apache-2.0
"""XRCE messages as IP packets, so that any program for network traffic shows them.

Each message is one UDP datagram (RFC 768) over IPv4 (RFC 791) or IPv6 (RFC 8200), whatever carried it. In front is an
Ethernet header with addresses 0, as on Linux's loopback interface: libpcap 1.10.3 reads no file in which several
interfaces have raw IP.

- UDP and TCP: with the addresses and ports of both sides. The length in front of a message on TCP is left out.
- serial lines and CAN FD: over IPv6 in a local prefix (RFC 4193, 3.1) with the letters XRCE, at port 8888. The agent
  has `…::1:0:0`; a client has `…::N`, where N is its address on the line or its identifier on the bus.

An IPv4 or UDP packet of more than 65,535 bytes cannot say its length, which is then 0.
"""

from __future__ import annotations

import ipaddress
import struct

from microros_gen.records import dataclass

PORT = 8888
"""UDP port of both sides where the transport has none."""
PREFIX = ipaddress.IPv6Address("fd58:5243:4500::")
AGENT = PREFIX + (1 << 32)
"""Address of the agent on lines and buses."""

_NO_ADDRESSES = bytes(12)
_ETHERTYPES = {4: b"\x08\x00", 6: b"\x86\xdd"}
_VLAN = b"\x81\x00"
_UDP = 17
_HOPS = 64
_HEADER4, _HEADER6, _HEADER_UDP = 20, 40, 8

Address = ipaddress.IPv4Address | ipaddress.IPv6Address


@dataclass(frozen=True)
class Endpoint:
    """An IP address and a UDP port."""

    address: Address
    port: int

    def __str__(self) -> str:
        return f"[{self.address}]:{self.port}" if self.address.version == 6 else f"{self.address}:{self.port}"


@dataclass(frozen=True)
class Datagram:
    """A message with its source and destination."""

    source: Endpoint
    destination: Endpoint
    message: bytes


def endpoint(text: str) -> Endpoint:
    """Return what `host:port` or `[host]:port` says; the zone of an address is left out. Raises ValueError."""
    host, _, port = text.rpartition(":")
    return Endpoint(ipaddress.ip_address(host.strip("[]").partition("%")[0]), int(port))


def line_client(number: int) -> Endpoint:
    """Return the place of the client with an address on a line, or an identifier on a bus."""
    return Endpoint(PREFIX + number, PORT)


def line_agent() -> Endpoint:
    """Return the place of the agent on a line or a bus."""
    return Endpoint(AGENT, PORT)


def line_number(place: Endpoint) -> int:
    """Return the address or identifier of a client that is at `place`."""
    return int(place.address) & 0xFFFF_FFFF


def encode(datagram: Datagram) -> bytes:
    """Return the Ethernet frame, without its checksum, as files have it."""
    return _NO_ADDRESSES + _ETHERTYPES[datagram.source.address.version] + _ip(datagram)


def _ip(datagram: Datagram) -> bytes:
    source, destination = datagram.source, datagram.destination
    size = len(datagram.message) + _HEADER_UDP
    udp = struct.pack(">HHHH", source.port, destination.port, _length(size), 0)
    if source.address.version == 4:
        head = struct.pack(">BBHHHBBH", 0x45, 0, _length(size + _HEADER4), 0, 0x4000, _HOPS, _UDP, 0)
        places = source.address.packed + destination.address.packed
        return head[:10] + _checksum(head + places) + places + udp + datagram.message
    places = source.address.packed + destination.address.packed
    head = struct.pack(">IHBB", 0x6000_0000, _length(size), _UDP, _HOPS)
    summed = _checksum(places + struct.pack(">II", size, _UDP) + udp + datagram.message) or b""
    return head + places + udp[:6] + (summed if any(summed) else b"\xff\xff") + datagram.message


def decode(frame: bytes) -> Datagram | None:
    """Return the message in an Ethernet frame; None: it holds no UDP datagram, or only a part of one."""
    at = 18 if frame[12:14] == _VLAN else 14
    return _of_ip(frame[at:]) if frame[at - 2 : at] in _ETHERTYPES.values() else None


def _of_ip(raw: bytes) -> Datagram | None:
    version = raw[0] >> 4 if raw else 0
    if (
        version == 4
        and len(raw) >= _HEADER4
        and raw[9] == _UDP
        and not int.from_bytes(raw[6:8], "big") & 0x3FFF
    ):
        at, places, wide = (raw[0] & 15) * 4, 12, 4
    elif version == 6 and len(raw) >= _HEADER6 and raw[6] == _UDP:
        at, places, wide = _HEADER6, 8, 16
    else:
        return None
    if len(raw) < at + _HEADER_UDP:
        return None
    from_port, to_port, size = struct.unpack_from(">HHH", raw, at)
    end = at + size if size else len(raw)
    if size and not _HEADER_UDP <= size <= len(raw) - at:
        return None
    first, second = raw[places : places + wide], raw[places + wide : places + 2 * wide]
    return Datagram(
        Endpoint(ipaddress.ip_address(first), from_port),
        Endpoint(ipaddress.ip_address(second), to_port),
        raw[at + _HEADER_UDP : end],
    )


def _length(size: int) -> int:
    return size if size <= 0xFFFF else 0


def _checksum(data: bytes) -> bytes:
    """Return the Internet checksum (RFC 1071): the complement of a sum of 16-bit words modulo 65,535."""
    padded = data + bytes(len(data) & 1)
    return (0xFFFF - int.from_bytes(padded, "big") % 0xFFFF).to_bytes(2, "big")
