# SPDX-License-Identifier: Apache-2.0
"""Common parts of UDP and TCP over IPv4 and IPv6: opening a socket, names of addresses, and reasons of failure."""

from __future__ import annotations

import errno
import socket

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass

BUFFER_BYTES = 4 << 20
"""Requested receive buffer for datagrams in bytes; the system may grant less."""

CLIENT_BUFFER_BYTES = 1 << 18
"""The same for the datagrams of one client in session."""


@dataclass(frozen=True)
class Protocol:
    """A kind of socket transport: its name on the command line, and what the system calls it."""

    name: str
    family: socket.AddressFamily
    stream: bool

    @property
    def loopback(self) -> str:
        """The address at which only this machine reaches the agent: the default."""
        return "127.0.0.1" if self.family == socket.AF_INET else "::1"

    @property
    def everywhere(self) -> str:
        """The address that represents every address of this machine."""
        return "0.0.0.0" if self.family == socket.AF_INET else "::"

    @property
    def title(self) -> str:
        """For people: `UDP`, `TCP`."""
        return "TCP" if self.stream else "UDP"

    @property
    def version(self) -> str:
        """For people: `IPv4`, `IPv6`."""
        return "IPv4" if self.family == socket.AF_INET else "IPv6"


UDP4 = Protocol("udp4", socket.AF_INET, stream=False)
UDP6 = Protocol("udp6", socket.AF_INET6, stream=False)
TCP4 = Protocol("tcp4", socket.AF_INET, stream=True)
TCP6 = Protocol("tcp6", socket.AF_INET6, stream=True)
PROTOCOLS = {protocol.name: protocol for protocol in (UDP4, UDP6, TCP4, TCP6)}


def open_socket(protocol: Protocol, host: str, port: int) -> socket.socket:
    """Return a non-blocking socket, bound to `host` and `port` (0: a free one). Raises UserError if that fails.

    A socket for IPv6 accepts IPv6 alone, so that the same port of IPv4 is free for another transport.
    """
    kind = socket.SOCK_STREAM if protocol.stream else socket.SOCK_DGRAM
    try:
        place = socket.getaddrinfo(host, port, protocol.family, kind)[0][4]
        opened = socket.socket(protocol.family, kind)
    except OSError as error:
        raise UserError([_explain(error, protocol, host, port)]) from error
    try:
        opened.setblocking(False)
        if protocol.family == socket.AF_INET6:
            opened.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        if protocol.stream:
            opened.setsockopt(
                socket.SOL_SOCKET, socket.SO_REUSEADDR, 1
            )  # connections of an earlier agent linger
        else:
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        opened.bind(place)
    except OSError as error:
        opened.close()
        raise UserError([_explain(error, protocol, host, port)]) from error
    return opened


def open_connected(listener: socket.socket, peer: tuple[object, ...]) -> socket.socket:
    """Return a socket at the port of `listener` (UDP) that receives only from `peer`; OSError if none is free.

    The port is shared among the sockets of this user alone (SO_REUSEPORT), and only from when the listener was bound: a
    second agent at the port is still refused. Between the two calls below the new one may get datagrams of others.
    """
    connected = socket.socket(listener.family, socket.SOCK_DGRAM)
    try:
        connected.setblocking(False)
        if listener.family == socket.AF_INET6:
            connected.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        connected.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, CLIENT_BUFFER_BYTES)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        connected.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        connected.bind(listener.getsockname())
        connected.connect(peer)
    except OSError:
        connected.close()
        raise
    return connected


def place_name(address: object) -> str:
    """Return an address of the system as `host:port`, with IPv6 hosts in brackets."""
    if not isinstance(address, tuple) or len(address) < 2:
        return str(address)
    host, port = address[:2]
    return f"[{host}]:{port}" if ":" in str(host) else f"{host}:{port}"


def _explain(error: OSError, protocol: Protocol, host: str, port: int) -> Diagnostic:
    title, version = protocol.title, protocol.version
    if error.errno == errno.EADDRINUSE:
        return Diagnostic(f"{title} port {port} is in use; choose another with --port", id="MG-9436")
    if error.errno == errno.EACCES:
        return Diagnostic(
            f"{title} port {port} needs privileges; choose one above 1023 with --port", id="MG-9437"
        )
    if error.errno == errno.EAFNOSUPPORT:
        return Diagnostic(f"this system has no {version}", id="MG-9438")
    if error.errno == errno.EADDRNOTAVAIL or isinstance(error, socket.gaierror):
        return Diagnostic(
            f"'{host}' is not an {version} address of this machine",
            hint=f"--bind takes one of them, or {protocol.everywhere} for all",
            id="MG-9439",
        )
    return Diagnostic(f"{title} {host}:{port} cannot be opened: {error.strerror or error}", id="MG-9440")
