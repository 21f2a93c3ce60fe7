# SPDX-License-Identifier: Apache-2.0
"""The bridge on rclpy and rmw_fastrtps_cpp: one context per domain, a bare node per participant, raw endpoints.

Nodes and what they have are rclpy's handles, not its `Node` class: a client's node shows in the graph with what
the client declared, without parameter services and their topics, and takes 2 KiB instead of 450. Types are those of
`raw_types`: no Python package of them is needed, none is imported.
"""

from __future__ import annotations

import importlib
import os
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from microros_gen.agent.ros.bridge import (
    Bridge,
    BridgeError,
    GraphReport,
    HashOf,
    HashUnknown,
    Node,
    OtherDomain,
    Source,
)
from microros_gen.agent.ros.client_graph import ClientGraph
from microros_gen.agent.ros.domains import DOMAIN_OF_AGENT, own_domain
from microros_gen.agent.ros.endpoints import Ros
from microros_gen.agent.ros.graph import Comparison, TopicTypes
from microros_gen.agent.ros.names import ros_node
from microros_gen.agent.ros.node import RawNode
from microros_gen.agent.ros.services import Patience
from microros_gen.agent.ros.wakeups import Watcher
from microros_gen.agent.wire.constants import Status
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.ros.errors import RosUnusableError
from microros_gen.ros.libraries import FAILURES, Libraries, first_line
from microros_gen.ros.loading import load_rclpy
from microros_gen.ros.raw_types import MAXIMUM_HANDLES, raw_types

MAXIMUM_DOMAIN = 232
"""Largest ROS domain id: larger ones would need UDP ports above 65,535 (RTPS 2.2, 9.6.1)."""
OWN_NODE = "_microros_agent"
"""Start of the name of the agent's own node in a domain; `ros2 node list` leaves out names with an underscore."""
TRIM_AFTER, TRIM_EVERY_S = 64, 30.0
"""Nodes that have left since free memory was returned to the system, and the least time in between: it takes some
milliseconds. What Fast DDS frees lies between what it has in use, and glibc keeps it."""


def open_bridge(
    maximum_domains: int,
    domain: int | None = None,
    hash_of: HashOf | None = None,
    report: Callable[[GraphReport], None] | None = None,
    request_wait_s: float = 5.0,
    on_type: Callable[[str], object] | None = None,
) -> Bridge:
    """Return the bridge. Raises UserError if rclpy is missing, does not load, or has the wrong version.

    `domain` (0 to 232) puts every client into that ROS domain, whichever it asks for. `hash_of` knows type hashes;
    without one for a type, its endpoints announce none. `report` is told what happens in the ROS graph. A request waits
    `request_wait_s` for its service. `on_type` is called with the type of each endpoint of a client.
    """
    try:
        handles = load_rclpy()
        types = raw_types()
    except RosUnusableError as error:
        raise UserError([Diagnostic(f"the agent {error.reason}", hint=error.hint, id="MG-9427")]) from error
    types.libraries.hurry_writers()
    return RclpyBridge(
        handles,
        Ros(types, report or _ignore, request_wait_s),
        maximum_domains,
        domain,
        hash_of,
        on_type or _ignore,
    )


def _ignore(_report: object) -> None:
    pass


