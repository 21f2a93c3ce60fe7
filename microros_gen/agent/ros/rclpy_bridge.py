# SPDX-License-Identifier: Apache-2.0
"""The bridge on rclpy and rmw_fastrtps_cpp: one context per domain, a bare node per participant, raw endpoints.

Nodes and what they have are rclpy's handles, not its `Node` class: a client's node shows in the graph with what
the client declared, without parameter services and their topics, and takes 2 KiB instead of 450. Types are those of
`raw_types`: no Python package of them is needed, none is imported.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from typing import Any

from microros_gen.agent.representation.description import Durability, Qos, Service, Topic
from microros_gen.agent.ros.bridge import (
    Bridge,
    BridgeError,
    Node,
    Reader,
    Replier,
    Requester,
    Source,
    Writer,
)
from microros_gen.agent.ros.endpoints import (
    FAILURES,
    RawReader,
    RawReplier,
    RawRequester,
    RawWriter,
    Ros,
    first_line,
)
from microros_gen.agent.ros.libraries import Libraries
from microros_gen.agent.ros.names import ServiceName, TypeName, ros_node, ros_service, ros_topic, ros_type
from microros_gen.agent.ros.raw_types import raw_types
from microros_gen.agent.wire.constants import Status
from microros_gen.diagnostics import Diagnostic, UserError

MAXIMUM_DOMAIN = 232
"""Largest ROS domain id: the ports of larger ones do not exist (RTPS 2.2, 9.6.1)."""
DOMAIN_OF_AGENT = 255
"""Clients that ask for this domain (a convention of the public client) get the agent's own, ROS_DOMAIN_ID."""
RMW = "rmw_fastrtps_cpp"
"""The one RMW implementation whose type supports are made here."""
SERVICE_DEPTH = 1000
"""Requests, and replies, that wait for a client that takes none; ROS 2's default of 10 loses those of a burst."""

HashOf = Callable[[str], "str | None"]
"""Gives the type hash (RIHS01_…) of `pkg/msg/Type`, `pkg/srv/Type`, `pkg/srv/Type_Request` and so on, or None."""


def open_bridge(maximum_domains: int, domain: int | None = None, hash_of: HashOf | None = None) -> Bridge:
    """Return the bridge; UserError when rclpy is missing, does not load, or is not the one that is needed.

    `domain` (0 to 232) puts every client into that ROS domain, whichever it asks for. `hash_of` knows type hashes;
    without one for a type, its publishers and subscriptions announce none.
    """
    handles = _import_rclpy()
    implementation = handles.rclpy_get_rmw_implementation_identifier()
    if implementation != RMW:
        hint = (
            f"Unset RMW_IMPLEMENTATION, or set it to {RMW}; nodes with another one are reached all the same"
        )
        reason = f"the agent needs {RMW}, but RMW_IMPLEMENTATION chooses {implementation}"
        raise UserError([Diagnostic(reason, hint=hint)])
    libraries = Libraries()
    return RclpyBridge(
        handles, Ros(libraries, raw_types(libraries)), maximum_domains, domain, hash_of or _no_hash
    )


def _import_rclpy() -> Any:
    try:
        importlib.import_module("rclpy")
        return importlib.import_module("rclpy.impl.implementation_singleton").rclpy_implementation
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError) and error.name == "rclpy"
        reason = (
            "rclpy (ROS 2) is not installed for this Python" if missing else f"rclpy does not load: {error}"
        )
        hint = "Run: pip install 'microros-gen[ros]', or source a ROS 2 installation"
        raise UserError([Diagnostic(f"the agent needs ROS 2: {reason}", hint=hint)]) from error


def _no_hash(_type_name: str) -> str | None:
    return None


class RclpyBridge:
    """Contexts by domain; one that no node uses stays open until its place is needed."""

    def __init__(
        self, handles: Any, ros: Ros, maximum_domains: int, domain: int | None, hash_of: HashOf
    ) -> None:
        self._handles = handles
        self._ros = ros
        self._domain = domain
        self._hash_of = hash_of
        self._maximum_domains = maximum_domains
        self._contexts: dict[int, _Context] = {}

    def create_node(self, name: str, domain: int, hash_of: HashOf | None = None) -> Node:
        """See Bridge."""
        node, namespace = ros_node(name)
        if domain == DOMAIN_OF_AGENT:
            domain = _own_domain()
        context = self._context(domain if self._domain is None else self._domain)
        try:
            handle = self._handles.Node(node, namespace, context.handle, None, False, False)
        except FAILURES as error:
            raise BridgeError(f"node '{name}': {first_line(error)}") from error
        context.nodes += 1
        return _Node(self._handles, handle, context, self._ros, hash_of or self._hash_of)

    def fileno(self) -> int:
        """See Bridge."""
        return self._ros.wakeups.fileno()

    def ready(self) -> list[Source]:
        """See Bridge."""
        return self._ros.wakeups.drain()

    def close(self) -> None:
        """See Bridge."""
        for context in self._contexts.values():
            context.close()
        self._contexts = {}
        self._ros.close()

    def _context(self, domain: int) -> _Context:
        if not 0 <= domain <= MAXIMUM_DOMAIN:
            raise BridgeError(f"domain {domain} does not exist (0 to {MAXIMUM_DOMAIN})", Status.INVALID_DATA)
        if domain not in self._contexts:
            self._make_room()
            self._contexts[domain] = _Context(domain)
        return self._contexts[domain]

    def _make_room(self) -> None:
        if len(self._contexts) < self._maximum_domains:
            return
        unused = next((d for d, context in self._contexts.items() if not context.nodes), None)
        if unused is None:
            raise BridgeError(f"{self._maximum_domains} domains are in use", Status.RESOURCES)
        self._contexts.pop(unused).close()


