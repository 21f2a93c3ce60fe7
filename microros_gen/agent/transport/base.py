# SPDX-License-Identifier: Apache-2.0
"""The interface of transports to the agent. A stream transport splits its stream into messages itself."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from ipaddress import IPv4Address, IPv6Address
from typing import NamedTuple, Protocol

from microros_gen.agent.fairness import Account

Receive = Callable[[bytes, Hashable, "Transport"], None]
"""Function that gets one message, its source address, and the transport."""
Origin = IPv4Address | IPv6Address | str
"""Where a client is: the address of its host, or the path of its line, or the name of its CAN interface."""


class SealedAddress(NamedTuple):
    """Where a client is (`within` the transport that carries the records), and the client key that it has proved."""

    within: Hashable
    client_key: int


class RemoteAddress(NamedTuple):
    """An address at a transport of another process of the agent."""

    transport: str
    """Its label."""
    number: int
    name: str
    origin: str
    place: int
    """What `number_at` returns for it there."""


def number_at(address: Hashable) -> int:
    """Return a client's address on a line, or its identifier on a bus; 0 for others."""
    place = address.within if isinstance(address, SealedAddress) else address
    if isinstance(place, RemoteAddress):
        return place.place
    number = place[1] if isinstance(place, tuple) and len(place) == 2 else 0
    return number if isinstance(number, int) else 0


class Transport(Protocol):
    """A transport. Its addresses are hashable and differ from those of other transports."""

    @property
    def label(self) -> str:
        """Kind and address for the log and the ready line, such as `udp4 127.0.0.1:8888`."""

    @property
    def ready(self) -> bool:
        """Whether messages are accepted; False until a serial device exists."""

    @property
    def forgeable(self) -> bool:
        """Whether the source address of a message can be forged."""

    def fileno(self) -> int:
        """Return the descriptor that is readable while `pump` has something to do.

        It never changes; a transport with several descriptors returns an epoll descriptor.
        """

    def pump(self, receive: Receive) -> None:
        """Write waiting output and deliver a batch of what has arrived, without waiting. Never raises."""

    def tick(self, now: float) -> None:
        """Do what is due at `now` (seconds, monotonic); called some ten times a second. Never raises."""

    def claim(self, address: Hashable, account: Account) -> None:
        """Register that a client is in session at an address, so that its input is read in its turn. Never raises."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """Register that no client is in session at an address any more. Never raises.

        `moved`: the client sends from another address now, and its unread input here is obsolete.
        """

    def send(self, data: bytes, address: Hashable) -> None:
        """Send one message without waiting, in `flush` at the latest; it may be lost. Never raises."""

    def flush(self) -> None:
        """Send what `send` has collected; called after a tick and at the end of each round. Never raises."""

    def name_of(self, address: Hashable) -> str:
        """Return an address as in the log."""

    def origin(self, address: Hashable) -> Origin:
        """Return where the client at an address is, for the policy."""

    def proved_key(self, address: Hashable) -> bytes:
        """Return the client key (4 bytes, big endian) that the sender at an address has proved; empty: none."""

    def close(self) -> None:
        """Close every descriptor."""
