# SPDX-License-Identifier: Apache-2.0
"""How a manager reaches one part: its services, and the events that it publishes."""

from __future__ import annotations

from typing import Any

from microros_gen.mode_manager.calls import Call, Kind, Link
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.messages import (
    MODE_EVENT,
    SERVICES,
    TRANSITION_EVENT,
    facts_of,
    request_of,
    state_of,
)
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.ros.endpoints import Client
from microros_gen.ros.graph import Graph
from microros_gen.ros.peer import Peer

SETTLE_S = 1.0
"""From the discovery of a node to that of all of its services."""
_VALUES = (Kind.GET_PARAMETERS, Kind.SET_PARAMETERS)
PLAIN_S = 4.0
"""A node without a life cycle for so long has none."""


class PartLink:
    """The clients and subscriptions for a leaf."""

    def __init__(self, peer: Peer, manager: Orchestrator, leaf: Leaf) -> None:
        self._peer = peer
        self._manager = manager
        self._leaf = leaf
        self._clients: dict[Kind, Client] = {}
        self._waiting: Call | None = None
        self._sent: tuple[Client, int] | None = None
        self._since: float | None = None
        name = leaf.name
        peer.subscribe(f"/{name}/transition_event", TRANSITION_EVENT, self._state_event)
        peer.subscribe(f"/{name}/mode_event", MODE_EVENT, self._mode_event)

    def look(self, graph: Graph, nodes: frozenset[str], now: float, is_lost: bool) -> None:
        """Find out how the part can be reached; `is_lost`: its agent says that it is away."""
        found = Link.ABSENT if is_lost else self._found(graph, nodes, now)
        serves_parameters = found in (Link.MODES, Link.SYSTEM) and self._serves_parameters(graph)
        if found is None or (found, serves_parameters) == (self._leaf.link, self._leaf.serves_parameters):
            return
        for kind in (*_kinds(found), *(_VALUES if serves_parameters else ())):
            self._client(kind)
        if found is Link.ABSENT:
            self._since = None
            self._drop()
        self._manager.link(self._leaf.name, found, serves_parameters)

    def send(self, call: Call) -> None:
        """Send a request as soon as the service is there."""
        self._drop()
        self._waiting = call
        self.step()

    def step(self) -> None:
        """Send what waits."""
        call = self._waiting
        if call is None:
            return
        client = self._client(call.kind)
        if not client.available():
            return
        self._waiting = None
        names = self._leaf.parameters
        number = client.send(
            request_of(call, names, self._leaf.byte_arrays),
            lambda response: self._manager.answer(call, **facts_of(call, response, names)),
        )
        self._sent = client, number

    def _found(self, graph: Graph, nodes: frozenset[str], now: float) -> Link | None:
        """Return how the part is reached; None: that is not clear yet."""
        name = f"/{self._leaf.name}"
        if self._leaf.part.is_system:
            return self._found_system(graph, now)
        if name not in nodes:
            return Link.ABSENT
        if self._since is None:
            self._since = now
            for kind in _kinds(Link.PARAMETERS):
                self._client(kind)
        if now - self._since < SETTLE_S:
            return None
        services = {service for service, _ in graph.services_of(name) or ()}
        if f"{name}/change_state" in services:
            return Link.MODES if f"{name}/change_mode" in services else Link.PARAMETERS
        is_plain = f"{name}/set_parameters_atomically" in services and now - self._since >= PLAIN_S
        return Link.PLAIN if is_plain else None

    def _found_system(self, graph: Graph, now: float) -> Link | None:
        """Return whether another manager has it; if it takes values, its services for them are waited for."""
        if not graph.count_servers(f"/{self._leaf.name}/change_mode"):
            return Link.ABSENT
        self._since = now if self._since is None else self._since
        is_early = bool(self._leaf.parameters) and now - self._since < SETTLE_S
        return None if is_early and not self._serves_parameters(graph) else Link.SYSTEM

    def _serves_parameters(self, graph: Graph) -> bool:
        names = (f"/{self._leaf.name}/{kind.value}" for kind in _VALUES)
        return all(graph.count_servers(name) for name in names)

    def _client(self, kind: Kind) -> Client:
        client = self._clients.get(kind)
        if client is None:
            client = self._peer.client(f"/{self._leaf.name}/{kind.value}", SERVICES[kind])
            self._clients[kind] = client
        return client

    def _drop(self) -> None:
        """Do not wait for the response to an earlier request."""
        self._waiting = None
        if self._sent is not None:
            self._sent[0].forget(self._sent[1])
            self._sent = None

    def _state_event(self, event: dict[str, Any]) -> None:
        self._manager.hear_state(self._leaf.name, state_of(event["goal_state"]))

    def _mode_event(self, event: dict[str, Any]) -> None:
        if self._leaf.link in (Link.MODES, Link.SYSTEM):
            self._manager.hear_mode(self._leaf.name, event["goal_mode"]["label"])


def _kinds(link: Link) -> tuple[Kind, ...]:
    """Return the services that are used."""
    own = {
        Link.PARAMETERS: (Kind.GET_STATE, Kind.CHANGE_STATE, Kind.GET_PARAMETERS, Kind.SET_PARAMETERS),
        Link.PLAIN: (Kind.GET_PARAMETERS, Kind.SET_PARAMETERS),
    }
    modes = (Kind.GET_STATE, Kind.CHANGE_STATE, Kind.GET_MODE, Kind.CHANGE_MODE)
    return () if link is Link.ABSENT else own.get(link, modes)
