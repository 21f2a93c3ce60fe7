# SPDX-License-Identifier: Apache-2.0
"""Multicast discovery (DDS-XRCE 1.0, 9.3): clients search for agents in a group and get the addresses of this one.

It answers GET_INFO, and nothing else, with an INFO that lists the agent's transports that the client can reach. If all
of them are on the loopback address, only clients on this machine get an answer: their requests leave through the
interface of the default route and carry its address. At most `ANSWERS_PER_SECOND` requests are answered.
"""

from __future__ import annotations

import ipaddress
import socket
import struct
from collections.abc import Callable, Hashable, Iterable, Sequence

from microros_gen.agent.fairness import Account
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.addresses import Address, OwnAddress, own_addresses, parse_address
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.transport.sockets import place_name
from microros_gen.agent.transport.tcp import Tcp
from microros_gen.agent.transport.udp import MAXIMUM_DATAGRAM, Udp
from microros_gen.agent.wire.constants import SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY, Status
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.agent.wire.message import Header, header_size, split
from microros_gen.agent.wire.session_messages import AgentActivity, AgentConfig, GetInfo, Info, Locator
from microros_gen.agent.wire.submessages import decode, encode
from microros_gen.diagnostics import Diagnostic, UserError

GROUP = "239.255.0.2"
PORT = 7400
"""Default group and UDP port, those of the public client."""
MOST_LOCATORS = 16
"""Maximum number of addresses in an answer, so that it fits the 512 bytes of the public client."""
ANSWERS_PER_SECOND = 200
REFRESH_S = 5.0
"""Seconds between two checks for new and removed interfaces."""
_BATCH = 16
_IP_MULTICAST_ALL = 49  # of Linux: 0 leaves out groups that other sockets of this machine joined
_MEDIUM, _LARGE = 1, 2  # kinds of locators: IPv4, IPv6

SocketTransport = Udp | Tcp


