# SPDX-License-Identifier: Apache-2.0
"""A ROS node of a client, and the creation of its entities."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from microros_gen.agent.representation.description import Durability, Qos, Service, Topic
from microros_gen.agent.ros.bridge import BridgeError, HashOf, Reader, Replier, Requester, Writer
from microros_gen.agent.ros.client_graph import GRAPH_TOPIC, ClientGraph
from microros_gen.agent.ros.endpoints import RawReader, RawWriter, Ros
from microros_gen.agent.ros.graph import Comparison, Endpoint, Events, TopicTypes
from microros_gen.agent.ros.names import ros_service, ros_topic, ros_type
from microros_gen.agent.ros.requesters import RawRequester
from microros_gen.agent.ros.services import Patience, RawReplier
from microros_gen.agent.wire.constants import Status
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.ros import qos as ros_qos
from microros_gen.ros.errors import RosError, TypeLimitError
from microros_gen.ros.libraries import FAILURES, first_line
from microros_gen.ros.qos import c_profile

Entity = TypeVar("Entity", RawWriter, RawReader, RawReplier, RawRequester)
SERVICE_DEPTH = 1000
"""Queue depth of requests and of replies for a slow client; ROS 2's default of 10 loses those of a burst."""


class RawNode:
    """See Node."""

    def __init__(
        self,
        handles: Any,
        handle: Any,
        ros: Ros,
        hash_of: HashOf,
        comparison: Comparison,
        patience: Patience,
        domain: int,
        topics: TopicTypes,
        graph: ClientGraph,
        leave: Callable[[], None],
    ) -> None:
        self._handles = handles
        self._handle = handle
        self._ros = ros
        self._hash_of = hash_of
        self._graph = graph
        self._leave = leave
        self._events = Events(handles, handle, ros.wakeups, ros.libraries, comparison, topics, ros.report)
        self._patience = patience
        self.domain = domain
        self.label: str = handle.get_fully_qualified_name()

    def create_writer(self, topic: Topic, qos: Qos) -> Writer:
        """See Node."""
        handle, endpoints = self._create_topic("publisher", self._handles.Publisher, topic, qos)
        keeps_all = qos.reliable and not qos.keep_last
        return self._attach(
            handle, endpoints, lambda: RawWriter(handle, self._ros, self._events, endpoints, keeps_all)
        )

    def create_reader(self, topic: Topic, qos: Qos) -> Reader:
        """See Node. The topic of micro-ROS's graph support is answered here: it is none of ROS 2."""
        if topic.name == GRAPH_TOPIC:
            return self._graph.read(topic, self.label, self._ros.wakeups, self._events.entities)
        handle, endpoints = self._create_topic("subscription", self._handles.Subscription, topic, qos)
        return self._attach(handle, endpoints, lambda: RawReader(handle, self._ros, self._events, endpoints))

    def create_replier(self, service: Service) -> Replier:
        """See Node."""
        handle, endpoints = self._create_service("service", self._handles.Service, service)
        return self._attach(
            handle, endpoints, lambda: RawReplier(handle, self._ros, self._patience, self._events, endpoints)
        )

    def create_requester(self, service: Service) -> Requester:
        """See Node."""
        handle, endpoints = self._create_service("client", self._handles.Client, service)
        return self._attach(
            handle,
            endpoints,
            lambda: RawRequester(handle, self._ros, self._patience, self._events, endpoints),
        )

    def destroy(self) -> None:
        """See Node. What it still has goes with it."""
        self._events.close()
        self._handle.destroy_when_not_in_use()
        self._leave()

    def _create_topic(self, kind: str, make: Any, topic: Topic, qos: Qos) -> tuple[Any, tuple[Endpoint, ...]]:
        name, type_name = ros_topic(topic.name), ros_type(topic.type_name)
        type_hash = self._hash_of(str(type_name))
        with _translated():
            message_class = self._ros.types.message_class(type_name, type_hash)
        label = f"{name} [{type_name}]"
        endpoints = (Endpoint(self.label, kind, label, name, str(type_name), type_hash),)
        return self._create(make, message_class, name, _profile(qos), endpoints), endpoints

    def _create_service(self, kind: str, make: Any, service: Service) -> tuple[Any, tuple[Endpoint, ...]]:
        name = ros_service(service)
        hashes = [self._hash_of(str(part)) for part in (name.type, name.request, name.response)]
        with _translated():
            service_class = self._ros.types.service_class(name, hashes[0], hashes[1], hashes[2])
        endpoints = (
            Endpoint(
                self.label, kind, str(name), name.request_topic, dds_type(name.request), hashes[1], True
            ),
            Endpoint(self.label, kind, str(name), name.reply_topic, dds_type(name.response), hashes[2], True),
        )
        return self._create(make, service_class, name.name, _service_profile(), endpoints), endpoints

    def _create(
        self, make: Any, type_class: Any, name: str, profile: Any, endpoints: tuple[Endpoint, ...]
    ) -> Any:
        self._events.topics.claim(endpoints)
        try:
            return make(self._handle, type_class, name, profile)
        except FAILURES as error:
            self._events.release(endpoints)
            raise BridgeError(f"{endpoints[0].kind} {endpoints[0].label}: {first_line(error)}") from error

    def _attach(self, handle: Any, endpoints: tuple[Endpoint, ...], make: Callable[[], Entity]) -> Entity:
        """Watch the endpoints of a new handle and create its entity; undo everything if that fails."""
        try:
            for endpoint in endpoints:
                self._events.watch(endpoint, handle)
            return make()
        except (*FAILURES, BridgeError) as error:
            self._events.release(endpoints)
            handle.destroy_when_not_in_use()
            status = error.status if isinstance(error, BridgeError) else Status.DDS_ERROR
            raise BridgeError(
                f"{endpoints[0].kind} {endpoints[0].label}: {first_line(error)}", status
            ) from error


@contextmanager
def _translated() -> Iterator[None]:
    """Convert the error for an unavailable type to BridgeError."""
    try:
        yield
    except TypeLimitError as error:
        raise BridgeError(
            f"{error.limit} types were used since the agent started: no further ones", Status.RESOURCES
        ) from error
    except RosError as error:
        raise BridgeError(str(error)) from error


def _profile(qos: Qos) -> Any:
    return c_profile(
        ros_qos.Qos(
            qos.reliable,
            qos.durability is not Durability.VOLATILE,  # ROS has no more than transient local
            (qos.depth or 1) if qos.keep_last else None,
            qos.deadline_ms or 0,
            qos.lifespan_ms or 0,
        )
    )


def _service_profile() -> Any:
    return c_profile(ros_qos.Qos(depth=SERVICE_DEPTH))
