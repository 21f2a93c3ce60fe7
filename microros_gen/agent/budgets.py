# SPDX-License-Identifier: Apache-2.0
"""Memory budgets: what all clients together may make the agent store, by kind, and the share of each client.

The numbers of bytes are upper estimates for Python and Fast DDS 2.14.5, measured on a 64-bit machine.
"""

from __future__ import annotations

from microros_gen.agent.input_pool import Holder, InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.records import dataclass

OBJECT_BYTES = 2_048
"""Bytes of an object without its representation and its ROS 2 entity."""
ROS_BYTES = {
    ObjectKind.PARTICIPANT: 8_192,
    ObjectKind.DATAWRITER: 36_864,
    ObjectKind.DATAREADER: 69_632,
    ObjectKind.REQUESTER: 86_016,
    ObjectKind.REPLIER: 98_304,
}
"""Bytes of the ROS 2 entity of an object, by kind, without samples."""
CALL_BYTES = 256
"""Bytes of an open request."""
BASE_BYTES = 80 << 20
"""Bytes of the agent without clients, ROS domains included: Python, ROS 2, and gaps on the heap."""
BASE_DESCRIPTORS, DOMAIN_DESCRIPTORS, NODE_DESCRIPTORS = 32, 32, 2
"""File descriptors of the agent without clients, of a ROS domain, and of a node (its events and a timer).

Of all objects, a node has the most descriptors for its counted bytes."""
HELD_CALLS_BYTES = 16 << 20
"""Bytes of requests and replies that wait for the other side of their service (`ros/services.py`)."""


@dataclass
class Gate:
    """Closed while the process is short of memory."""

    closed: bool = False


@dataclass(frozen=True)
class Shares:
    """The memory of one client, in bytes; unlimited without pools."""

    history: Holder
    """Samples in the histories of its writers, and the minimum memory of those of its readers."""
    objects: Holder
    """Its objects."""
    output: Holder
    """Output that waits for it."""
    calls: Holder
    """Its open requests."""
    object_history: int
    """Maximum bytes of history of one of its objects."""
    gate: Gate
    """Whether more objects may be created."""

    @staticmethod
    def unlimited() -> Shares:
        """Return unlimited shares, for a client outside of an agent."""
        return Shares(Holder(), Holder(), Holder(), Holder(), 1 << 62, Gate())

    @property
    def held(self) -> int:
        """Number of all stored bytes."""
        return self.history.held + self.objects.held + self.output.held + self.calls.held


class Budgets:
    """One pool for each kind of memory, shared by all clients."""

    def __init__(self, limits: Limits, connections: int = 0) -> None:
        """Create the pools; `connections` is the number of TCP connections that share the output pool."""
        self._limits = limits
        clients = limits.clients
        self._history = InputPool(limits.history_bytes, clients)
        self._objects = InputPool(limits.object_bytes, clients)
        self.output = InputPool(limits.output_bytes, clients + connections)
        self._calls = InputPool(limits.call_bytes, clients)
        self.gate = Gate()

    @property
    def held(self) -> int:
        """Number of stored bytes of all clients, including those that left and whose entities are not destroyed yet."""
        return self._history.held + self._objects.held + self.output.held + self._calls.held

    def of_client(self, limits: Limits | None = None) -> Shares:
        """Return the shares of a new client, by its own `limits` or those of the agent."""
        limits = limits or self._limits
        return Shares(
            Holder(self._history, limits.client_history_bytes),
            Holder(self._objects),
            Holder(self.output),
            Holder(self._calls),
            limits.object_history_bytes,
            self.gate,
        )


def cost_of(object_id: int, representation: int) -> int:
    """Return the bytes of an object whose representation has `representation` bytes."""
    return OBJECT_BYTES + 2 * representation + ROS_BYTES.get(ObjectKind(object_id & 0x0F), 0)


def most_descriptors(limits: Limits, connections: int) -> int:
    """Return the maximum number of file descriptors of the agent, with this number of TCP connections."""
    objects = limits.object_bytes // cost_of(ObjectKind.PARTICIPANT, 0)
    nodes = min(objects, limits.clients * limits.objects)
    fixed = BASE_DESCRIPTORS + limits.domains * DOMAIN_DESCRIPTORS
    return fixed + limits.clients + connections + NODE_DESCRIPTORS * nodes


def most_bytes(limits: Limits) -> int:
    """Return the bytes of the agent if every pool is full."""
    pools = limits.input_bytes + limits.history_bytes + limits.object_bytes + limits.output_bytes
    return BASE_BYTES + HELD_CALLS_BYTES + pools + limits.call_bytes
