# SPDX-License-Identifier: Apache-2.0
"""UDP over IPv4 or IPv6: one message per datagram; an address is the transport and the peer's socket address.

A client in session has its own socket at the same port, connected to its address. The system delivers its datagrams
there, so each client has its own queue: one that sends too fast overflows only its own. The queue of the client with
the lowest cost is read next.
"""

from __future__ import annotations

import contextlib
import select
import socket
import time
from collections import deque
from collections.abc import Hashable
from typing import Any, Final

from microros_gen.agent.fairness import TURN_S, Account, Fairness
from microros_gen.agent.quick import quick_receive
from microros_gen.agent.transport.addresses import parse_address
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.transport.datagrams import send_datagrams, takes_several
from microros_gen.agent.transport.sockets import Protocol, open_connected, open_socket, place_name

BATCH: Final = 64
"""Datagrams that are read from one socket before the answers are sent."""
SHARE_S: Final = 0.002
"""Seconds after which a batch of costly datagrams ends early."""
LOOK_S: Final = 0.001
"""Seconds after which clients with a lower cost are checked for new input."""
READY: Final = 128
"""Clients with input that are ordered by their cost at one time: with some hundred more, ordering takes longer than
reading. The system hands out the others next, as it moves to the end whom it has handed out."""
MAXIMUM_DATAGRAM: Final = 65_535
AT_ONCE: Final = 16
"""Datagrams to one client that are collected at most: those of equal size are then sent in one call."""
Peer = Any
"""A socket address of the system: host, port, and for IPv6 more."""


class Queue:
    """A socket that is read: the shared one, or that of one client."""

    def __init__(self, opened: socket.socket, account: Account, address: Hashable = None) -> None:
        """Read for the client at `address`; None: the socket may have datagrams of others."""
        self.socket = opened
        self.account = account
        self.address = address
        self.unsent: list[bytes] = []
        """Datagrams to the client that are not sent yet."""


