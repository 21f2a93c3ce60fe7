# SPDX-License-Identifier: Apache-2.0
"""Transports of a worker: UDP with own sockets of its clients, and all others through the front."""

from __future__ import annotations

import select
import socket
from collections import deque
from collections.abc import Callable, Hashable
from functools import lru_cache

from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.addresses import parse_address
from microros_gen.agent.transport.base import Origin, Receive, RemoteAddress
from microros_gen.agent.transport.outbox import Refusal, SealedRecord, SealedSample, is_sample
from microros_gen.agent.transport.sockets import PROTOCOLS, open_connected
from microros_gen.agent.transport.udp import BATCH, MAXIMUM_DATAGRAM, Peer, Queue, Udp
from microros_gen.agent.workers.addresses import (
    remote_address,
    remote_code,
    udp_code,
    udp_peer,
)
from microros_gen.agent.workers.channel import WAITING_BYTES, Channel, Kind, message_frame
from microros_gen.agent.workers.front_transport import FrontTransport

SAMPLES_BYTES = WAITING_BYTES // 8
"""Maximum bytes that wait for the front while best-effort samples are sent."""
Outside = Callable[[bytes, Hashable], bool]
"""Function that returns whether a message is outside of the session at its address."""


class RemoteTransport:
    """A transport that the front has; what it receives comes through the channel, by `deliver`."""

    def __init__(self, number: int, front: FrontTransport, channel: Channel, log: EventLog) -> None:
        """Represent a transport of the front, which has this `number` there."""
        self.label = front.label
        self.forgeable = front.forgeable
        self.ready = True
        self._number = number
        self._channel = channel
        self._log = log
        self._by_host = front.kind in PROTOCOLS
        self._address = lru_cache(4096)(lambda code: remote_address(front.label, code))
        self._arrived: deque[tuple[bytes, bytes]] = deque()
        self._nothing = select.epoll()  # never readable

    def deliver(self, code: bytes, data: bytes) -> None:
        """Take a message that came through the front; `pump` delivers it."""
        self._arrived.append((code, data))

    def fileno(self) -> int:
        """See Transport."""
        return self._nothing.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        while self._arrived:
            code, data = self._arrived.popleft()
            receive(data, self._address(code), self)

    def tick(self, now: float) -> None:
        """See Transport: the front does."""

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport."""
        self._channel.send(Kind.CLAIMED, message_frame(self._number, _code(address)))

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport."""
        self._channel.send(Kind.RELEASED, message_frame(self._number, _code(address)))

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        waiting = self._channel.waiting
        if waiting > WAITING_BYTES or (waiting > SAMPLES_BYTES and is_sample(data)):
            text = "{transport}: a message to {peer} is lost: more are sent than the agent passes on"
            self._log.count("front_full", text, transport=self.label, peer=self.name_of(address))
            return
        self._channel.send(_kind(data), message_frame(self._number, _code(address), data))

    def flush(self) -> None:
        """See Transport."""
        self._channel.flush()

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return address.name if isinstance(address, RemoteAddress) else str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        assert isinstance(address, RemoteAddress)
        return parse_address(address.origin) if self._by_host else address.origin

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    def address(self, code: bytes) -> Hashable:
        """Return the address with a code."""
        address: Hashable = self._address(code)
        return address

    def close(self) -> None:
        """See Transport."""
        self._nothing.close()