class RclpyBridge:
    """The bridge: contexts by domain; an unused one stays open until its place is needed."""

    def __init__(
        self,
        handles: Any,
        ros: Ros,
        maximum_domains: int,
        domain: int | None,
        hash_of: HashOf | None,
        on_type: Callable[[str], object],
    ) -> None:
        self._on_type = on_type
        self._handles = handles
        self._ros = ros
        self._domain = domain
        self._hash_of = hash_of
        self._comparison = Comparison(handles, ros.wakeups, ros.report)
        self._patience = Patience(ros.wakeups)
        self._maximum_domains = maximum_domains
        self._contexts: dict[int, _Context] = {}
        self._without_hash: set[str] = set()
        self._reported_domains: set[int] = set()
        self._left = 0
        self._trimmed_at = time.monotonic()

    def create_node(self, name: str, domain: int, hash_of: HashOf | None = None) -> Node:
        """See Bridge."""
        node, namespace = ros_node(name)
        if domain == DOMAIN_OF_AGENT:
            domain = own_domain()
        context = self._context(domain if self._domain is None else self._domain)
        try:
            handle = self._handles.Node(node, namespace, context.handle, None, False, False)
        except FAILURES as error:
            raise BridgeError(f"node '{name}': {first_line(error)}") from error
        context.nodes += 1
        self._report_domain(handle.get_fully_qualified_name(), context.domain)

        def known_hash(type_name: str) -> str | None:
            return self._known_hash(type_name, hash_of)

        return RawNode(
            self._handles,
            handle,
            self._ros,
            known_hash,
            self._comparison,
            self._patience,
            context.domain,
            context.topics,
            context.graph,
            partial(self._leave, context),
        )

    def _report_domain(self, node: str, domain: int) -> None:
        """Report each domain other than ROS_DOMAIN_ID once, unless `domain` was set for all clients."""
        own = own_domain()
        set_here = bool(os.environ.get("ROS_DOMAIN_ID", "").strip())
        if self._domain is None and set_here and domain != own and domain not in self._reported_domains:
            self._reported_domains.add(domain)
            self._ros.report(OtherDomain(node, domain, own))

    def fileno(self) -> int:
        """See Bridge."""
        return self._ros.wakeups.fileno()

    def ready(self) -> list[Source]:
        """See Bridge."""
        sources: list[Source] = []
        for woken in self._ros.wakeups.drain():
            if isinstance(woken, Watcher):
                woken.look()
            else:
                woken.woken()
                sources.append(woken)
        return sources

    def trim(self) -> None:
        """See Bridge."""
        self._ros.libraries.trim_heap(0)

    def close(self) -> None:
        """See Bridge."""
        for context in self._contexts.values():
            context.close()
        self._contexts = {}
        self._ros.close()

    def _leave(self, context: _Context) -> None:
        context.nodes -= 1
        self._left += 1
        if self._left >= TRIM_AFTER and time.monotonic() >= self._trimmed_at + TRIM_EVERY_S:
            self._left, self._trimmed_at = 0, time.monotonic()
            self.trim()

    def _known_hash(self, type_name: str, hash_of: HashOf | None) -> str | None:
        """Return a type's hash from the client's manifest, else from the interface files; report a missing one once."""
        self._on_type(type_name)
        for known in (hash_of, self._hash_of):
            found = known(type_name) if known else None
            if found is not None:
                return found
        if (
            self._hash_of
            and type_name not in self._without_hash
            and len(self._without_hash) < MAXIMUM_HANDLES
        ):
            self._without_hash.add(type_name)
            self._ros.report(HashUnknown(type_name))
        return None

    def _context(self, domain: int) -> _Context:
        if not 0 <= domain <= MAXIMUM_DOMAIN:
            raise BridgeError(f"domain {domain} does not exist (0 to {MAXIMUM_DOMAIN})", Status.INVALID_DATA)
        if domain not in self._contexts:
            self._make_room()
            self._contexts[domain] = _Context(self._handles, domain, self._ros.libraries)
        return self._contexts[domain]

    def _make_room(self) -> None:
        if len(self._contexts) < self._maximum_domains:
            return
        unused = next((d for d, context in self._contexts.items() if not context.nodes), None)
        if unused is None:
            raise BridgeError(f"{self._maximum_domains} domains are in use", Status.RESOURCES)
        self._contexts.pop(unused).close()


class _Context:
    """A ROS context. Its own node, hidden by its name, keeps the DDS participant: that goes with the last node, and
    until others discover a new one some seconds pass, which a client that comes back would have to wait."""

    def __init__(self, handles: Any, domain: int, libraries: Libraries) -> None:
        context_class = importlib.import_module("rclpy.context").Context
        self._context = context_class()
        self.domain = domain
        self.nodes = 0
        self.topics = TopicTypes()
        try:
            self._context.init(args=[], domain_id=domain, initialize_logging=False)
            self.handle = self._context.handle
            self._own = handles.Node(f"{OWN_NODE}_{os.getpid()}", "/", self.handle, None, False, False)
            self.graph = ClientGraph(handles, self.handle, self._own, libraries)
        except FAILURES as error:
            raise BridgeError(f"domain {domain}: {first_line(error)}") from error

    def close(self) -> None:
        self._own.destroy_when_not_in_use()
        self._context.try_shutdown()
        self._context.destroy()
