# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that tells what it sees of the ROS graph, as lines of tests/runtime/c/graph_calls.h.

One JSON object a line: {"do": "names", "what": "topics", "node": "", "namespace": ""}, {"do": "nodes"},
{"do": "infos", "what": "publishers", "topic": "/a"}, {"do": "count", "what": "servers", "name": "/a"},
{"do": "subscribe", "topic": "/a"}, {"do": "leave"} (ends the subscription), {"do": "publish", "topic": "/a"},
{"do": "serve", "name": "/a"}, {"do": "matched"} (of the publisher),
{"do": "act", "server": "/a", "client": "/b"} (of actions).
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import Any

from tests.support.agent.line_process import LineProcess, serving

NODE = ("/peers/deep", "oracle")
"""Namespace and name."""


@contextmanager
def graph_peer(domain: int) -> Iterator[LineProcess]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.graph_peer", domain) as process:
        yield LineProcess(process)


class _Peer:
    def __init__(self, node: Any) -> None:
        self._node = node
        self._kept: list[Any] = []
        self._subscription: Any = None
        self._publisher: Any = None

    def names(self, what: str, node: str, namespace: str) -> list[str]:
        of_node = {
            "publishers_of": self._node.get_publisher_names_and_types_by_node,
            "subscriptions_of": self._node.get_subscriber_names_and_types_by_node,
            "services_of": self._node.get_service_names_and_types_by_node,
            "clients_of": self._node.get_client_names_and_types_by_node,
        }
        actions = {"action_servers_of": "server", "action_clients_of": "client"}
        if what == "actions":
            found = import_module("rclpy.action").get_action_names_and_types(self._node)
        elif what in actions:
            name = f"get_action_{actions[what]}_names_and_types_by_node"
            found = []
            with suppress(RuntimeError):  # rclpy's error: the node has not been discovered
                found = getattr(import_module("rclpy.action"), name)(self._node, node, namespace)
        elif what in ("topics", "mangled"):
            found = self._node.get_topic_names_and_types(no_demangle=what == "mangled")
        elif what == "services":
            found = self._node.get_service_names_and_types()
        else:
            found = of_node[what](node, namespace)
        return sorted(" ".join([name, *sorted(types)]) for name, types in found)

    def nodes(self) -> list[str]:
        found = self._node.get_node_names_and_namespaces()
        return sorted(f"{namespace} {name}" for name, namespace in found)

    def infos(self, what: str, topic: str) -> list[str]:
        ask = (
            self._node.get_publishers_info_by_topic
            if what == "publishers"
            else self._node.get_subscriptions_info_by_topic
        )
        return sorted(_info(endpoint) for endpoint in ask(topic))

    def count(self, what: str, name: str) -> int:
        ask = {
            "publishers": self._node.count_publishers,
            "subscriptions": self._node.count_subscribers,
            "servers": self._node.count_services,
            "clients": self._node.count_clients,
        }
        return int(ask[what](name))

    def subscribe(self, topic: str) -> bool:
        self._subscription = self._node.create_subscription(_int32(), topic, lambda _: None, 1)
        return True

    def leave(self) -> bool:
        return bool(self._node.destroy_subscription(self._subscription))

    def publish(self, topic: str) -> bool:
        self._publisher = self._node.create_publisher(_int32(), topic, 1)
        return True

    def matched(self) -> int:
        return int(self._publisher.get_subscription_count())

    def serve(self, name: str) -> bool:
        service_class = import_module("std_srvs.srv").SetBool
        self._kept.append(self._node.create_service(service_class, name, lambda _, response: response))
        return True

    def act(self, server: str, client: str) -> bool:
        actions, kind = import_module("rclpy.action"), import_module("test_msgs.action").Fibonacci
        self._kept.append(actions.ActionServer(self._node, kind, server, lambda goal: goal))
        self._kept.append(actions.ActionClient(self._node, kind, client))
        return True


def _int32() -> Any:
    return import_module("std_msgs.msg").Int32


def _info(info: Any) -> str:
    qos, type_hash = info.qos_profile, info.topic_type_hash
    durations = (qos.deadline, qos.lifespan, qos.liveliness_lease_duration)
    return " ".join(
        [
            *(info.node_namespace, info.node_name, info.topic_type, str(info.endpoint_type.value)),
            *(str(type_hash.version), bytes(type_hash.value).hex(), bytes(info.endpoint_gid).hex()),
            *(str(int(p)) for p in (qos.reliability, qos.durability, qos.history, qos.liveliness)),
            str(qos.depth),
            *(f"{d.nanoseconds // 10**9}.{d.nanoseconds % 10**9:09}" for d in durations),
        ]
    )


def main() -> None:
    """Serve commands from stdin; a thread spins."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node(NODE[1], namespace=NODE[0])
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    peer = _Peer(node)
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
