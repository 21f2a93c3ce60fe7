# SPDX-License-Identifier: Apache-2.0
"""The node of a mode manager; docs/howto/modes.md is its contract."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.diagnosis import (
    TOPIC,
    TYPE,
    Row,
    array_of,
    read_others,
    read_statuses,
    rows_of,
)
from microros_gen.mode_manager.links import PartLink
from microros_gen.mode_manager.messages import values_of
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.mode_manager.parent_values import takers
from microros_gen.mode_manager.problems import Problems, ProblemSource
from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.served import ServedPart
from microros_gen.mode_manager.served_values import ServedValues
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import Model
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

CLIENTS_TOPIC = "/microros_agent/client_states"
CLIENTS_TYPE = "microros_agent_msgs/msg/ClientState"
_CONNECTED = 0
_LOOK_S = 0.5
_DIAGNOSE_S = 1.0
_SOONEST_S = 0.2
_WAIT_S = 0.1


class ModeManager(Serving):
    """Manages the parts of a scope on the node of a peer, in the thread that calls `turn`."""

    def __init__(
        self,
        peer: Peer,
        model: Model,
        scope: Scope,
        report: Callable[[str], object],
        settings: Settings | None = None,
        sources: Sequence[ProblemSource] = (),
    ) -> None:
        """`report` gets lines for the log; `sources` observe parts.

        Raises RosError if the node cannot have a service.
        """
        super().__init__(peer, report)
        self.orchestrator = Orchestrator(model, scope, time.monotonic, settings, report)
        parts = [*scope.systems, *(leaf for leaf in scope.leaves if not leaf.is_system)]
        self._served = {part.name: ServedPart(peer, self.orchestrator, part) for part in parts}
        for name in takers(model, scope):
            ServedValues(peer, self.orchestrator, name)
        self._links = {
            name: PartLink(peer, self.orchestrator, leaf) for name, leaf in self.orchestrator.leaves.items()
        }
        self._levels = {name: leaf.part.diagnostics for name, leaf in self.orchestrator.leaves.items()}
        self._parts = frozenset(model.parts)
        self._problems = Problems(self.orchestrator, sources)
        self._graph = peer.graph()
        self._lost: dict[str, frozenset[str]] = {}
        self._looked = self._diagnosed = -1e9
        self._rows: tuple[Row, ...] = ()
        self._diagnostics = peer.publisher(TOPIC, TYPE)
        peer.subscribe(TOPIC, TYPE, self._diagnostic, Qos(depth=100))
        peer.subscribe(
            "/parameter_events", "rcl_interfaces/msg/ParameterEvent", self._parameters, Qos(depth=1000)
        )
        peer.subscribe(CLIENTS_TOPIC, CLIENTS_TYPE, self._client_state, Qos(transient_local=True, depth=100))

    def turn(self) -> None:
        """Wait for messages for at most 0.1 s, and do what follows from them."""
        self._spin(_WAIT_S)
        now = time.monotonic()
        if now - self._looked >= _LOOK_S:
            self._looked = now
            self._attempt(lambda: self._look(now))
        self._problems.step()
        for call in self.orchestrator.turn():
            self._attempt(partial(self._links[call.part].send, call))
        for link in self._links.values():
            self._attempt(link.step)
        for announcement in self.orchestrator.announcements():
            self._attempt(partial(self._served[announcement.part].publish, announcement))
        self._diagnose(now)

    def _look(self, now: float) -> None:
        """Find out which parts there are."""
        nodes = frozenset(self._graph.nodes())
        lost = {name for names in self._lost.values() for name in names}
        for name, link in self._links.items():
            leaf = self.orchestrator.leaves[name]
            link.look(self._graph, nodes, now, f"/{name}" in lost)
            if leaf.link in (Link.PARAMETERS, Link.PLAIN):
                self._served[name].serve_modes()
            elif leaf.link is Link.MODES:
                self._served[name].leave_modes()

    def _diagnose(self, now: float) -> None:
        """Publish the diagnosis once a second, and soon after changes."""
        since = now - self._diagnosed
        if since < _SOONEST_S:
            return
        rows = rows_of(self.orchestrator)
        if rows != self._rows or since >= _DIAGNOSE_S:
            self._rows, self._diagnosed = rows, now
            self._diagnostics.publish(array_of(rows))

    def _diagnostic(self, message: dict[str, Any]) -> None:
        for status in read_statuses(message, self._levels):
            self._problems.report(status)
        for other in read_others(message, self._parts):
            self.orchestrator.diagnosed.hear_outside(other.hardware, other.name, other.level)

    def _parameters(self, event: dict[str, Any]) -> None:
        leaf = self.orchestrator.leaves.get(event["node"].lstrip("/"))
        if leaf is None or leaf.link not in (Link.PARAMETERS, Link.PLAIN, Link.MODES):
            return
        values = values_of([*event["new_parameters"], *event["changed_parameters"]])
        values.update(dict.fromkeys(p["name"] for p in event["deleted_parameters"]))
        self.orchestrator.hear_parameters(leaf.name, values)

    def _client_state(self, state: dict[str, Any]) -> None:
        """Note which nodes are away with their client, as the agent knows it."""
        is_away = state["presence"] != _CONNECTED
        self._lost[state["key"]] = frozenset(state["nodes"]) if is_away else frozenset()
        self._looked = -1e9
