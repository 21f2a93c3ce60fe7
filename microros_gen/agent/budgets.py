# SPDX-License-Identifier: Apache-2.0
"""What all clients together may make the agent store, by kind, and what one of them stores of each kind.

The bytes are upper estimates of what Python and Fast DDS 2.14.5 take, measured on 64 bits.
"""

from __future__ import annotations

from microros_gen.agent.input_pool import Holder, InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.records import dataclass

OBJECT_BYTES = 2_048
"""What an object takes besides its representation and its side in ROS 2."""
ROS_BYTES = {
    ObjectKind.PARTICIPANT: 8_192,
    ObjectKind.DATAWRITER: 36_864,
    ObjectKind.DATAREADER: 69_632,
    ObjectKind.REQUESTER: 86_016,
    ObjectKind.REPLIER: 98_304,
}
"""What the side in ROS 2 of an object takes, without samples."""
CALL_BYTES = 256
"""What an open request takes."""
BASE_BYTES = 80 << 20
"""What the agent takes without a client, in ROS domains too: Python, ROS 2, and gaps on the heap."""
BASE_DESCRIPTORS, DOMAIN_DESCRIPTORS, NODE_DESCRIPTORS = 32, 32, 2
"""Descriptors of the agent without a client, of a ROS domain, and of a node (its events and a timer): of all objects
a node takes most for the bytes that are counted for it."""
HELD_CALLS_BYTES = 16 << 20
"""What requests and replies take that wait for the other side of their service (`ros/services.py`)."""


@dataclass
class Gate:
    """Closed while the memory of the process is tight."""

    closed: bool = False


@dataclass(frozen=True)
class Shares:
    """What one client stores; unlimited without pools."""

    history: Holder
    """Samples in the histories of its writers, and what those of its readers take at least."""
    objects: Holder
    """Its objects."""
    output: Holder
    """What waits for it."""
    calls: Holder
    """Its open requests."""
    object_history: int
    """Bytes of history that one object of it may have."""
    gate: Gate
    """Whether anything more may be made."""

    @staticmethod
    def unlimited() -> Shares:
        """Return shares without a limit, for a client that is used alone."""
        return Shares(Holder(), Holder(), Holder(), Holder(), 1 << 62, Gate())

    @property
    def held(self) -> int:
        """All stored bytes."""
        return self.history.held + self.objects.held + self.output.held + self.calls.held


class Budgets:
    """One pool for each kind."""

    def __init__(self, limits: Limits, connections: int = 0) -> None:
        """Create the pools; `connections` is the number of TCP connections that share the output pool."""
        self._limits = limits
        clients = limits.clients
        self._history = InputPool(limits.history_bytes, clients)
        self._objects = InputPool(limits.object_bytes, clients)
        self.output = InputPool(limits.output_bytes, clients + connections)
        self._calls = InputPool(limits.call_bytes, clients)
        self.gate = Gate()

    def of_client(self) -> Shares:
        """Return the shares of a new client."""
        limits = self._limits
        return Shares(
            Holder(self._history, limits.client_history_bytes),
            Holder(self._objects),
            Holder(self.output),
            Holder(self._calls),
            limits.object_history_bytes,
            self.gate,
        )


def cost_of(object_id: int, representation: int) -> int:
    """Return the bytes that an object takes whose representation has `representation` bytes."""
    return OBJECT_BYTES + 2 * representation + ROS_BYTES.get(ObjectKind(object_id & 0x0F), 0)


def most_descriptors(limits: Limits, connections: int) -> int:
    """Return the maximum number of file descriptors of the agent, with this number of TCP connections."""
    objects = limits.object_bytes // cost_of(ObjectKind.PARTICIPANT, 0)
    nodes = min(objects, limits.clients * limits.objects)
    fixed = BASE_DESCRIPTORS + limits.domains * DOMAIN_DESCRIPTORS
    return fixed + limits.clients + connections + NODE_DESCRIPTORS * nodes


def most_bytes(limits: Limits) -> int:
    """Return the bytes that the agent takes when every pool is full."""
    pools = limits.input_bytes + limits.history_bytes + limits.object_bytes + limits.output_bytes
    return BASE_BYTES + HELD_CALLS_BYTES + pools + limits.call_bytes