class _Context:
    def __init__(self, domain: int) -> None:
        context_class = importlib.import_module("rclpy.context").Context
        self._context = context_class()
        try:
            self._context.init(args=[], domain_id=domain, initialize_logging=False)
        except FAILURES as error:
            raise BridgeError(f"domain {domain}: {first_line(error)}") from error
        self.handle = self._context.handle
        self.nodes = 0

    def close(self) -> None:
        self._context.try_shutdown()
        self._context.destroy()


class _Node:
    def __init__(self, handles: Any, handle: Any, context: _Context, ros: Ros, hash_of: HashOf) -> None:
        self._handles = handles
        self._handle = handle
        self._context = context
        self._ros = ros
        self._hash_of = hash_of
        self.label: str = handle.get_fully_qualified_name()

    def create_writer(self, topic: Topic, qos: Qos) -> Writer:
        name, type_name = ros_topic(topic.name), ros_type(topic.type_name)
        handle = self._create(self._handles.Publisher, self._message_class(type_name), name, _profile(qos))
        return RawWriter(handle, f"{name} [{type_name}]")

    def create_reader(self, topic: Topic, qos: Qos) -> Reader:
        name, type_name = ros_topic(topic.name), ros_type(topic.type_name)
        handle = self._create(self._handles.Subscription, self._message_class(type_name), name, _profile(qos))
        return RawReader(handle, f"{name} [{type_name}]", self._ros)

    def create_replier(self, service: Service) -> Replier:
        name = ros_service(service)
        handle = self._create(self._handles.Service, self._service_class(name), name.name, _service_profile())
        return RawReplier(handle, str(name), self._ros)

    def create_requester(self, service: Service) -> Requester:
        name = ros_service(service)
        handle = self._create(self._handles.Client, self._service_class(name), name.name, _service_profile())
        return RawRequester(handle, str(name), self._ros)

    def destroy(self) -> None:
        self._handle.destroy_when_not_in_use()
        self._context.nodes -= 1

    def _create(self, kind: Any, type_class: Any, name: str, profile: Any) -> Any:
        try:
            return kind(self._handle, type_class, name, profile)
        except FAILURES as error:
            raise BridgeError(f"{kind.__name__.lower()} {name}: {first_line(error)}") from error

    def _message_class(self, name: TypeName) -> Any:
        return self._ros.types.message_class(name, self._hash_of(str(name)))

    def _service_class(self, name: ServiceName) -> Any:
        hashes = [self._hash_of(str(part)) for part in (name.type, name.request, name.response)]
        return self._ros.types.service_class(name, hashes[0], hashes[1], hashes[2])


def _profile(qos: Qos) -> Any:
    module = importlib.import_module("rclpy.qos")
    duration = importlib.import_module("rclpy.duration").Duration
    lasting = qos.durability is not Durability.VOLATILE  # ROS has no more than transient local
    profile = module.QoSProfile(
        reliability=module.ReliabilityPolicy.RELIABLE
        if qos.reliable
        else module.ReliabilityPolicy.BEST_EFFORT,
        durability=module.DurabilityPolicy.TRANSIENT_LOCAL if lasting else module.DurabilityPolicy.VOLATILE,
        history=module.HistoryPolicy.KEEP_LAST if qos.keep_last else module.HistoryPolicy.KEEP_ALL,
        depth=qos.depth or 1,
    )
    if qos.deadline_ms:
        profile.deadline = duration(nanoseconds=qos.deadline_ms * 1_000_000)
    if qos.lifespan_ms:
        profile.lifespan = duration(nanoseconds=qos.lifespan_ms * 1_000_000)
    return profile.get_c_qos_profile()


def _service_profile() -> Any:
    return importlib.import_module("rclpy.qos").QoSProfile(depth=SERVICE_DEPTH).get_c_qos_profile()


def _own_domain() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "0").strip() or "0"
    return int(text) if text.isascii() and text.isdigit() else 0
