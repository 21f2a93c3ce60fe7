# SPDX-License-Identifier: Apache-2.0
"""An ordinary rclpy process that takes part in the ROS graph; answers commands, one JSON object a line.

{"do": "subscribe", "topic": "/a", "type": "std_msgs/msg/Int32", "reliable": true, "transient_local": false}
{"do": "matched", "topic": "/a"}                   subscriptions that the publisher above has found
{"do": "subscribe_raw", "topic": "/a", "type": "any_pkg/msg/Any", "hash": null}   samples as hexadecimal text
                   with QoS as of "subscribe"
{"do": "publish", "topic": "/a", "type": "std_msgs/msg/Int32", "values": [{"data": 1}], "transient_local": false}
                   one sample a value, the publisher stays; answers the samples as rclpy serializes them, in hexadecimal
{"do": "serve", "service": "/s", "type": "rcl_interfaces/srv/GetParameterTypes", "hold": 20}
                   answers when `hold` requests are there, the last one first; each name in it gives its length
{"do": "call", "service": "/s", "type": "rcl_interfaces/srv/GetParameterTypes", "names": [["a"], ["b", "c"]]}
                   calls at once, one call a list of names, when the service is there
{"do": "replies"}  what the calls gave: null, or types, in the order of the calls
{"do": "serve_names", "service": "/s"}             serves rcl_interfaces/srv/ListParameters: each prefix in capitals
{"do": "call_names", "service": "/s", "prefixes": ["a"]}   calls one, when it is there
{"do": "names"}    what this call gave, names and prefixes, or null
{"do": "add", "service": "/sum"}                   serves example_interfaces/srv/AddTwoInts; with "ends": no more
{"do": "ask_sums", "service": "/sum", "pairs": [[1, 2]]}   calls it at once, when it is there
{"do": "sums"}     what these calls gave, or null
{"do": "set_bool", "service": "/s", "data": true}  calls std_srvs/srv/SetBool once, when it is there
{"do": "answers"}  what this call gave, success and message; empty: nothing yet
{"do": "graph"}    nodes, topics with types, and publishers with their QoS
{"do": "endpoints", "topic": "/a"}                publishers and subscriptions with QoS and type hash
{"do": "node", "node": "n", "namespace": "/"}     services and clients of a node
{"do": "samples"}  what arrived since the last time
"""

from __future__ import annotations

import importlib
import json
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import deadline

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
"""What ROS 2 calls the node of an endpoint as long as the name has not arrived."""


