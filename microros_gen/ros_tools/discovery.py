# SPDX-License-Identifier: Apache-2.0
"""Looks into the ROS graph of a node that has just started: other nodes are discovered little by little.

The ros2 command line keeps a daemon for this. Here a command waits until what it needs is discovered; one that lists,
until the graph has not changed for a while.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from typing import TypeVar

from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.ros.graph import Graph, GraphEndpoint, Names
from microros_gen.ros.peer import Peer

DEFAULT_WAIT_S = 3.0
"""Longest wait for what is looked for."""
_FIRST_S = 1.0
"""A graph is not complete before: participants announce themselves five times within half a second, then answer."""
_QUIET_S = 0.4
"""Without a change for this time, a graph in which other nodes were discovered is likely to be complete."""
_TURN_S = 0.05
_LONGEST_TURN_S = 2 * _TURN_S
"""What a turn counts at most: on a busy machine a process stands still for seconds, in which it discovers nothing."""
_LONGEST = 3
"""How many times the longest wait a search lasts at most, by the clock."""
_PROOFS = {"get_state": "lifecycle_msgs/srv/GetState", "get_parameters": "rcl_interfaces/srv/GetParameters"}
"""Services that a node itself serves, and their types: they may be discovered before its name."""
Found = TypeVar("Found")
_ACTION = "/_action/"


class Discovery:
    """The graph as one command sees it. `wait_s` is the longest wait, in seconds."""

    def __init__(self, peer: Peer, wait_s: float = DEFAULT_WAIT_S) -> None:
        """Watch the graph of `peer`, which has been created just before."""
        self._peer = peer
        self._wait_s = wait_s
        self._waited = 0.0
        self._began = self._changed = time.monotonic()
        self.graph: Graph = peer.graph()
        peer.on_graph_change(self._note)

    def _note(self) -> None:
        self._changed = time.monotonic()

    @property
    def own_node(self) -> str:
        """The node of the command, which lists leave out."""
        return self._peer.name

    def settle(self) -> None:
        """Spin until the graph is likely to be complete, for at most `wait_s` seconds."""
        while not self._settled():
            self._turn()

    def _turn(self) -> None:
        """Spin for a moment, and count the time in which something could be discovered."""
        began = time.monotonic()
        self._peer.spin_once(_TURN_S)
        self._waited += min(time.monotonic() - began, _LONGEST_TURN_S)

    def _settled(self) -> bool:
        now = time.monotonic()
        if self._waited >= self._wait_s or now - self._began >= _LONGEST * self._wait_s:
            return True
        quiet = now - self._began >= _FIRST_S and now - self._changed >= _QUIET_S
        return quiet and any(name != self.own_node for name in self.graph.nodes())

    def find(
        self, look: Callable[[], Found | None], given_up: Callable[[], object] | None = None
    ) -> Found | None:
        """Spin until `look` returns something, for at most `wait_s` seconds; return it, or None.

        That other nodes are discovered says nothing about the one that is looked for: the whole time is waited.
        With `given_up`, wait until that is true instead. Time in which this process stood still does not count, and a
        graph that is still changing is waited for, both for at most `_LONGEST` times as long.
        """
        end, waited = time.monotonic() + _LONGEST * self._wait_s, self._waited
        while (found := look()) is None:
            if self._is_over(self._waited - waited, end) if given_up is None else given_up():
                break
            self._turn()
        return found

    def _is_over(self, waited: float, end: float) -> bool:
        now = time.monotonic()
        return now >= end or (waited >= self._wait_s and now - self._changed >= _QUIET_S)

    def topics(self, hidden: bool = False) -> Names:
        """Return all topics of ROS after `settle`; `hidden` ones have a part that begins with `_`."""
        self.settle()
        return tuple(entry for entry in self.graph.topics() if hidden or not is_hidden(entry[0]))

    def services(self, hidden: bool = False) -> Names:
        """Return all services that have a server after `settle`, as `topics` does."""
        self.settle()
        found = self.graph.services()
        return tuple(e for e in found if hidden or not is_hidden(e[0]))

    def nodes(self, hidden: bool = False) -> tuple[str, ...]:
        """Return all other nodes after `settle`; a name that two nodes share is listed twice."""
        self.settle()
        found = list(self.graph.nodes())
        if self.own_node in found:
            found.remove(self.own_node)
        return tuple(name for name in found if hidden or not is_hidden(name))

    def topic_types(self, topic: str, given_up: Callable[[], object] | None = None) -> tuple[str, ...] | None:
        """Return the types of a topic as soon as it is discovered, None if it is not; `given_up` as for `find`."""
        return self.find(lambda: dict(self.graph.topics()).get(topic), given_up)

    def service_types(self, service: str) -> tuple[str, ...] | None:
        """Return the types of a service as soon as it is discovered, None if it is not."""
        return self.find(lambda: dict(self.graph.services()).get(service))

    def has_node(self, node: str) -> bool:
        """Return whether a node of this name is discovered in time."""
        return bool(self.find(lambda: node in self.graph.nodes() or self._serves_own(node) or None))

    def _serves_own(self, node: str) -> bool:
        """Return whether a service is there that a node of this name has for itself."""
        services = dict(self.graph.services())
        return any(type_name in services.get(f"{node}/{name}", ()) for name, type_name in _PROOFS.items())

    def publishers(self, topic: str) -> tuple[GraphEndpoint, ...]:
        """Return the publishers of a topic."""
        return self.graph.publishers(topic)

    def require_node(self, node: str) -> None:
        """Raise UserError with a proposal if a node is not discovered in time."""
        if not self.has_node(node):
            raise unknown_node(node, self.nodes(hidden=True))


def unknown_node(name: str, names: Iterable[str]) -> UserError:
    """Return the error for a node that is not in the graph; the hint proposes one of `names`, or how to list them."""
    message = f"unknown node '{name}'"
    return UserError([Diagnostic(message, hint=_proposal("node", name, names), id="MG-9811")], status=1)


def unknown_topic(name: str, names: Iterable[str]) -> UserError:
    """Return the error for a topic that is not in the graph, as `unknown_node` does."""
    message = f"unknown topic '{name}'"
    return UserError([Diagnostic(message, hint=_proposal("topic", name, names), id="MG-9812")], status=1)


def unknown_service(name: str, names: Iterable[str]) -> UserError:
    """Return the error for a service that is not in the graph, as `unknown_node` does."""
    message = f"unknown service '{name}'"
    return UserError([Diagnostic(message, hint=_proposal("service", name, names), id="MG-9813")], status=1)


def unknown_action(name: str, names: Iterable[str]) -> UserError:
    """Return the error for an action that is not in the graph, as `unknown_node` does."""
    message = f"unknown action '{name}'"
    return UserError([Diagnostic(message, hint=_proposal("action", name, names), id="MG-9824")], status=1)


def _proposal(what: str, name: str, names: Iterable[str]) -> str:
    return nearest(name, names) or f"List them with: microros-gen {what} list"


def is_hidden(name: str) -> bool:
    """Return whether ROS 2 hides a name: one of its parts begins with `_`."""
    return any(part.startswith("_") for part in name.split("/"))


def absolute(name: str) -> str:
    """Return a name as seen from the root namespace, where the commands are."""
    return name if name.startswith("/") else f"/{name}"


def action_names(services: Names) -> Names:
    """Return the actions of some services: each has a service `NAME/_action/send_goal` of type `TYPE_SendGoal`."""
    ending = f"{_ACTION}send_goal"
    return tuple(
        (name.removesuffix(ending), tuple(kind.removesuffix("_SendGoal") for kind in types))
        for name, types in services
        if name.endswith(ending)
    )
