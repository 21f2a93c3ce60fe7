# SPDX-License-Identifier: Apache-2.0
"""UDP over IPv4 or IPv6: one message a datagram; an address is the transport and the peer's socket address."""

from __future__ import annotations

import time
from collections.abc import Hashable

from microros_gen.agent.transport.base import Receive
from microros_gen.agent.transport.sockets import Protocol, open_socket, place_name

BATCH = 64
"""Datagrams that are read before the answers go out."""
TURN_S = 0.02
"""Seconds after which it is the turn of others, if the datagrams of a batch are costly ones."""
MAXIMUM_DATAGRAM = 65_535


class Udp:
    """A bound socket that does not block."""

    def __init__(self, protocol: Protocol, host: str, port: int) -> None:
        """Bind to `host` and `port` (0: a free one); UserError when that is not possible."""
        self._socket = open_socket(protocol, host, port)
        self.protocol = protocol
        self.host, self.port = self._socket.getsockname()[:2]

    @property
    def label(self) -> str:
        """See Transport."""
        return f"{self.protocol.name} {place_name((self.host, self.port))}"

    @property
    def ready(self) -> bool:
        """See Transport."""
        return True

    def tick(self, now: float) -> None:
        """See Transport: a socket needs no care."""

    def fileno(self) -> int:
        """See Transport."""
        return self._socket.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        take = self._socket.recvfrom
        end = time.monotonic() + TURN_S
        for _ in range(BATCH):
            try:
                data, peer = take(MAXIMUM_DATAGRAM)
            except BlockingIOError:
                return
            except OSError:
                continue  # an ICMP error for something sent earlier
            receive(data, (self, peer), self)
            if time.monotonic() > end:
                return

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        try:
            self._socket.sendto(data, address[1])  # type: ignore[index]
        except OSError:
            return  # a datagram may always be lost

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return place_name(address[1]) if isinstance(address, tuple) else str(address)

    def close(self) -> None:
        """See Transport."""
        self._socket.close()