class WorkerUdp(Udp):
    """UDP in a worker: the front reads the common socket, and each client in session has its own one here.

    A message that a client's own socket gets and that is outside of its session goes back to the front, which knows
    whose it is. The same holds for what others sent between the two steps that make a socket that of one client.
    """

    def __init__(self, number: int, front: FrontTransport, channel: Channel, strangers: Account) -> None:
        """Use the socket of the front. `number`: that of the transport there."""
        bound = socket.socket(fileno=front.descriptor)
        super().__init__(PROTOCOLS[front.kind], "", 0, None, strangers, bound)
        self._epoll.unregister(bound)
        del self._queues[bound.fileno()]
        self._number = number
        self._channel = channel
        self._arrived: deque[tuple[bytes, bytes]] = deque()
        self._held: dict[Peer, deque[bytes]] = {}
        """Clients that the front still passes messages on from, and what came directly by then."""
        self.outside: Outside = _never

    def deliver(self, code: bytes, data: bytes) -> None:
        """Take a message that came through the front; `pump` delivers it."""
        self._arrived.append((code, data))

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        while self._arrived:
            code, data = self._arrived.popleft()
            receive(data, (self, udp_peer(code)), self)
        outside, back = self.outside, self._back

        def sorted_out(data: bytes, address: Hashable, _transport: object) -> None:
            if outside(data, address):
                back(data, address)
            else:
                receive(data, address, self)

        super().pump(sorted_out)

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport: read the client's own socket when the front has passed on all that came before."""
        peer: Peer = address[1]  # type: ignore[index]
        self.release(address)
        content = message_frame(self._number, udp_code(peer))
        try:
            connected = open_connected(self._socket, peer)
        except OSError:
            self._channel.send(Kind.CLAIMED, content)
            return  # no descriptor is left: the front passes its messages on
        held: deque[bytes] = deque()
        is_all = self._take_early(connected, peer, held)
        self._held[peer] = held
        only = address if is_all else None
        self._by_peer[peer] = self._queues[connected.fileno()] = Queue(connected, account, only)
        self._channel.send(Kind.CLAIMED, content)

    def direct(self, code: bytes) -> None:
        """Read a client's own socket from now on: the front has nothing more from it."""
        peer = udp_peer(code)
        queue, held = self._by_peer.get(peer), self._held.pop(peer, None)
        if queue is None or held is None:
            return
        self._strays.extend((data, peer) for data in held)
        self._epoll.register(queue.socket, select.EPOLLIN)

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport."""
        peer: Peer = address[1]  # type: ignore[index]
        queue = self._by_peer.pop(peer, None)
        self._channel.send(Kind.RELEASED, message_frame(self._number, udp_code(peer)))
        if queue is None:
            return
        self.flush()
        held = self._held.pop(peer, None)
        if held is None:
            self._epoll.unregister(queue.socket)
        del self._queues[queue.socket.fileno()]
        if not moved:
            for data in held or ():
                self._back(data, address)
            self._give_back(queue.socket)
        queue.socket.close()

    def _back(self, data: bytes, address: Hashable) -> None:
        """Give a message to the front; dropped if it takes no more, as the network would."""
        if self._channel.waiting <= WAITING_BYTES:
            code = udp_code(address[1])  # type: ignore[index]
            self._channel.send(Kind.BACK, message_frame(self._number, code, data))

    def _take_early(self, opened: socket.socket, peer: Peer, own: deque[bytes]) -> bool:
        """Sort what a new socket got before it was that of `peer` alone; return whether that was all."""
        for _ in range(BATCH):
            try:
                data, source = opened.recvfrom(MAXIMUM_DATAGRAM)
            except OSError as error:
                return isinstance(error, BlockingIOError)
            if source == peer:
                own.append(data)
            else:
                self._back(data, (self, source))
        return False

    def _give_back(self, ends: socket.socket) -> None:
        for _ in range(BATCH):
            try:
                data, source = ends.recvfrom(MAXIMUM_DATAGRAM)
            except OSError:
                return
            self._back(data, (self, source))

    def address(self, code: bytes) -> Hashable:
        """Return the address with a code."""
        return (self, udp_peer(code))


def _code(address: Hashable) -> bytes:
    assert isinstance(address, RemoteAddress)
    return remote_code(address)


def _kind(data: bytes) -> Kind:
    """Return the kind of frame that has a message to a client."""
    if isinstance(data, SealedRecord):
        return Kind.SEALED_SAMPLE if isinstance(data, SealedSample) else Kind.SEALED
    return Kind.REFUSAL if isinstance(data, Refusal) else Kind.MESSAGE


def _never(_data: bytes, _address: Hashable) -> bool:
    return False