class Observer(LineProcess):
    """The test's side: sends commands to the process and waits for what should be seen."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        super().__init__(process)
        self.samples: list[tuple[str, Any]] = []

    def subscribe(self, topic: str, type_name: str, **qos: bool) -> None:
        self.ask(do="subscribe", topic=topic, type=type_name, **qos)

    def see(self, seen: Callable[[dict[str, Any]], object], timeout_s: float = 15.0) -> dict[str, Any]:
        """Wait until `seen` is true of the graph; return the graph."""
        end = deadline(timeout_s)
        while True:
            graph: dict[str, Any] = self.ask(do="graph")
            if seen(graph):
                return graph
            assert time.monotonic() < end, f"not seen: {graph}"
            time.sleep(0.05)

    def named_endpoints(self, topic: str, count: int = 1, timeout_s: float = 15.0) -> list[dict[str, Any]]:
        """Wait for `count` endpoints of a topic and the names of their nodes; return the endpoints.

        A separate sample says which node has an endpoint, and may come after the endpoint.
        """
        end = deadline(timeout_s)
        while True:
            found: list[dict[str, Any]] = self.ask(do="endpoints", topic=topic)
            if len(found) >= count and not any(UNKNOWN_NODE in endpoint["node"] for endpoint in found):
                return found
            assert time.monotonic() < end, f"{topic}: {found}"
            time.sleep(0.05)

    def got(self, count: int, timeout_s: float = 15.0, topic: str | None = None) -> list[tuple[str, Any]]:
        """Wait for `count` samples; return them.

        With `topic` samples of others are discarded, as those that an earlier test left.
        """
        end = deadline(timeout_s)
        found: list[tuple[str, Any]] = []
        while len(found) < count:
            found += [(name, value) for name, value in self.ask(do="samples") if topic in (None, name)]
            assert time.monotonic() < end, f"{len(found)} of {count} samples came: {found[-3:]}"
            time.sleep(0.02)
        return found


@contextmanager
def observing(domain: int) -> Iterator[Observer]:
    """Run an observer in a separate process, in a ROS domain."""
    with serving("tests.support.agent.observer", domain) as process:
        observer = Observer(process)
        assert observer.ask(do="graph")
        yield observer


def main() -> None:
    """Serve commands from stdin."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("observer")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    arrived: list[tuple[str, Any]] = []
    commands: queue.Queue[str] = queue.Queue()
    woken = node.create_guard_condition(lambda: None)
    threading.Thread(target=_read, args=(commands, woken.trigger), daemon=True).start()
    peer = _Peer(node, arrived)
    while True:
        executor.spin_once(timeout_sec=0.02 if peer.polls else 1.0)  # a command wakes it
        peer.poll()
        try:
            command = json.loads(commands.get_nowait())
        except queue.Empty:
            continue
        if command["do"] == "subscribe":
            _subscribe(node, command, arrived)
            answer: Any = True
        elif command["do"] == "graph":
            answer = _graph(node)
        elif command["do"] == "samples":
            answer, arrived[:] = list(arrived), []
        elif command["do"] == "forget":
            peer.forget_raw()
            answer = _forget(node, arrived)
        else:
            answer = getattr(peer, command.pop("do"))(**command)
        print(json.dumps(answer), flush=True)


def _read(commands: queue.Queue[str], wake: Callable[[], None]) -> None:
    for line in sys.stdin:
        commands.put(line)
        wake()


def _filled(message: Any, value: dict[str, Any]) -> Any:
    """Return `message` with what `value` says of its members, which may be messages themselves."""
    for name, member in value.items():
        setattr(
            message, name, _filled(getattr(message, name), member) if isinstance(member, dict) else member
        )
    return message