class Discovery:
    """A socket in the multicast group; it answers by itself and delivers no messages."""

    def __init__(
        self,
        transports: Sequence[SocketTransport],
        log: EventLog,
        port: int = PORT,
        addresses: Callable[[], Iterable[OwnAddress]] = own_addresses,
    ) -> None:
        """Announce `transports`. Raises UserError without transports, or if the port is not available."""
        if not transports:
            reason = "discovery needs a UDP or TCP transport"
            raise UserError(
                [Diagnostic(reason, hint="Add one, such as `udp4`, or leave --discovery out", id="MG-9428")]
            )
        self._transports = sorted(transports, key=lambda t: t.protocol.stream)
        self._log = log
        self._addresses = addresses
        self._own: tuple[OwnAddress, ...] = ()
        self._joined: set[int] = set()
        self._refresh_at = 0.0
        self._answers = 0
        self._answers_until = 0.0
        self._local = all(parse_address(t.host).is_loopback for t in transports)
        self._port = port
        self._socket = _open(port)
        self._refresh()

    @property
    def label(self) -> str:
        """See Transport."""
        return f"discovery {GROUP}:{self._port}"

    @property
    def ready(self) -> bool:
        """See Transport: when an interface exists."""
        return bool(self._joined)

    @property
    def forgeable(self) -> bool:
        """See Transport: as UDP."""
        return True

    def fileno(self) -> int:
        """See Transport."""
        return self._socket.fileno()

    def tick(self, now: float) -> None:
        """See Transport."""
        if now >= self._answers_until:
            self._answers, self._answers_until = 0, now + 1.0
        if now >= self._refresh_at:
            self._refresh_at = now + REFRESH_S
            self._refresh()

    def pump(self, receive: Receive) -> None:
        """See Transport: answers the requests itself."""
        for _ in range(_BATCH):
            try:
                data, asker = self._socket.recvfrom(MAXIMUM_DATAGRAM)
            except BlockingIOError:
                return
            except OSError:
                continue
            if self._local and not self._is_near(parse_address(asker[0])):
                continue
            try:
                self._answer(data, asker)
            except (MalformedError, ValueError, OSError) as error:
                text = "discovery: message from {peer} ignored: {detail}"
                self._log.count("discovery_input", text, peer=place_name(asker), detail=str(error))

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport: nobody has a session here."""

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport: nobody has a session here."""

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport: nobody has a session here."""

    def flush(self) -> None:
        """See Transport: nothing is collected."""

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return place_name(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return parse_address(str(address[0]))  # type: ignore[index]

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    def close(self) -> None:
        """See Transport."""
        self._socket.close()

    def locators(self, asker: Address) -> tuple[Locator, ...]:
        """Return the agent's addresses that `asker` can reach: UDP before TCP, IPv4 before IPv6."""
        is_near = self._is_near(asker)
        found = dict.fromkeys(
            (address, transport.port)
            for transport in self._transports
            for address in self._reachable(parse_address(transport.host), asker)
            if is_near or not address.is_loopback
        )
        ordered = sorted(found, key=lambda place: place[0].version)
        return tuple(_locator(address, port) for address, port in ordered[:MOST_LOCATORS])

    def _is_near(self, asker: Address) -> bool:
        """Return whether an address is this machine's. (The kernel drops packets from outside with such a source.)"""
        return asker.is_loopback or any(own.address == asker for own in self._own)

    def _reachable(self, host: Address, asker: Address) -> list[Address]:
        """Return the addresses of `host`, first the one from which `asker` would get the answer."""
        if not host.is_unspecified:
            return [host]
        own = [o.address for o in self._own if o.address.version == host.version]
        facing = _facing(asker) if asker.version == host.version else None
        return sorted(own, key=lambda address: (address != facing, address.is_loopback))

    def _answer(self, data: bytes, asker: tuple[str, int]) -> None:
        head = Header.decode(data)
        spans = split(data, header_size(data))
        question = decode(*spans[0][:2], data, *spans[0][2:]) if spans else None
        outside = head.session in (SESSION_NONE_WITH_KEY, SESSION_NONE_WITHOUT_KEY)
        if not isinstance(question, GetInfo) or not outside:
            raise MalformedError("discovery_input", "no GET_INFO outside of a session")
        if self._answers >= ANSWERS_PER_SECOND:
            text = "too many discovery requests, the last one from {peer}"
            self._log.count("discovery_flood", text, peer=place_name(asker))
            return
        self._answers += 1
        locators = self.locators(parse_address(asker[0]))
        text = "discovery: sent {count} addresses to {peer}"
        self._log.emit(Level.DEBUG, "discovery", text, peer=place_name(asker), count=len(locators))
        if locators:
            activity = AgentActivity(locators=locators)
            info = Info(question.request, question.object, Status.OK, 0, AgentConfig(), activity)
            self._socket.sendto(head.encode() + encode(info), asker)

    def _refresh(self) -> None:
        """Join the group on new interfaces; remove those that have disappeared."""
        self._own = tuple(self._addresses())
        wanted = {own.interface for own in self._own if own.address.version == 4}
        self._joined &= wanted
        for interface in wanted - self._joined:
            request = struct.pack("4s4si", socket.inet_aton(GROUP), bytes(4), interface)
            try:
                self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, request)
            except OSError:
                continue  # it cannot receive multicast now
            self._joined.add(interface)


def _open(port: int) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.setblocking(False)
        # Others share the port: DDS of domain 0 listens there to another group, and so do other agents.
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        opened.setsockopt(socket.IPPROTO_IP, _IP_MULTICAST_ALL, 0)
        opened.bind((GROUP, port))  # not to all addresses: unicast datagrams are no requests
    except OSError as error:
        opened.close()
        reason = f"discovery at {GROUP}:{port} cannot be opened: {error.strerror or error}"
        raise UserError(
            [Diagnostic(reason, hint="Choose another port with --discovery-port", id="MG-9429")]
        ) from error
    return opened


def _facing(asker: Address) -> Address | None:
    """Return this machine's address from which datagrams to `asker` are sent."""
    family = socket.AF_INET if asker.version == 4 else socket.AF_INET6
    with socket.socket(family, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((str(asker), 9))  # nothing is sent
            return ipaddress.ip_address(probe.getsockname()[0])
        except (OSError, ValueError):
            return None


def _locator(address: Address, port: int) -> Locator:
    return Locator(_MEDIUM if address.version == 4 else _LARGE, address.packed, port)
