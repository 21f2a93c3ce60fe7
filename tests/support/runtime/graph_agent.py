# SPDX-License-Identifier: Apache-2.0
"""The agent of serving_agent.py and a graph server: answers of the real one about a graph of the test."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.graph_server.answers import list_endpoints, list_names
from microros_gen.graph_server.status import Arrivals, endpoint_status
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from microros_gen.ros.graph import GraphEndpoint, Names
from tests.support.runtime.serving_agent import ServingAgent

LITTLE = b"\0\1\0\0"
SERVICES = ("ListNames", "ListEndpoints", "EndpointStatus")
"""Clients of the first node, in the order of both component.yaml."""


@dataclass
class MadeGraph:
    """What microros_gen.ros.graph.Graph tells, by hand."""

    node_names: tuple[str, ...] = ()
    enclaves: dict[str, str] = field(default_factory=dict)
    topic_names: Names = ()
    dds_names: Names = ()
    service_names: Names = ()
    of_node: dict[tuple[str, str], Names] = field(default_factory=dict)
    publishing: dict[str, tuple[GraphEndpoint, ...]] = field(default_factory=dict)
    subscribing: dict[str, tuple[GraphEndpoint, ...]] = field(default_factory=dict)
    servers: dict[str, int] = field(default_factory=dict)
    clients: dict[str, int] = field(default_factory=dict)

    def nodes(self) -> tuple[str, ...]:
        return self.node_names

    def nodes_with_enclaves(self) -> tuple[tuple[str, str], ...]:
        return tuple((name, self.enclaves.get(name, "/")) for name in self.node_names)

    def topics(self, demangle: bool = True) -> Names:
        return self.topic_names if demangle else self.dds_names

    def services(self) -> Names:
        return self.service_names

    def publishers_of(self, node: str, demangle: bool = True) -> Names | None:
        return self.of_node.get(("publishers" if demangle else "dds publishers", node))

    def subscriptions_of(self, node: str, demangle: bool = True) -> Names | None:
        return self.of_node.get(("subscriptions" if demangle else "dds subscriptions", node))

    def services_of(self, node: str) -> Names | None:
        return self.of_node.get(("services", node))

    def clients_of(self, node: str) -> Names | None:
        return self.of_node.get(("clients", node))

    def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
        return self.publishing.get(topic, ())

    def subscriptions(self, topic: str) -> tuple[GraphEndpoint, ...]:
        return self.subscribing.get(topic, ())

    def count_servers(self, service: str) -> int:
        return self.servers.get(service, 0)

    def count_clients(self, service: str) -> int:
        return self.clients.get(service, 0)


@dataclass
class GraphAgent(ServingAgent):
    """`requests` are what the server was asked; without `server` requests get no response.

    `first_client` is the index of the first client of the graph on the wire, `reader` that of the subscription of
    changes. `change` gets each response before it is encoded, and `damage` its bytes. Requests are appended to
    `held`, if it is a list, and get their responses by `release`. A server that starts again has another `instance` and
    other `arrivals`.
    """

    graph: MadeGraph = field(default_factory=MadeGraph)
    version: int = 1
    first_client: int = 0
    reader: int = 0
    server: bool = True
    instance: int = 77
    arrivals: Arrivals = field(default_factory=Arrivals)
    held: list[bytes] | None = None
    requests: list[tuple[str, dict[str, Any]]] = field(default_factory=list)
    change: Callable[[dict[str, Any]], dict[str, Any]] = lambda response: response
    damage: Callable[[bytes], bytes] = lambda body: body
    codec: Codec = field(default_factory=lambda: graph_codec())

    def notice(self) -> list[bytes]:
        """Return the datagrams of a notice that the graph has changed."""
        self.version += 1
        return self.offer(self.reader, self.version.to_bytes(4, "little"))

    def _write(self, payload: bytes) -> None:
        super()._write(payload)
        if payload[2:4] not in self.objects or payload[3] & 15 != 7 or not self.server:
            return
        if self.held is not None:
            self.held.append(payload)
        else:
            self._respond(payload)

    def release(self) -> list[bytes]:
        """Return the datagrams with the responses to the requests that are held; later ones are answered at once."""
        held, self.held = self.held or [], None
        for payload in held:
            self._respond(payload)
        return [datagram for payload in held for datagram in self._kept(self._flow(payload[2:4]))]

    def _answer(self, name: str, request: dict[str, Any]) -> dict[str, Any]:
        graph: Any = self.graph
        if name == "EndpointStatus":
            return endpoint_status(graph, request, self.instance, self.arrivals)
        answer = list_names if name == "ListNames" else list_endpoints
        return answer(graph, request, lambda _question, _answer: self.version)

    def _respond(self, payload: bytes) -> None:
        place = (int.from_bytes(payload[2:4], "big") >> 4) - self.first_client
        if not 0 <= place < len(SERVICES):
            return
        name = SERVICES[place]
        kind = f"microros_graph_msgs/srv/{name}"
        request = self.codec.decode(f"{kind}_Request", LITTLE + payload[4:])
        self.requests.append((name, request))
        response = self.change(self._answer(name, request))
        body = self.codec.encode(f"{kind}_Response", response)[ENCAPSULATION_BYTES:]
        self.history.setdefault(payload[2:4], []).append(payload[:2] + payload[2:4] + self.damage(body))


def endpoint(node: str, number: int = 1, **changed: Any) -> GraphEndpoint:
    """Return a publisher or subscription of a topic of Int32; `number` is in its GID."""
    values: dict[str, Any] = {
        "node": node,
        "type": "std_msgs/msg/Int32",
        "hash_version": 1,
        "hash": bytes(range(32)),
        "gid": bytes([number] * 16),
        "reliability": 1,
        "durability": 2,
        "history": 3,
        "liveliness": 1,
        "depth": 7,
        "deadline": 2_500_000_000,
        "lifespan": 9223372036854775807,
        "lease": 0,
    }
    return GraphEndpoint(**(values | changed))


def graph_codec() -> Codec:
    """Return a codec of the services of the graph server."""
    names = tuple(Named(f"microros_graph_msgs/srv/{name}", None) for name in SERVICES)
    return Codec(
        resolve_interfaces(names, InterfaceFinder.from_environment((shipped_folder(),)), Diagnostics())
    )
