# SPDX-License-Identifier: Apache-2.0
"""TCP over IPv4 or IPv6: messages preceded by their length, over many connections that cannot delay each other.

Each connection is an address. It is bounded in memory (one unfinished input message of at most 64 KiB,
`TcpLimits.output_bytes` of output) and in the time for its first message, for completing a message, and for reading its
output. A client whose connection ended keeps its session until the agent's time-out, and continues over another one.
"""

from __future__ import annotations

import errno
import select
import socket
import time
from collections.abc import Callable, Hashable
from functools import partial

from microros_gen.agent.fairness import TURN_S, Account, Fairness
from microros_gen.agent.framing import LARGEST_PAYLOAD, LengthDecoder, encode_length
from microros_gen.agent.input_pool import Holder, InputPool
from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.transport.addresses import host_of, parse_address
from microros_gen.agent.transport.base import Origin, Receive
from microros_gen.agent.transport.outbox import Outbox, Refusal, is_sample
from microros_gen.agent.transport.sockets import Protocol, open_socket, place_name
from microros_gen.records import dataclass

READ_BYTES = 4_096
"""Bytes that are read from a connection before the next one's turn."""
ACCEPTS = 64
"""Connections that are accepted before other work gets its turn."""
WAITING = 4_096
"""Requested backlog of connections, limited by net.core.somaxconn.

If it is full, the system lets clients try again only after 1 s, 3 s, 7 s and so on, so there should always be room."""
IDLE_S = 5.0
"""Seconds of silence after which a connection may be replaced by a new one of the same host."""
CARE_S = 0.5
"""Seconds between two checks for connections that exceeded a time."""
SYSTEM_BUFFER_BYTES = 131_072
"""Requested send buffer of a connection in bytes; the system may double it."""
_NO_ROOM = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
_KEEPALIVE = (("TCP_KEEPIDLE", 30), ("TCP_KEEPINTVL", 10), ("TCP_KEEPCNT", 3))
"""Keep-alive settings: a vanished peer is detected after a minute (RFC 9293, 3.8.4)."""


@dataclass(frozen=True)
class TcpLimits:
    """Limits of connections; times in seconds."""

    connections: int = 256
    """Maximum connections of one port. One more replaces a silent one, or is refused."""
    output_bytes: int = 262_144
    """Maximum bytes of output that wait for a slow connection; further messages are lost."""
    connections_per_host: int = 128
    """Maximum connections from one address (IPv4), or from one network of 64 bits (IPv6)."""
    patience_s: float = 30.0
    """Seconds until a connection is closed that has sent no complete message, does not finish one, or does not read.

    A connection that was silent for this long may also be replaced."""


class Connection:
    """One connection, which is also the address of its client. It is equal only to itself."""

    def __init__(
        self,
        accepted: socket.socket,
        peer: str,
        limit: int,
        now: float,
        too_slow: Callable[[str], None],
        holder: Holder,
        output: Holder,
        host: str,
        account: Account,
    ) -> None:
        self.account = account
        """The account that its input is charged to."""
        self.host = host
        self.answered = False
        """Whether the agent has sent it an answer other than a refusal: it sent a valid message."""
        self.holder = holder
        """Budget of its unfinished message."""
        self.socket = accepted
        self.descriptor = accepted.fileno()
        self.peer = peer
        self.decoder = LengthDecoder()
        self.outbox = Outbox(limit, partial(too_slow, peer), output)
        self.spoke = False
        """Whether a complete message was received."""
        self.last_received = now
        self.due_since: float | None = now
        """Since when a message is expected: its first one, or the rest of one."""
        self.stuck_since: float | None = None
        """Since when it has read nothing of its pending output."""

    @property
    def closed(self) -> bool:
        """Whether it was closed; messages to it are lost."""
        return self.descriptor < 0


