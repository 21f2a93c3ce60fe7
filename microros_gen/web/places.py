# SPDX-License-Identifier: Apache-2.0
"""Addresses of HTTP servers."""

from __future__ import annotations

import ipaddress

from microros_gen.records import dataclass

LOOPBACK = "127.0.0.1"


@dataclass(frozen=True)
class Place:
    """A host name or IP address without brackets, and a port, 0 to 65,535; port 0: a free one."""

    host: str
    port: int

    @property
    def address(self) -> str:
        """The address as in a URL."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"


def read_place(text: str) -> Place | None:
    """Return the place that HOST:PORT, [IPV6]:PORT or PORT names, the last one on the loopback address; None: none."""
    host, _, port = text.rpartition(":")
    if not (port.isascii() and port.isdecimal()) or int(port) > 65_535 or text.startswith(":"):
        return None
    if host.startswith("[") and host.endswith("]"):
        host = host[1:-1]
        try:
            return Place(str(ipaddress.IPv6Address(host)), int(port))
        except ValueError:
            return None
    if ":" in host or any(c.isspace() or c in "/@?#" for c in host):
        return None
    return Place(host or LOOPBACK, int(port))


def host_of(text: str) -> str:
    """Return the host of a Host header, whose port may be absent, without brackets (RFC 9110, 7.2)."""
    return text[1:].partition("]")[0] if text.startswith("[") else text.partition(":")[0]


def is_loopback(host: str) -> bool:
    """Return whether a host name or IP address is one of this machine itself."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False
