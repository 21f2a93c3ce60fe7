# SPDX-License-Identifier: Apache-2.0
"""Addresses of clients as bytes, which the front and its workers exchange.

Over UDP the code of an address is the socket address, with which a worker sends by itself. Elsewhere it is a number
that the front gave to the address, its name in the log, its origin for the policy, and its number on a line or bus.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from microros_gen.agent.transport.base import RemoteAddress, Transport, number_at
from microros_gen.agent.transport.udp import Udp

KNOWN = 16_384
"""Addresses other than those of UDP that the front remembers; a further one replaces the one that is silent longest."""
SHARE_BYTES = 512 << 10
"""Maximum bytes from one address that wait for a worker, while more than `FREE_BYTES` wait for it."""
FREE_BYTES = 64 << 10


class Known:
    """An address that the front knows: its code, and how much from it waits for its worker."""

    __slots__ = ("_waiting", "address", "code")

    def __init__(self, code: bytes, address: Hashable) -> None:
        self.code = code
        self.address = address
        self._waiting: dict[int, tuple[int, int]] = {}
        """For each worker the state of its channel (`Channel.drained`), and the bytes from here since then."""

    def may_send(self, size: int, worker: int, drained: int, waiting: int) -> bool:
        """Return whether `size` more bytes from it may wait for a worker, of `waiting` bytes from all."""
        since, own = self._waiting.get(worker, (drained, 0))
        if since != drained:
            own = 0
        if waiting > FREE_BYTES and own + size > SHARE_BYTES:
            return False
        self._waiting[worker] = drained, own + size
        return True


class AddressBook:
    """The codes of addresses at one transport."""

    def __init__(self, transport: Transport) -> None:
        self._transport = transport
        self._is_udp = isinstance(transport, Udp)
        self._everybody = Known(b"", None)
        self._known: dict[Hashable, Known] = {}
        self._by_code: dict[bytes, Known] = {}
        self._next = 0

    def known(self, address: Hashable) -> Known:
        """Return what is known of an address. All senders of UDP that have no session share what may wait."""
        if self._is_udp:
            self._everybody.code = udp_code(address[1])  # type: ignore[index]
            return self._everybody
        found = self._known.pop(address, None)
        if found is None:
            self._next += 1
            name, origin = self._transport.name_of(address), str(self._transport.origin(address))
            place = str(number_at(address))
            found = Known(_joined(str(self._next), name, origin, place), address)
            self._by_code[found.code] = found
            if len(self._known) >= KNOWN:
                oldest = next(iter(self._known))
                del self._by_code[self._known.pop(oldest).code]
        self._known[address] = found
        return found

    def address(self, code: bytes) -> Hashable | None:
        """Return the address with a code; None: it is not known any more."""
        if self._is_udp:
            return (self._transport, udp_peer(code))
        found = self._by_code.get(code)
        return found.address if found is not None else None

    def forget_closed(self) -> None:
        """Forget connections that were closed."""
        closed = [address for address in self._known if getattr(address, "closed", False)]
        for address in closed:
            del self._by_code[self._known.pop(address).code]


def udp_code(peer: Any) -> bytes:
    """Return the code of a socket address."""
    return _joined(*map(str, peer))


def udp_peer(code: bytes) -> Any:
    """Return the socket address of a code."""
    host, *numbers = _parts(code)
    return (host, *map(int, numbers))


def remote_address(label: str, code: bytes) -> RemoteAddress:
    """Return the address with a code at the transport that has this label."""
    number, name, origin, place = _parts(code)
    return RemoteAddress(label, int(number), name, origin, int(place))


def remote_code(address: RemoteAddress) -> bytes:
    """Return the code of such an address."""
    return _joined(str(address.number), address.name, address.origin, str(address.place))


def _joined(*parts: str) -> bytes:
    return "\0".join(parts).encode(errors="surrogateescape")


def _parts(code: bytes) -> list[str]:
    return code.decode(errors="surrogateescape").split("\0")