class Tcp:
    """A listening socket and its connections behind one epoll descriptor."""

    def __init__(
        self,
        protocol: Protocol,
        host: str,
        port: int,
        log: EventLog,
        limits: TcpLimits | None = None,
        pool: InputPool | None = None,
        output: InputPool | None = None,
        fair: Fairness | None = None,
        strangers: Account | None = None,
    ) -> None:
        """Bind to `host` and `port` (0: a free one). Raises UserError if that is not possible.

        The pools and `fair` are those of the agent; the account `strangers` is charged for connections without a
        client.
        """
        self._fair = fair or Fairness()
        self._strangers = strangers or Account()
        self._pool = pool
        self._output = output
        self._log = log
        self._limits = limits or TcpLimits()
        self._listener = open_socket(protocol, host, port)
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SYSTEM_BUFFER_BYTES)
        self._listener.listen(WAITING)
        self.protocol = protocol
        self.host, self.port = self._listener.getsockname()[:2]
        self._epoll = select.epoll()
        self._epoll.register(self._listener, select.EPOLLIN)
        self._listening = True
        self._connections: dict[int, Connection] = {}
        self._now = 0.0
        self._care_at = 0.0

    @property
    def label(self) -> str:
        """See Transport."""
        return f"{self.protocol.name} {place_name((self.host, self.port))}"

    @property
    def ready(self) -> bool:
        """See Transport."""
        return True

    def __len__(self) -> int:
        """Return the number of open connections."""
        return len(self._connections)

    @property
    def forgeable(self) -> bool:
        """See Transport: a connection proves the address."""
        return False

    def fileno(self) -> int:
        """See Transport."""
        return self._epoll.fileno()

    def pump(self, receive: Receive) -> None:
        """See Transport."""
        found = dict(self._epoll.poll(0))
        arriving = found.pop(self._listener.fileno(), 0)
        ready = [self._connections[descriptor] for descriptor in found]
        self._fair.order(ready)
        began = time.monotonic()
        for connection in ready:
            if connection.closed:
                continue
            events = found[connection.descriptor]
            if events & select.EPOLLOUT:
                self._write(connection)
            if events & ~select.EPOLLOUT and not connection.closed and not connection.account.busy:
                self._read(connection, receive)
            if time.monotonic() > began + TURN_S:
                break
        if arriving:  # last, because descriptors that were closed above are reused
            self._accept()

    def tick(self, now: float) -> None:
        """See Transport."""
        self._now = now
        if not self._listening:
            self._epoll.register(self._listener, select.EPOLLIN)
            self._listening = True
        if now >= self._care_at:
            self._care_at = now + CARE_S
            for connection in list(self._connections.values()):
                self._care(connection, now - self._limits.patience_s)

    def claim(self, address: Hashable, account: Account) -> None:
        """See Transport."""
        assert isinstance(address, Connection)
        address.account = account

    def release(self, address: Hashable, moved: bool = False) -> None:
        """See Transport."""
        assert isinstance(address, Connection)
        address.account = self._strangers

    def send(self, data: bytes, address: Hashable) -> None:
        """See Transport."""
        assert isinstance(address, Connection)
        address.answered = address.answered or not isinstance(data, Refusal)
        if address.closed or len(data) > LARGEST_PAYLOAD:
            return
        frame = encode_length(data)
        is_partly_sent = False
        if not address.outbox:
            try:
                done = address.socket.send(frame)
            except BlockingIOError:
                done = 0
            except OSError as error:
                self.drop(address, error.strerror or str(error))
                return
            if done == len(frame):
                return
            frame, is_partly_sent = frame[done:], done > 0
            address.stuck_since = self._now
            self._watch(address, writing=True)
        if not address.outbox.put(frame, not is_partly_sent and is_sample(data)):
            text = "{transport}: {peer} reads too slowly: messages to it are lost"
            self._log.count("tcp_output_full", text, transport=self.label, peer=address.peer)

    def flush(self) -> None:
        """See Transport: nothing is collected."""

    def name_of(self, address: Hashable) -> str:
        """See Transport."""
        return address.peer if isinstance(address, Connection) else str(address)

    def origin(self, address: Hashable) -> Origin:
        """See Transport."""
        return parse_address(address.peer.rpartition(":")[0].strip("[]"))  # type: ignore[attr-defined]

    def proved_key(self, address: Hashable) -> bytes:
        """See Transport: anyone can send any key."""
        return b""

    def close(self) -> None:
        """See Transport."""
        for connection in list(self._connections.values()):
            self.drop(connection, "the agent stops")
        self._listener.close()
        self._epoll.close()

    def _read(self, connection: Connection, receive: Receive) -> None:
        try:
            data = connection.socket.recv(READ_BYTES)
        except BlockingIOError:
            return
        except OSError as error:
            self.drop(connection, error.strerror or str(error))
            return
        if not data:
            self.drop(connection, "it hung up")
            return
        connection.last_received = self._now
        for message in connection.decoder.feed(data):
            if message:
                connection.spoke = True
                receive(message, connection, self)
            else:
                text = "{transport}: {peer} sent an empty message"
                self._log.count("frame_empty", text, transport=self.label, peer=connection.peer)
        if connection.closed or not self._holds(connection):
            return
        if connection.spoke and not connection.decoder.unfinished:
            connection.due_since = None
        elif connection.due_since is None:
            connection.due_since = self._now

    def _write(self, connection: Connection) -> None:
        try:
            if connection.outbox.write(connection.descriptor):
                connection.stuck_since = self._now
        except OSError as error:
            self.drop(connection, error.strerror or str(error))
            return
        if not connection.outbox:
            connection.stuck_since = None
            self._watch(connection, writing=False)

    def _holds(self, connection: Connection) -> bool:
        """Count the bytes of a connection's unfinished message; close the connection if they do not fit."""
        holder, unfinished = connection.holder, connection.decoder.unfinished
        if unfinished or holder.held:
            holder.clear()
            if not holder.take(unfinished):
                self._fail(connection, "tcp_input_full", "unfinished messages of all clients take too much")
                return False
        return True

    def _accept(self) -> None:
        for _ in range(ACCEPTS):
            try:
                accepted, peer = self._listener.accept()
            except BlockingIOError:
                return
            except OSError as error:
                if error.errno in _NO_ROOM:  # it stays readable: look again at the next tick
                    self._epoll.unregister(self._listener)
                    self._listening = False
                    text = "{transport} takes no connection: {why}"
                    self._log.count("tcp_refused", text, transport=self.label, why=error.strerror or "")
                    return
                continue  # it was closed again
            host = host_of(peer[0])
            if self._make_room(host):
                self._add(accepted, place_name(peer), host)
            else:
                text = "{transport} has {count} connections already: {peer} was refused"
                fields = {"transport": self.label, "peer": place_name(peer)}
                self._log.count("tcp_refused", text, count=len(self._connections), **fields)
                accepted.close()

    def _add(self, accepted: socket.socket, peer: str, host: str) -> None:
        accepted.setblocking(False)
        accepted.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        accepted.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        for name, value in _KEEPALIVE:
            accepted.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)
        connection = Connection(
            accepted,
            peer,
            self._limits.output_bytes,
            self._now,
            self._too_slow,
            Holder(self._pool),
            Holder(self._output),
            host,
            self._strangers,
        )
        self._connections[connection.descriptor] = connection
        self._epoll.register(accepted, select.EPOLLIN)
        self._log.emit(
            Level.DEBUG, "connection_opened", "{transport}: {peer} opened", transport=self.label, peer=peer
        )

    def _too_slow(self, peer: str) -> None:
        text = (
            "{transport}: {peer} is slower than the samples for it: the oldest best-effort ones are dropped"
        )
        self._log.count("tcp_slow", text, transport=self.label, peer=peer)

    def _make_room(self, host: str) -> bool:
        """Return whether there is room for one more connection from `host`, after closing another one if necessary.

        Connections that were never answered are closed first, then those that were silent for the longest time. If the
        host has reached its limit, one of its connections is closed.
        """
        own = [connection for connection in self._connections.values() if connection.host == host]
        if len(own) >= self._limits.connections_per_host:
            return self._displace(own, IDLE_S)
        if len(self._connections) < self._limits.connections:
            return True
        return self._displace(list(self._connections.values()), self._limits.patience_s)

    def _displace(self, candidates: list[Connection], silent_s: float) -> bool:
        least = min(candidates, key=lambda c: (c.answered, c.last_received))
        if least.answered and self._now - least.last_received < silent_s:
            return False
        self._fail(least, "tcp_displaced", "its place is needed")
        return True

    def _care(self, connection: Connection, since: float) -> None:
        """Close a connection that has exceeded a time limit: something was due before `since`."""
        if connection.due_since is not None and connection.due_since < since:
            why = "a message was not finished" if connection.spoke else "no message came"
            self._fail(connection, "tcp_unfinished" if connection.spoke else "tcp_silent", why)
        elif connection.stuck_since is not None and connection.stuck_since < since:
            self._fail(connection, "tcp_stuck", "it takes nothing of what it is sent")

    def _fail(self, connection: Connection, kind: str, why: str) -> None:
        text = "{transport}: {peer} closed: {why}"
        self._log.count(kind, text, transport=self.label, peer=connection.peer, why=why)
        self.drop(connection, why)

    def drop(self, connection: Connection, why: str) -> None:
        """Close a connection; `why` is for the log."""
        if connection.closed:
            return
        self._epoll.unregister(connection.descriptor)
        del self._connections[connection.descriptor]
        connection.descriptor = -1
        connection.socket.close()
        connection.outbox.clear()
        connection.holder.clear()
        fields = {"transport": self.label, "peer": connection.peer, "why": why}
        self._log.emit(Level.DEBUG, "connection_closed", "{transport}: {peer} ended: {why}", **fields)

    def _watch(self, connection: Connection, writing: bool) -> None:
        events = select.EPOLLIN | (select.EPOLLOUT if writing else 0)
        self._epoll.modify(connection.descriptor, events)
