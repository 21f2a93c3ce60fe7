# SPDX-License-Identifier: Apache-2.0
"""Which of several managers of one part manages: the one that does so already, and of two the lower name.

A manager that manages publishes on ~/transition_request_info of each of its parts; that is its claim. A manager that
is killed stays in the ROS graph for a while, so that one that claims a part is asked whether it is there.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Protocol

from microros_gen.mode_manager.scope import Scope
from microros_gen.mode_manager.server import ModeManager
from microros_gen.ros.graph import Graph
from microros_gen.ros.peer import Peer

NAME = "mode_manager_"
"""Nodes of managers are called so, with a number of 8 hexadecimal digits."""
DISCOVERY_S = 3.0
"""Managers that there are already are known by then."""
LOOK_S = 1.0
SILENCE_S = 5.0
"""A manager that does not answer for so long has been killed."""
LEASE_S = 30.0
"""By then DDS knows that too."""


class Observer(Protocol):
    """Receives the changes of who manages."""

    def waits(self, other: str, part: str) -> None:
        """Handle that another manager, the node `other`, manages `part`."""

    def ready(self) -> None:
        """Handle that this manager manages from now on."""


class Claims:
    """The claims of other managers for the parts of a scope. Pure, apart from the graph that it is given."""

    def __init__(self, scope: Scope, own: str, clock: Callable[[], float]) -> None:
        """`own` is the fully qualified name of the own node; `clock` gives seconds."""
        self._parts = [*scope.systems, *(leaf for leaf in scope.leaves if not leaf.is_system)]
        self._own = own
        self._clock = clock
        self._dead: dict[str, float] = {}

    def bury(self, node: str) -> None:
        """Note that a manager does not answer: its claim counts no longer, until the graph should know that."""
        self._dead[node] = self._clock()

    def other(self, graph: Graph, is_managing: bool) -> tuple[str, str]:
        """Return a manager because of which this one must not manage, and the part; empty texts without such a manager.

        Nodes with other names than those of this tool, such as the manager of system_modes, never yield.
        """
        for part in self._parts:
            for endpoint in graph.publishers(f"/{part.name}/transition_request_info"):
                node = endpoint.node
                is_dead = self._clock() - self._dead.get(node, -1e9) < LEASE_S
                yields = is_managing and node.startswith(f"/{NAME}") and node > self._own
                if node != self._own and not is_dead and not yields:
                    return node, part.name
        return "", ""


class ManagerInTurn:
    """`run` manages and waits until `stop`, which any thread or signal handler may call."""

    def __init__(
        self,
        scope: Scope,
        make_peer: Callable[[str], AbstractContextManager[Peer]],
        make_manager: Callable[[Peer], ModeManager],
        observer: Observer,
    ) -> None:
        """`make_peer` gives a node with a name; `make_manager` the manager on it."""
        self._scope = scope
        self._make_peer = make_peer
        self._make_manager = make_manager
        self._observer = observer
        self._name = f"{NAME}{random.getrandbits(32):08x}"
        self._stopped = False
        self._reported = ""

    def stop(self) -> None:
        """Let `run` end within a second."""
        self._stopped = True

    def run(self) -> None:
        """Manage in turn."""
        claims = Claims(self._scope, f"/{self._name}", time.monotonic)
        while not self._stopped:
            with self._make_peer(self._name) as peer:
                self._wait(peer, claims)
                if not self._stopped:
                    self._manage(peer, claims)

    def _wait(self, peer: Peer, claims: Claims) -> None:
        graph, free_since = peer.graph(), time.monotonic()
        while not self._stopped and time.monotonic() - free_since < DISCOVERY_S:
            peer.spin(lambda: self._stopped, 0.2)
            other, part = claims.other(graph, is_managing=False)
            if not other:
                continue
            self._wait_for(other, part)
            if self._answers(peer, part):
                free_since = time.monotonic()
            else:
                claims.bury(other)

    def _answers(self, peer: Peer, part: str) -> bool:
        """Return whether the manager of a part answers; it then waits for a second."""
        client = peer.client(f"/{part}/get_available_modes", "system_modes_msgs/srv/GetAvailableModes")
        try:
            answers = client.call({}, SILENCE_S) is not None
            peer.spin(lambda: self._stopped, LOOK_S)
            return answers or self._stopped
        finally:
            peer.remove(client)

    def _manage(self, peer: Peer, claims: Claims) -> None:
        manager = self._make_manager(peer)
        graph, looked = peer.graph(), time.monotonic()
        self._observer.ready()
        self._reported = ""
        while not self._stopped:
            manager.turn()
            if time.monotonic() - looked >= LOOK_S:
                looked = time.monotonic()
                other, part = claims.other(graph, is_managing=True)
                if other:
                    self._wait_for(other, part)
                    return

    def _wait_for(self, other: str, part: str) -> None:
        if other != self._reported:
            self._observer.waits(other, part)
            self._reported = other
