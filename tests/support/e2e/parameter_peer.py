# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that calls parameter services of any node, and has another node as the model to compare with.

One JSON object a line: {"node": "/arm/device", "service": "get_parameters", "arguments": [["gain"]]} calls the method
of rclpy's AsyncParameterClient and answers the response; {"node": …, "wait": true} waits for the services; {"node": …,
"events": true} answers what the node said on /parameter_events since the last time; {"declare": "label", "value": "a"}
declares one more parameter of the model. Values of parameters are the plain
ones of JSON, bytes as numbers; {"type": "BYTE_ARRAY", "value": [1]} says the type of one.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import seconds

MODEL = "/model/device"
BYTE_ARRAY = 5
"""The first type of rcl_interfaces/msg/ParameterType that is an array."""


class ParameterPeer(LineProcess):
    """The test's side."""

    def wait(self, node: str) -> None:
        assert self.ask(node=node, wait=True, timeout=seconds(30)), f"no parameter services of {node}"

    def call(self, node: str, service: str, *arguments: Any) -> Any:
        response = self.ask(node=node, service=service, arguments=arguments, timeout=seconds(15))
        assert response is not None, f"no reply of {node}/{service}"
        return response

    def attempt(self, node: str, service: str, *arguments: Any) -> Any:
        """Call a service; return None without a response, on which a caller repeats the request (docs/howto).

        rclpy counts a server that was killed, without a goodbye, among those that can answer until its DDS lease ends;
        one that has just started may not know the client yet.
        """
        return self.ask(node=node, service=service, arguments=arguments, timeout=seconds(5))

    def events(self, node: str) -> list[dict[str, Any]]:
        return list(self.ask(node=node, events=True))


@contextmanager
def parameter_peer(domain: int) -> Iterator[ParameterPeer]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.parameter_peer", domain) as process:
        yield ParameterPeer(process)


def _declare(node: Any) -> None:
    """Declare what tests/e2e/c/parameters.c adds."""
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult

    node.declare_parameter("enabled", False)
    steps = [IntegerRange(from_value=-10, to_value=120, step=2)]
    words = {"description": "Steps in a turn", "additional_constraints": "only even numbers"}
    node.declare_parameter("motor.steps", 10, ParameterDescriptor(integer_range=steps, **words))
    gain = [FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)]
    node.declare_parameter("motor.limits.gain", 0.5, ParameterDescriptor(floating_point_range=gain))
    node.declare_parameter("version", 1.25, ParameterDescriptor(read_only=True))

    def accepts(parameters: list[Any]) -> Any:
        return SetParametersResult(successful=all(p.value != 66 for p in parameters))

    node.add_on_set_parameters_callback(accepts)


def _plain(message: Any) -> Any:
    """Return a message of ROS as data; a parameter's value as such."""
    if type(message).__name__ == "ParameterValue":
        from rclpy.parameter import parameter_value_to_python

        value: Any = parameter_value_to_python(message) if message.type else None
        if message.type == BYTE_ARRAY:
            value = [byte[0] for byte in value]
        return [message.type, list(value) if message.type > BYTE_ARRAY else value]
    if hasattr(message, "get_fields_and_field_types"):
        return {name: _plain(getattr(message, name)) for name in message.get_fields_and_field_types()}
    if isinstance(message, str | int | float | bool):
        return message
    return [_plain(item) for item in message]


def _parameters(pairs: list[list[Any]]) -> list[Any]:
    """Return messages of `[name, value]`; null is a value that is not set."""
    return [_parameter(name, value).to_parameter_msg() for name, value in pairs]


def _parameter(name: str, value: Any) -> Any:
    """Return a parameter; {"type": "INTEGER_ARRAY", "value": []} says its type."""
    from rclpy.parameter import Parameter

    if not isinstance(value, dict):
        return Parameter(name, value=value)
    kind, plain = value["type"], value["value"]
    return Parameter(
        name, Parameter.Type[kind], [bytes([v]) for v in plain] if kind == "BYTE_ARRAY" else plain
    )


class _Answers:
    """The process's side: calls, and keeps events."""

    def __init__(self, node: Any, model: Any, events: list[Any]) -> None:
        self._node, self._model, self._events = node, model, events
        self._clients: dict[str, Any] = {}

    def answer(self, command: dict[str, Any]) -> Any:
        if "declare" in command:
            self._model.declare_parameter(
                command["declare"], _parameter(command["declare"], command["value"]).value
            )
            return True
        if "events" in command:
            found = [event for event in self._events if event["node"] == command["node"]]
            self._events[:] = [event for event in self._events if event not in found]
            return found
        client = self._client(command["node"])
        if "wait" in command:
            return client.wait_for_services(command["timeout"])
        arguments = command["arguments"]
        if command["service"].startswith("set_"):
            arguments = [_parameters(arguments[0])]
        future = getattr(client, command["service"])(*arguments)
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        return _plain(future.result()) if done.wait(command["timeout"]) else None

    def _client(self, node: str) -> Any:
        from rclpy.parameter_client import AsyncParameterClient

        if node not in self._clients:
            self._clients[node] = AsyncParameterClient(self._node, node)
        return self._clients[node]


def main() -> None:
    """Serve commands from stdin; callbacks run in a thread."""
    import rclpy
    from rcl_interfaces.msg import ParameterEvent
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    node = rclpy.create_node("asker", start_parameter_services=False)
    model = rclpy.create_node("device", namespace="/model")
    _declare(model)
    events: list[Any] = []
    node.create_subscription(ParameterEvent, "/parameter_events", lambda m: events.append(_plain(m)), 100)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(model)
    threading.Thread(target=executor.spin, daemon=True).start()
    answers = _Answers(node, model, events)
    for line in sys.stdin:
        print(json.dumps(answers.answer(json.loads(line))), flush=True)


if __name__ == "__main__":
    main()