class Udp:
    """A bound non-blocking socket, and one for each client in session."""

    def __init__(
        self,
        protocol: Protocol,
        host: str,
        port: int,
        fair: Fairness | None = None,
        strangers: Account | None = None,
        bound: socket.socket | None = None,
    ) -> None:
        """Bind to `host` and `port` (0: a free one), or take a socket that is. UserError: that is not possible.

        `fair` orders the clients, the account `strangers` is charged for senders without a session; both are the
        agent's.
        """
        self._fair = fair or Fairness()
        self._socket = bound or open_socket(protocol, host, port)
        self.protocol = protocol
        self.host, self.port = self._socket.getsockname()[:2]
        self._everybody = Queue(self._socket, strangers or Account())
        self._queues: dict[int, Queue] = {self._socket.fileno(): self._everybody}
        self._by_peer: dict[Peer, Queue] = {}
        self._strays: deque[tuple[bytes, Peer]] = deque()
        """Datagrams that were read when a socket was opened or closed."""
        self._unsent: list[Queue] = []
        """The queues with collected datagrams."""
        self._several = takes_several(self._socket)
        self._datagram = bytearray(MAXIMUM_DATAGRAM)
        """Where a datagram arrives: memory of the largest size for each one would take longer than a copy of most."""
        self._view = memoryview(self._datagram)
        self._epoll = select.epoll()
        self._epoll.register(self._socket, select.EPOLLIN)

    @property
    def label(self) -> str:
        """See Transport."""
        return f"{self.protocol.name} {place_name((self.host, self.port))}"

    @property
    def ready(self) -> bool:
        """See Transport."""
        return True

    def tick(self, now: float) -> None:
        """See Transport: a socket needs nothing."""

    @property
    def forgeable(self) -> bool:
        """See Transport: the sender's address of a datagram is not verified."""
        return True

    @property
    def waits(self) -> bool:
        """Whether datagrams have arrived."""
        return bool(self._strays) or bool(self._epoll.poll(0, 1))

    def fileno(self) -> int:
        """See Transport."""
        return self._epoll.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        while self._strays:
            data, peer = self._strays.popleft()
            receive(data, (self, peer), self)
        began = time.monotonic()
        while not self._round(receive) and time.monotonic() <= began + TURN_S:
            continue

    def _round(self, receive: Receive) -> bool:
        """Read queues in their order, until it is time to look for other input; return whether all were read."""
        ready = [self._queues[descriptor] for descriptor, _ in self._epoll.poll(0, READY)]
        self._fair.order(ready)
        end = time.monotonic() + LOOK_S
        for place, queue in enumerate(ready, 1):
            if not queue.account.busy:
                self._read(queue, receive)
                if self._unsent:
                    self.flush()
            if place < len(ready) and time.monotonic() > end:
                return False
        return True

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport."""
        peer: Peer = address[1]  # type: ignore[index]
        self.release(address)
        try:
            connected = open_connected(self._socket, peer)
        except OSError:
            return  # no descriptor is left: the client shares the common socket
        self._keep(self._socket)  # its earlier datagrams precede new ones
        only = address if self._keep(connected) else None
        queue = self._by_peer[peer] = self._queues[connected.fileno()] = Queue(connected, account, only)
        self._epoll.register(queue.socket, select.EPOLLIN)

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport."""
        queue = self._by_peer.pop(address[1], None)  # type: ignore[index]
        if queue is None:
            return
        self.flush()
        self._epoll.unregister(queue.socket)
        del self._queues[queue.socket.fileno()]
        if not moved:
            self._keep(queue.socket)
        queue.socket.close()

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        peer: Peer = address[1]  # type: ignore[index]
        queue = self._by_peer.get(peer)
        if queue is None:
            with contextlib.suppress(OSError):  # a datagram may always be lost
                self._socket.sendto(data, peer)
            return
        unsent = queue.unsent
        if not unsent:
            self._unsent.append(queue)
        unsent.append(data)
        if len(unsent) >= AT_ONCE:
            self.flush()

    def flush(self) -> None:
        """See Transport."""
        for queue in self._unsent:
            send_datagrams(queue.socket, queue.unsent, self._several)
            queue.unsent = []
        self._unsent.clear()

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return place_name(address[1]) if isinstance(address, tuple) else str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return parse_address(str(address[1][0]))  # type: ignore[index]

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    @property
    def descriptor(self) -> int:
        """The descriptor of the socket that gets messages from all who have no other one."""
        return self._socket.fileno()

    def close(self) -> None:
        """See Transport."""
        self.flush()
        for queue in self._queues.values():
            queue.socket.close()
        self._queues.clear()
        self._by_peer.clear()
        self._epoll.close()

    def _read(self, queue: Queue, receive: Receive) -> None:
        opened, account, address = queue.socket, queue.account, queue.address
        clock, quick = time.monotonic, quick_receive
        end = clock() + SHARE_S
        data: bytes | None
        for _ in range(BATCH):
            try:
                if address is None:
                    data, peer = self._take_from_anyone(opened)
                elif quick is not None:
                    data = quick(opened.fileno())  # it is closed when its client leaves
                else:
                    data = self._take(opened)
            except BlockingIOError:
                return
            except OSError:
                if opened.fileno() < 0:
                    return  # its client left with the previous message
                continue  # an ICMP error for something sent earlier
            if data is None:
                return
            receive(data, address or (self, peer), self)
            if account.busy or clock() > end:
                return

    def _take(self, connected: socket.socket) -> bytes:
        return bytes(self._view[: connected.recv_into(self._datagram)])

    def _take_from_anyone(self, opened: socket.socket) -> tuple[bytes, Peer]:
        size, peer = opened.recvfrom_into(self._datagram)
        return bytes(self._view[:size]), peer

    def _keep(self, ends: socket.socket) -> bool:
        """Keep the datagrams in a socket; in a new one, those that arrived before it was connected.

        Return whether they are all: a connected socket has only datagrams of its client from then on.
        """
        for _ in range(BATCH):
            try:
                self._strays.append(ends.recvfrom(MAXIMUM_DATAGRAM))
            except OSError as error:
                return isinstance(error, BlockingIOError)
        return False