class _Peer:
    """What the observer does besides watching: publishes, serves, calls."""

    def __init__(self, node: Any, arrived: list[tuple[str, Any]]) -> None:
        self._node = node
        self._arrived = arrived
        self._publishers: dict[str, Any] = {}
        self._raw: list[tuple[str, Any]] = []
        self._services: list[tuple[Any, Any, int, list[Any]]] = []
        self._clients: dict[str, Any] = {}
        self._calls: list[Any] = []
        self._adder: Any = None

    @property
    def polls(self) -> bool:
        """Whether there is what no executor waits for."""
        return bool(self._raw or self._services)

    def poll(self) -> None:
        for topic, handle in self._raw:
            while (taken := handle.take_message(None, True)) is not None:
                self._arrived.append((topic, taken[0].hex()))
        for service in self._services:
            self._answer(*service)

    def publish(
        self, topic: str, type: str, values: list[dict[str, Any]], transient_local: bool = False, **qos: Any
    ) -> list[str]:
        from rclpy.serialization import serialize_message

        message_class = _load(type)
        if topic not in self._publishers:
            self._publishers[topic] = self._node.create_publisher(
                message_class, topic, _profile(transient_local=transient_local, **qos)
            )
        messages = [_filled(message_class(), value) for value in values]
        for message in messages:
            self._publishers[topic].publish(message)
        return [serialize_message(message).hex() for message in messages]

    def matched(self, topic: str) -> int:
        return int(self._publishers[topic].get_subscription_count())

    def subscribe_raw(self, topic: str, type: str, hash: str | None, **qos: bool) -> bool:
        from rclpy.impl.implementation_singleton import rclpy_implementation

        from microros_gen.interfaces.types import TypeName
        from microros_gen.ros.raw_types import raw_types

        package, kind, name = type.split("/")
        message_class = raw_types().message_class(TypeName(package, kind, name), hash)
        profile = _profile(**qos).get_c_qos_profile()
        handle = rclpy_implementation.Subscription(self._node.handle, message_class, topic, profile)
        self._raw.append((topic, handle))
        return True

    def forget_raw(self) -> None:
        for _, handle in self._raw:
            handle.destroy_when_not_in_use()
        self._raw.clear()

    def starve(self, topic: str, type: str) -> bool:
        """Subscribe, and take nothing until `feed`."""
        from rclpy.impl.implementation_singleton import rclpy_implementation
        from rclpy.qos import HistoryPolicy, QoSProfile
        from rclpy.type_support import check_for_type_support

        profile = QoSProfile(history=HistoryPolicy.KEEP_ALL).get_c_qos_profile()
        message_class = _load(type)
        check_for_type_support(message_class)
        self._starved = rclpy_implementation.Subscription(self._node.handle, message_class, topic, profile)
        return True

    def feed(self) -> list[str]:
        """Take the waiting samples; return the bytes of the samples after their encapsulation."""
        found = []
        while (taken := self._starved.take_message(None, True)) is not None:
            found.append(taken[0][4:].hex())
        return found

    def serve(self, service: str, type: str, hold: int) -> bool:
        from rclpy.impl.implementation_singleton import rclpy_implementation

        service_class = _load(type)
        profile = _profile(depth=100).get_c_qos_profile()
        handle = rclpy_implementation.Service(self._node.handle, service_class, service, profile)
        self._services.append((service_class, handle, hold, []))
        return True

    def stop_serving(self) -> bool:
        for _, handle, _, _ in self._services:
            handle.destroy_when_not_in_use()
        self._services.clear()
        return True

    def _answer(self, service_class: Any, handle: Any, hold: int, held: list[Any]) -> None:
        while (taken := handle.service_take_request(service_class.Request))[0] is not None:
            held.append(taken)
        if len(held) < hold:
            return
        for request, header in reversed(held):
            response = service_class.Response(types=bytes(len(name) for name in request.names))
            handle.service_send_response(response, header.request_id)
        held.clear()

    def call(self, service: str, type: str, names: list[list[str]]) -> bool:
        if service not in self._clients:
            profile = _profile(depth=100)
            self._clients[service] = self._node.create_client(_load(type), service, qos_profile=profile)
        client = self._clients[service]
        assert client.wait_for_service(10)
        self._calls = [client.call_async(_load(type).Request(names=prefixes)) for prefixes in names]
        return True

    def replies(self) -> list[Any]:
        return [list(call.result().types) if call.done() else None for call in self._calls]

    def serve_names(self, service: str) -> bool:
        def answer(request: Any, response: Any) -> Any:
            response.result.names = [prefix.upper() for prefix in request.prefixes]
            return response

        self._node.create_service(_load("rcl_interfaces/srv/ListParameters"), service, answer)
        return True

    def call_names(self, service: str, prefixes: list[str]) -> bool:
        service_class = _load("rcl_interfaces/srv/ListParameters")
        client = self._node.create_client(service_class, service)
        assert client.wait_for_service(10)
        self._calls = [client.call_async(service_class.Request(prefixes=prefixes))]
        return True

    def names(self) -> list[list[str]] | None:
        call = self._calls[0]
        return [call.result().result.names, call.result().result.prefixes] if call.done() else None

    def add(self, service: str, ends: bool = False) -> bool:
        from tests.support.agent.add_two_ints import AddTwoInts

        def answer(request: Any, response: Any) -> Any:
            response.sum = request.a + request.b
            return response

        if ends:
            return bool(self._node.destroy_service(self._adder))
        self._adder = self._node.create_service(AddTwoInts, service, answer)
        return True

    def ask_sums(self, service: str, pairs: list[list[int]]) -> bool:
        from tests.support.agent.add_two_ints import AddTwoInts

        client = self._node.create_client(AddTwoInts, service)
        assert client.wait_for_service(30)
        self._calls = [client.call_async(AddTwoInts.Request(a=a, b=b)) for a, b in pairs]
        return True

    def set_bool(self, service: str, data: bool) -> bool:
        from std_srvs.srv import SetBool

        client = self._node.create_client(SetBool, service)
        assert client.wait_for_service(30)
        self._calls = [client.call_async(SetBool.Request(data=data))]
        return True

    def answers(self) -> list[Any]:
        return [[call.result().success, call.result().message] for call in self._calls if call.done()]

    def sums(self) -> list[Any]:
        return [call.result().sum if call.done() else None for call in self._calls]

    def endpoints(self, topic: str) -> list[dict[str, Any]]:
        found = [
            *self._node.get_publishers_info_by_topic(topic),
            *self._node.get_subscriptions_info_by_topic(topic),
        ]
        return [
            {
                "node": f"{info.node_namespace.rstrip('/')}/{info.node_name}",
                "kind": info.endpoint_type.name,
                "type": info.topic_type,
                "hash": str(info.topic_type_hash),
                "reliability": info.qos_profile.reliability.name,
                "durability": info.qos_profile.durability.name,
                "deadline_ns": info.qos_profile.deadline.nanoseconds,
                "lifespan_ns": info.qos_profile.lifespan.nanoseconds,
                "liveliness": info.qos_profile.liveliness.name,
            }
            for info in found
        ]

    def node(self, node: str, namespace: str) -> list[Any]:
        from rclpy.node import NodeNameNonExistentError

        try:
            services = self._node.get_service_names_and_types_by_node(node, namespace)
            return [services, self._node.get_client_names_and_types_by_node(node, namespace)]
        except NodeNameNonExistentError:  # it has left since somebody saw it
            return [[], []]


