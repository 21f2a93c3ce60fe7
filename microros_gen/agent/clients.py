# SPDX-License-Identifier: Apache-2.0
"""The clients that an agent knows, by key and by address."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable, Iterator, KeysView
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from microros_gen.agent.budgets import Shares
from microros_gen.agent.cutting import Cutting
from microros_gen.agent.fairness import Account
from microros_gen.agent.limits import Limits
from microros_gen.agent.objects import ObjectTree
from microros_gen.agent.policy.access import Access
from microros_gen.agent.rates import Rate
from microros_gen.agent.services import Calls
from microros_gen.agent.session import Ready, Session
from microros_gen.agent.steps import Steps
from microros_gen.agent.transport.base import Transport

if TYPE_CHECKING:
    from microros_gen.agent.reading import Reading


@dataclass(frozen=True, eq=False)
class Job:
    """Work for a client that is done in steps."""

    steps: Steps[None]
    adds: bool
    """It adds to the ROS graph, so it waits while changes of the graph are not allowed."""


@dataclass(eq=False)
class Client:
    """A client in session. Times are seconds of the agent's monotonic clock."""

    session: Session
    objects: ObjectTree
    transport: Transport
    address: Hashable
    timeout_s: float
    last_received: float
    calls: Calls
    rate: Rate
    account: Account
    """The account that its work is charged to."""
    messages_per_second: int = 1 << 62
    """Accepted messages."""
    access: Access = field(default_factory=Access)
    """What it may use."""
    limits: Limits | None = None
    """The limits that it was made with."""
    denials: int = 0
    """Number of its objects that were refused as not permitted."""
    claimed: bool = False
    """Whether its transport has registered the session at its address."""
    opened: float = 0.0
    """When its session began; times of samples are relative to this."""
    probed: float = 0.0
    """When it was last probed."""
    probes: int = 0
    """Number of probes since its last answer."""
    loss: float = 0.0
    """Fraction of probes without an answer, 0 to 1."""
    kept: bool = False
    """It sleeps, and undelivered samples are kept for it."""
    credit: int = 0
    """Bytes of configurations that may still be sent to it."""
    shares: Shares = field(default_factory=Shares.unlimited)
    """The memory that it uses."""
    asleep: bool = False
    """Silent for `timeout_s`: its entities have left the ROS graph and return with its next message."""
    adopted: bool = False
    """It did not open its session with this agent (see `preconfigured`)."""
    unacknowledged: set[int] = field(default_factory=set)
    """Reliable input streams with a pending ACKNACK."""
    ready: deque[Ready] = field(default_factory=deque)
    """Messages that are ready to be processed."""
    work: deque[Job] = field(default_factory=deque)
    """Work to finish before those messages."""
    turn_at: float = 0.0
    """Earliest time of that work."""
    inbox_bytes: int = 0
    """Upper bound of the bytes of messages that arrived while it waited for its turn."""
    stream: int = 0
    """Stream of the message that is being processed."""
    more: bool = False
    """That message has further submessages."""
    samples: Cutting | None = None
    """The samples of an unfinished WRITE_DATA."""
    retry_at: float = 0.0
    """When a stopped reliable stream is retried, and the delay before that."""
    retry_s: float = 0.0
    readings: dict[int, Reading] = field(default_factory=dict)
    """Its readings, by object id."""
    waiting: deque[Reading] = field(default_factory=deque)
    """Readings that wait for space on a reliable stream."""
    received: int = 0
    """Messages from it since it is known, and their bytes; `sent` counts those to it."""
    received_bytes: int = 0
    sent: int = 0
    sent_bytes: int = 0

    @property
    def name(self) -> str:
        """Key, as in the log."""
        return self.session.link.key.hex().upper()

    @property
    def place(self) -> str:
        """Address, as in the log."""
        return self.transport.name_of(self.address)

    def send(self, message: bytes) -> None:
        """Send one message."""
        self.sent += 1
        self.sent_bytes += len(message)
        self.transport.send(message, self.address)

    def acknowledge(self) -> None:
        """Send the due acknowledgements of processed messages; the others stay to be acknowledged."""
        undone = [
            ready[2] for ready in self.ready if not ready[3]
        ]  # the rest of the message with the last fragment follows the reassembled one
        if self.more:
            undone.append(self.stream)
        for stream in self.unacknowledged:
            self.send(self.session.acknack(stream, undone.count(stream)))
        self.unacknowledged.intersection_update(undone)


class ClientTable:
    """Clients by key and by address; one address has one client."""

    def __init__(self) -> None:
        self._by_key: dict[bytes, Client] = {}
        self._by_address: dict[Hashable, Client] = {}
        self.at = self._by_address.get
        """Return the client at an address, or None."""
        self.watch: Callable[[Client, str], object] = _unwatched
        """Called for each event in the life of a client, with its name in the log."""

    def __len__(self) -> int:
        return len(self._by_key)

    def __iter__(self) -> Iterator[Client]:
        return iter(list(self._by_key.values()))

    def keys(self) -> KeysView[bytes]:
        """Return the keys of all clients."""
        return self._by_key.keys()

    def with_key(self, key: bytes) -> Client | None:
        """Return the client with a key, or None."""
        return self._by_key.get(key)

    def add(self, client: Client) -> None:
        """Add a client whose key and address are free."""
        self._by_key[client.session.link.key] = client
        self._by_address[client.address] = client

    def move(self, client: Client, transport: Transport, address: Hashable) -> Client | None:
        """Give a client another address; return the client that had it, which now has none."""
        evicted = self._by_address.get(address)
        if self._by_address.get(client.address) is client:
            del self._by_address[client.address]
        client.transport, client.address = transport, address
        self._by_address[address] = client
        return evicted if evicted is not client else None

    def remove(self, client: Client) -> None:
        """Remove a client."""
        self._by_key.pop(client.session.link.key, None)
        if self._by_address.get(client.address) is client:
            del self._by_address[client.address]


def _unwatched(_client: Client, _event: str) -> None:
    """Do nothing."""
