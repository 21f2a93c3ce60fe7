# SPDX-License-Identifier: Apache-2.0
"""A node of ROS 2 for any type that has an interface file, installed or not: messages are dicts (see `codec`).

    with Peer("watcher", interface_paths=[Path("my_msgs")]) as peer:
        peer.subscribe("/state", "my_msgs/msg/State", print)
        while True:
            peer.spin_once(1.0)

It has no thread: callbacks run in calls of the one thread that uses it. Type hashes are computed from the interface
files (RIHS01, REP-2011), as installed nodes announce them. The node has only the entities that are created with it: no
parameters, no /rosout. Times are in seconds.
"""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from microros_gen.interfaces.types import TypeName
from microros_gen.ros.endpoints import (
    Client,
    LostMessages,
    MessageInfo,
    Publisher,
    RawPublisher,
    RawSubscription,
    Respond,
    Server,
    Subscription,
    Value,
)
from microros_gen.ros.errors import RosError
from microros_gen.ros.graph import Graph, GraphChanges
from microros_gen.ros.known_types import KnownType, KnownTypes
from microros_gen.ros.libraries import FAILURES, first_line
from microros_gen.ros.loading import load_rclpy
from microros_gen.ros.names import ServiceName
from microros_gen.ros.qos import Qos, c_profile
from microros_gen.ros.raw_types import raw_types

_Waited = RawSubscription | LostMessages | Client | Server | GraphChanges
"""What a peer waits for."""
_WAITED_KINDS = ("subscription", "guard_condition", "timer", "client", "service", "event")
"""In the order of the arguments of rclpy's wait set."""
_SLICE_S = 0.1
"""Longest single wait in seconds: Python handles signals (Ctrl-C) after it."""