def _load(type_name: str) -> Any:
    package, kind, name = type_name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


def _profile(reliable: bool = True, transient_local: bool = False, depth: int = 1000) -> Any:
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    profile = QoSProfile(depth=depth)
    if not reliable:
        profile.reliability = ReliabilityPolicy.BEST_EFFORT
    if transient_local:
        profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
    return profile


def _subscribe(node: Any, command: dict[str, Any], arrived: list[tuple[str, Any]]) -> None:
    topic = command["topic"]
    node.create_subscription(
        _load(command["type"]),
        topic,
        lambda message: arrived.append((topic, _plain(message))),
        _profile(command.get("reliable", True), command.get("transient_local", False)),
    )


def _forget(node: Any, arrived: list[tuple[str, Any]]) -> bool:
    """Destroy the subscriptions and their samples."""
    for subscription in list(node.subscriptions):
        node.destroy_subscription(subscription)
    arrived.clear()
    return True


def _plain(value: Any) -> Any:
    """Return a message as dictionaries, lists, texts and numbers; an octet is bytes of length 1 in rclpy."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: _plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, list):
        return [_plain(element) for element in value]
    if isinstance(value, bytes):
        return list(value) if len(value) != 1 else value[0]
    return value.tolist() if hasattr(value, "tolist") else value


def _graph(node: Any) -> dict[str, Any]:
    topics = {name: types for name, types in node.get_topic_names_and_types() if name != "/rosout"}
    return {
        "nodes": sorted(
            f"{namespace.rstrip('/')}/{name}" for name, namespace in node.get_node_names_and_namespaces()
        ),
        "topics": topics,
        "publishers": {
            name: [
                [
                    f"{info.node_namespace.rstrip('/')}/{info.node_name}",
                    info.qos_profile.reliability.name,
                    info.qos_profile.durability.name,
                ]
                for info in node.get_publishers_info_by_topic(name)
            ]
            for name in topics
        },
    }


if __name__ == "__main__":
    main()
