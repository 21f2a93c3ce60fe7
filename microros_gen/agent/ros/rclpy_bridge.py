# SPDX-License-Identifier: Apache-2.0
"""The bridge on rclpy: one context per domain, a bare node per participant, raw publishers.

Nodes and publishers are rclpy's handles, not its `Node` class: a client's node shows in the graph with what
the client declared, without parameter services and their topics, and takes 2 KiB instead of 450.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
from pathlib import Path
from typing import Any

from microros_gen.agent.representation.description import Durability, Qos, Topic
from microros_gen.agent.ros.bridge import Bridge, BridgeError, Node, Writer
from microros_gen.agent.ros.names import TypeName, ros_node, ros_topic, ros_type
from microros_gen.agent.wire.constants import Status
from microros_gen.diagnostics import Diagnostic, UserError

MAXIMUM_DOMAIN = 232
"""Largest ROS domain id: the ports of larger ones do not exist (RTPS 2.2, 9.6.1)."""
_FAILURES = (RuntimeError, ValueError, TypeError, OSError)
"""What rclpy's handles raise: RCLError is a RuntimeError, refused names are ValueErrors."""


DOMAIN_OF_AGENT = 255
"""Clients that ask for this domain (a convention of the public client) get the agent's own, ROS_DOMAIN_ID."""


def open_bridge(maximum_domains: int, domain: int | None = None) -> Bridge:
    """Return the bridge; UserError when rclpy is missing or does not load.

    `domain` (0 to 232) puts every client into that ROS domain, whichever it asks for.
    """
    try:
        importlib.import_module("rclpy")
        handles = importlib.import_module("rclpy.impl.implementation_singleton").rclpy_implementation
    except ImportError as error:
        missing = isinstance(error, ModuleNotFoundError) and error.name == "rclpy"
        reason = (
            "rclpy (ROS 2) is not installed for this Python" if missing else f"rclpy does not load: {error}"
        )
        hint = "Run: pip install 'microros-gen[ros]', or source a ROS 2 installation"
        raise UserError([Diagnostic(f"the agent needs ROS 2: {reason}", hint=hint)]) from error
    return RclpyBridge(handles, maximum_domains, domain)


class RclpyBridge:
    """Contexts by domain; one that no node uses stays open until its place is needed."""

    def __init__(self, handles: Any, maximum_domains: int, domain: int | None) -> None:
        self._handles = handles
        self._domain = domain
        self._maximum_domains = maximum_domains
        self._contexts: dict[int, _Context] = {}

    def create_node(self, name: str, domain: int) -> Node:
        """See Bridge."""
        node, namespace = ros_node(name)
        if domain == DOMAIN_OF_AGENT:
            domain = _own_domain()
        context = self._context(domain if self._domain is None else self._domain)
        try:
            handle = self._handles.Node(node, namespace, context.handle, None, False, False)
        except _FAILURES as error:
            raise BridgeError(f"node '{name}': {_first_line(error)}") from error
        context.nodes += 1
        return _Node(self._handles, handle, context)

    def close(self) -> None:
        """See Bridge."""
        for context in self._contexts.values():
            context.close()
        self._contexts = {}

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
        except _FAILURES as error:
            raise BridgeError(f"domain {domain}: {_first_line(error)}") from error
        self.handle = self._context.handle
        self.nodes = 0

    def close(self) -> None:
        self._context.try_shutdown()
        self._context.destroy()


class _Node:
    def __init__(self, handles: Any, handle: Any, context: _Context) -> None:
        self._handles = handles
        self._handle = handle
        self._context = context
        self.label: str = handle.get_fully_qualified_name()

    def create_writer(self, topic: Topic, qos: Qos) -> Writer:
        name, type_name = ros_topic(topic.name), ros_type(topic.type_name)
        message_class = load_message(type_name)
        try:
            handle = self._handles.Publisher(self._handle, message_class, name, _profile(qos))
        except _FAILURES as error:
            raise BridgeError(f"publisher {name} [{type_name}]: {_first_line(error)}") from error
        return _Writer(handle, f"{name} [{type_name}]")

    def destroy(self) -> None:
        self._handle.destroy_when_not_in_use()
        self._context.nodes -= 1


class _Writer:
    def __init__(self, handle: Any, label: str) -> None:
        self._handle = handle
        self._publish = handle.publish_raw
        self.label = label

    def publish(self, serialized: bytes) -> None:
        try:
            self._publish(serialized)
        except _FAILURES as error:
            raise BridgeError(f"publish on {self.label}: {_first_line(error)}") from error

    def destroy(self) -> None:
        self._handle.destroy_when_not_in_use()


def load_message(type_name: TypeName) -> Any:
    """Return the Python class of a ROS message; BridgeError when there is none.

    The name comes from the network, so only a package with rosidl's type support in it is imported.
    """
    package = type_name.package
    try:
        where = importlib.util.find_spec(package)
    except (ImportError, ValueError):
        where = None
    folders = list(where.submodule_search_locations or ()) if where else []
    if not any(next(Path(f).glob(f"{package}_s__rosidl_typesupport*"), None) for f in folders):
        raise BridgeError(
            f"type {type_name} is not known: package '{package}' is not installed for this Python;"
            " install it, or source the workspace that has it, before the agent starts"
        )
    try:
        message_class = getattr(importlib.import_module(f"{package}.msg"), type_name.name, None)
        if message_class is not None:
            importlib.import_module("rclpy.type_support").check_is_valid_msg_type(message_class)
    except (ImportError, AttributeError, *_FAILURES) as error:
        raise BridgeError(f"type {type_name} does not load: {_first_line(error)}") from error
    if message_class is None:
        raise BridgeError(
            f"type {type_name} is not known: the installed package '{package}' has no such message"
        )
    return message_class


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


def _own_domain() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "0").strip() or "0"
    return int(text) if text.isascii() and text.isdigit() else 0


def _first_line(error: Exception) -> str:
    return (str(error) or type(error).__name__).splitlines()[0]