class Peer:
    """A node with a separate context; use it with `with`, or call `close`. Not thread-safe."""

    def __init__(
        self,
        name: str,
        namespace: str = "/",
        domain: int | None = None,
        interface_paths: Iterable[Path] = (),
    ) -> None:
        """Create the node in `domain` (0 to 232; default: ROS_DOMAIN_ID).

        Raises RosUnusableError without ROS 2 Jazzy and rmw_fastrtps_cpp, UserError for an interface path that does not
        exist, RosError for an invalid name.
        """
        self._types = KnownTypes(interface_paths)
        self._handles = load_rclpy()
        self._raw = raw_types()
        self._context = importlib.import_module("rclpy.context").Context()
        self._entities: list[Any] = []
        self._waited: list[_Waited] = []
        self._spinning = self._closed = False
        self._node: Any = None
        try:
            self._context.init(args=[], domain_id=domain, initialize_logging=False)
            self._node = self._handles.Node(name, namespace, self._context.handle, None, False, False)
        except FAILURES as error:
            self.close()
            raise RosError(f"node '{name}': {first_line(error)}") from error

    def __enter__(self) -> Peer:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def name(self) -> str:
        """Return the fully qualified name of the node."""
        return str(self._node.get_fully_qualified_name())

    @property
    def types(self) -> KnownTypes:
        """The types that have an interface file."""
        return self._types

    def publisher(self, topic: str, type_name: str, qos: Qos | None = None) -> Publisher:
        """Create a publisher; topics are absolute (`/a/b`) or relative to the node's namespace.

        Raises UserError for an unknown type, RosError for an invalid name or QoS, TypeLimitError for too many types.
        """
        known = self._types.message(type_name)
        handle = self._topic(self._handles.Publisher, topic, known, qos)
        return Publisher(handle, known)

    def publisher_raw(
        self, topic: str, name: TypeName, type_hash: str | None, qos: Qos | None = None
    ) -> RawPublisher:
        """Create a publisher of a type that needs no interface file; `type_hash` as for `subscribe_raw`."""
        raw = self._raw.message_class(name, type_hash)
        return RawPublisher(self._made(self._handles.Publisher, raw, topic, c_profile(qos or Qos())))

    def subscribe(
        self, topic: str, type_name: str, callback: Callable[[Value], object], qos: Qos | None = None
    ) -> Subscription:
        """Create a subscription; `spin_once` calls `callback` with each message. Errors as for `publisher`."""
        known = self._types.message(type_name)
        subscription = Subscription(
            self._topic(self._handles.Subscription, topic, known, qos), known, callback
        )
        self._waited.append(subscription)
        return subscription

    def subscribe_raw(
        self,
        topic: str,
        name: TypeName,
        type_hash: str | None,
        callback: Callable[[bytes, MessageInfo], object],
        qos: Qos | None = None,
    ) -> RawSubscription:
        """Create a subscription of a type that needs no interface file; `callback` gets encapsulation and CDR body.

        `type_hash` is RIHS01 text, or None if it is not known. Errors as for `publisher`.
        """
        raw = self._raw.message_class(name, type_hash)
        handle = self._made(self._handles.Subscription, raw, topic, c_profile(qos or Qos()))
        subscription = RawSubscription(handle, callback)
        self._waited.append(subscription)
        return subscription

    def on_lost(self, subscription: RawSubscription, callback: Callable[[int, int], object]) -> None:
        """Let `spin_once` call `callback` when messages of a subscription were lost: how many since, and in total.

        Best effort loses what the network or a full buffer drops; reliable, what the publisher no longer keeps.
        """
        kind = self._handles.rcl_subscription_event_type_t.RCL_SUBSCRIPTION_MESSAGE_LOST
        try:
            event = self._handles.EventHandle(subscription.handle, kind)
        except FAILURES as error:
            raise RosError(f"lost messages: {first_line(error)}") from error
        self._entities.append(event)
        self._waited.append(LostMessages(event, callback))

    def client(self, service: str, type_name: str) -> Client:
        """Create a service client. Errors as for `publisher`."""
        known = self._types.service(type_name)
        name = ServiceName(service, known.name)
        service_client = Client(
            self._service(self._handles.Client, name, known), known, name, self._raw, self.spin
        )
        self._waited.append(service_client)
        return service_client

    def serve(self, service: str, type_name: str, answer: Callable[[Value], Mapping[str, Any]]) -> Server:
        """Create a service server; `spin_once` replies with `answer(request)`. Errors as for `publisher`."""
        return self.serve_later(service, type_name, lambda request, respond: respond(answer(request)))

    def serve_later(self, service: str, type_name: str, serve: Callable[[Value, Respond], object]) -> Server:
        """Create a service server; `spin_once` calls `serve` with each request and what sends its response, once.

        Errors as for `publisher`.
        """
        known = self._types.service(type_name)
        name = ServiceName(service, known.name)
        server = Server(self._service(self._handles.Service, name, known), known, name, self._raw, serve)
        self._waited.append(server)
        return server

    def remove(self, waited: RawSubscription | Client | Server) -> None:
        """Destroy a subscription, client or server, which cannot be used afterwards. Raises RosError in a callback."""
        if self._spinning:
            raise RosError("a callback cannot remove an entity: do it after `spin_once`")
        self._waited.remove(waited)
        self._entities.remove(waited.handle)
        waited.handle.destroy_when_not_in_use()

    def graph(self) -> Graph:
        """Return what queries the ROS graph; it works until the peer is closed."""
        return Graph(self._handles, self._node)

    def on_graph_change(self, callback: Callable[[], object]) -> None:
        """Let `spin_once` call `callback` after changes of the ROS graph, once for several changes."""
        self._waited.append(GraphChanges(self._node, self._raw.libraries, callback))

    def spin_once(self, timeout_s: float = 0.0) -> bool:
        """Wait for data for at most `timeout_s` seconds and run callbacks; return whether any entity was ready.

        Exceptions of callbacks propagate, as does CodecError for a message that is invalid for its type; that message
        has been removed. Raises RosError when called from a callback.
        """
        if self._spinning:
            raise RosError("a callback cannot spin: use `send` there")
        self._spinning = True
        try:
            holding = [waited for waited in self._waited if isinstance(waited, Server) and waited.holds]
            for server in holding:
                server.send_held()
            ready = self._ready(min(timeout_s, _SLICE_S) if holding else timeout_s)
            for waited in ready:
                waited.look()
            return bool(ready)
        finally:
            self._spinning = False

    def spin(self, done: Callable[[], object], timeout_s: float) -> bool:
        """Spin until `done()` is true, for at most `timeout_s` seconds; return whether it is."""
        end = time.monotonic() + timeout_s
        while not done():
            left = end - time.monotonic()
            if left <= 0:
                return False
            self.spin_once(min(left, _SLICE_S))
        return True

    def close(self) -> None:
        """Destroy the node and its entities, none of which can be used afterwards; idempotent."""
        self._waited.clear()
        while self._entities:
            self._entities.pop().destroy_when_not_in_use()
        if self._node is not None:
            self._node.destroy_when_not_in_use()
            self._node = None
        if not self._closed:
            self._closed = True
            self._context.try_shutdown()
            self._context.destroy()

    def _ready(self, timeout_s: float) -> list[_Waited]:
        """Return the entities with data, after at most `timeout_s` seconds."""
        end = time.monotonic() + timeout_s
        kinds = [waited.kind for waited in self._waited]
        counts = tuple(map(kinds.count, _WAITED_KINDS))
        waits = self._handles.WaitSet(*counts, self._context.handle)
        try:
            while True:
                waits.clear_entities()
                places = [waited.add(waits) for waited in self._waited]
                left = max(0.0, min(_SLICE_S, end - time.monotonic()))
                if places:
                    waits.wait(int(left * 1e9))
                else:
                    time.sleep(left)
                ready = [
                    waited
                    for waited, place in zip(self._waited, places, strict=True)
                    if waits.is_ready(waited.kind, place)
                ]
                if ready or time.monotonic() >= end:
                    return ready
        finally:
            waits.destroy_when_not_in_use()

    def _topic(self, make: Any, topic: str, known: KnownType, qos: Qos | None) -> Any:
        raw = self._raw.message_class(known.name, known.type_hash(known.name))
        return self._made(make, raw, topic, c_profile(qos or Qos()))

    def _service(self, make: Any, name: ServiceName, known: KnownType) -> Any:
        hashes = [known.type_hash(part) for part in (name.type, name.request, name.response)]
        raw = self._raw.service_class(name, hashes[0], hashes[1], hashes[2])
        return self._made(make, raw, name.name, c_profile(Qos()))

    def _made(self, make: Any, raw: Any, name: str, profile: Any) -> Any:
        try:
            handle = make(self._node, raw, name, profile)
        except FAILURES as error:
            raise RosError(f"{name}: {first_line(error)}") from error
        self._entities.append(handle)
        return handle
