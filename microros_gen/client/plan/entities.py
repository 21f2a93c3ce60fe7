# SPDX-License-Identifier: Apache-2.0
"""The slice of the client's plan for its entities: what is declared, and places for the rest."""

from __future__ import annotations

from dataclasses import field
from typing import Generic, TypeVar

from microros_gen.application.kinds import KIND
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.runtime_rows import EndpointRow, SourceMembers
from microros_gen.client.plan.services import ServicePlan
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import include_path, type_files

Declared = TypeVar("Declared")

SIZED_SERVICES = 5
"""From so many services and clients on, steps count more than the code: components that serve open five or six."""


@dataclass(frozen=True)
class Places(Generic[Declared]):
    """Places of one kind of entity: `max` of them, the first for those that are `declared`.

    The library itself opens `implied` of them; where the application declares no nodes, the first.
    """

    max: int = 0
    declared: tuple[Declared, ...] = ()
    implied: int = 0

    @property
    def any(self) -> bool:
        """Whether there are any."""
        return self.max > 0

    @property
    def application(self) -> int:
        """How many the application opens: the last ones."""
        return self.max - self.implied


@dataclass(frozen=True, kw_only=True)
class EntitiesPlan:
    """Places of entities, and their names.

    `declared` is false for an application without `nodes:`: then names come from the calls and are kept in pools
    (names of at most `name_size` bytes with their terminator, DDS type names of `type_name_size`). Subscriptions have
    one place at least where they are selected; services and clients none where `nodes:` declares none.
    `timed_qos`: an endpoint has a deadline or a lifespan.
    """

    declared: bool
    nodes: Places[NodePlan]
    publishers: Places[PublisherPlan]
    subscriptions: Places[SubscriptionPlan] = field(default_factory=Places)
    services: Places[ServicePlan] = field(default_factory=Places)
    clients: Places[ServicePlan] = field(default_factory=Places)
    name_size: int = 0
    type_name_size: int = 0
    timed_qos: bool = False

    def places(self, kind: str) -> Places[PublisherPlan] | Places[SubscriptionPlan] | Places[ServicePlan]:
        """Return the places of a kind of entity."""
        found: Places[PublisherPlan] | Places[SubscriptionPlan] | Places[ServicePlan]
        found = getattr(self, KIND[kind].key)
        return found

    @property
    def outside_ros(self) -> bool:
        """Whether some endpoint has the name of a topic in DDS that ROS does not have."""
        return any(not plan.topic.startswith("/") for plan in self.subscriptions.declared)

    @property
    def names_mode(self) -> str:
        """`declared` or `pool`: where names of nodes and publishers come from."""
        return "declared" if self.declared else "pool"

    @property
    def logger_name_size(self) -> int:
        """Bytes of the longest logger name of a node, namespace.name, with its NUL."""
        if not self.declared:
            return 2 * self.name_size
        return 1 + max((len(node.logger_name) for node in self.nodes.declared), default=0)

    @property
    def serves(self) -> bool:
        """Whether there are places of services or of clients."""
        return self.services.any or self.clients.any

    @property
    def served(self) -> tuple[ServicePlan, ...]:
        """The declared services, then clients, in the order of their places."""
        return (*self.services.declared, *self.clients.declared)

    @property
    def service_text_max(self) -> int:
        """Bytes of the longest name of a declared service or client, or of its type."""
        return max((len(text) for s in self.served for text in (s.name, s.dds_type)), default=0)

    @property
    def describes_sized(self) -> bool:
        """Whether descriptions copy names by their sizes: a quarter of the time, and 112 bytes more code."""
        return len(self.served) >= SIZED_SERVICES

    @property
    def limits_services(self) -> bool:
        """Whether what some declared service or client sends has its own limits."""
        return any(s.limited for s in self.served)

    @property
    def stores_of_services(self) -> bool:
        """Whether the library has storage for messages of some declared service."""
        return any(service.stored for service in self.services.declared)

    @property
    def stores_of_clients(self) -> bool:
        """Whether the library has storage for messages of some declared client."""
        return any(client.stored for client in self.clients.declared)

    @property
    def service_storage_headers(self) -> tuple[str, ...]:
        """Headers with the storage of messages of declared services and clients, sorted."""
        return tuple(sorted({message.header for s in self.served for message in s.stored}))

    @property
    def node_places(self) -> int:
        """Places of nodes; a table needs one place at least."""
        return max(self.nodes.max, 1)

    @property
    def publisher_places(self) -> int:
        """Places of publishers, which come first among the endpoints; a table needs one place at least."""
        receives = self.subscriptions.any or self.serves
        return max(self.publishers.max, 0 if receives else 1)

    @property
    def endpoints(self) -> tuple[EndpointRow, ...]:
        """The declared endpoints in the order of their places, with the places that nobody declared."""
        declared = self.publishers.declared
        publishers = [EndpointRow(p.topic, p.dds_type, p.node, p.limited, p.declared_as) for p in declared]
        subscriptions = [
            EndpointRow(s.topic, s.dds_type, s.node, declared_as=s.declared_as)
            for s in self.subscriptions.declared
        ]
        rows = publishers + [EndpointRow()] * (self.publisher_places - len(publishers))
        subscriptions += [EndpointRow()] * (self.subscriptions.max - len(subscriptions))
        services = [EndpointRow(s.name, s.dds_type, s.node, s.limited, s.declared_as) for s in self.served]
        return (*rows, *subscriptions, *services)

    @property
    def remaps(self) -> bool:
        """Whether some name of the source is another one on the wire."""
        nodes = any(node.given_name for node in self.nodes.declared)
        return nodes or any(row.declared_as for row in self.endpoints)

    @property
    def source_members(self) -> SourceMembers:
        """Where the names of the source are: without `remap:` those on the wire."""
        if self.remaps:
            return SourceMembers("given_name", "given_namespace", "given")
        return SourceMembers("name", "namespace_", "name")

    @property
    def stored_subscriptions(self) -> tuple[SubscriptionPlan, ...]:
        """The declared subscriptions to whose messages the library binds storage."""
        return tuple(s for s in self.subscriptions.declared if s.stored)

    @property
    def limited_headers(self) -> tuple[str, ...]:
        """Headers that declare the types of senders with their own limits; empty if there are no such senders."""
        senders: list[PublisherPlan | ServicePlan] = [
            *self.publishers.declared,
            *self.served,
        ]
        headers = {type_files(s.type).type_support for s in senders if s.limited}
        return tuple(sorted(map(include_path, headers)))
