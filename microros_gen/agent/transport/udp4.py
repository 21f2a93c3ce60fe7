# SPDX-License-Identifier: Apache-2.0
"""UDP over IPv4: one message a datagram; an address is the pair of host and port."""

from __future__ import annotations

import errno
import socket
from collections.abc import Hashable

from microros_gen.agent.transport.base import Receive
from microros_gen.diagnostics import Diagnostic, UserError

BATCH = 64
"""Datagrams that are read before the answers go out."""
BUFFER_BYTES = 4 << 20
"""Asked of the system for datagrams that wait; it may give less."""
MAXIMUM_DATAGRAM = 65_535


class Udp4:
    """A bound socket that does not block."""

    def __init__(self, host: str, port: int) -> None:
        """Bind to `host` and `port` (0: a free one); UserError when that is not possible."""
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.setblocking(False)
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
            self._socket.bind((host, port))
        except OSError as error:
            self._socket.close()
            raise UserError([_explain(error, host, port)]) from error
        self.host, self.port = self._socket.getsockname()

    @property
    def label(self) -> str:
        """See Transport."""
        return f"udp4 {self.host}:{self.port}"

    @property
    def writing(self) -> bool:
        """See Transport: a datagram never waits here."""
        return False

    def tick(self, now: float) -> None:
        """See Transport: a socket needs no care."""

    def fileno(self) -> int:
        """See Transport."""
        return self._socket.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        take = self._socket.recvfrom
        for _ in range(BATCH):
            try:
                data, address = take(MAXIMUM_DATAGRAM)
            except BlockingIOError:
                return
            except OSError:
                continue  # an ICMP error for something sent earlier
            receive(data, address, self)

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        try:
            self._socket.sendto(data, address)  # type: ignore[call-overload]
        except OSError:
            return  # a datagram may always be lost

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return f"{address[0]}:{address[1]}" if isinstance(address, tuple) else str(address)

    def close(self) -> None:
        """See Transport."""
        self._socket.close()


def _explain(error: OSError, host: str, port: int) -> Diagnostic:
    if error.errno == errno.EADDRINUSE:
        return Diagnostic(f"UDP port {port} is in use; choose another with --port")
    if error.errno == errno.EACCES:
        return Diagnostic(f"UDP port {port} needs privileges; choose one above 1023 with --port")
    if error.errno == errno.EADDRNOTAVAIL or isinstance(error, socket.gaierror):
        return Diagnostic(
            f"'{host}' is not an IPv4 address of this machine",
            hint="--bind takes one of them, or 0.0.0.0 for all",
        )
    return Diagnostic(f"UDP {host}:{port} cannot be opened: {error.strerror or error}")
