# SPDX-License-Identifier: Apache-2.0
"""An rclpy process that asks a device all the time for whatever it has, and answers it.

Each kind of exchange has a name. For each line of its input it prints how often each was completed, as JSON.
"""

from __future__ import annotations

import json
import queue
import sys
import threading
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from typing import Any

PERIOD_S = 0.01
GIVE_UP = 100
"""Turns after which a call that has no answer is forgotten: the agent was away."""


class _Calls:
    """Calls of one service, one at a time."""

    def __init__(self, name: str, client: Any, request: Callable[[int], Any], counts: Counter[str]) -> None:
        self._name, self._client, self._request, self._counts = name, client, request, counts
        self._pending: Any = None
        self._age = 0

    def turn(self, number: int) -> None:
        if self._pending is not None:
            self._age += 1
            if self._pending.done():
                self._counts[self._name] += 1
                self._pending = None
            elif self._age > GIVE_UP:
                self._client.remove_pending_request(self._pending)
                self._pending = None
        elif self._client.service_is_ready():
            self._pending = self._client.call_async(self._request(number))
            self._age = 0


def _calls(node: Any, counts: Counter[str]) -> list[_Calls]:
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState, GetState
    from rcl_interfaces.msg import LoggerLevel, Parameter, ParameterValue
    from rcl_interfaces.srv import (
        DescribeParameters,
        GetLoggerLevels,
        GetParameters,
        ListParameters,
        SetLoggerLevels,
        SetParameters,
    )

    from tests.support.agent.add_two_ints import AddTwoInts

    def value(number: int) -> Any:
        return Parameter(name="speed", value=ParameterValue(type=3, double_value=float(number)))

    def level(number: int) -> Any:
        return LoggerLevel(name="races", level=10 if number % 2 else 20)

    kinds: list[tuple[str, Any, Callable[[int], Any]]] = [
        ("/add", AddTwoInts, lambda n: AddTwoInts.Request(a=n, b=1)),
        ("/own/get_state", GetState, lambda _: GetState.Request()),
        (
            "/own/change_state",
            ChangeState,
            lambda n: ChangeState.Request(transition=Transition(id=3 + n % 2)),
        ),
        ("/own/get_parameters", GetParameters, lambda _: GetParameters.Request(names=["speed"])),
        ("/own/set_parameters", SetParameters, lambda n: SetParameters.Request(parameters=[value(n)])),
        ("/own/list_parameters", ListParameters, lambda _: ListParameters.Request()),
        ("/own/describe_parameters", DescribeParameters, lambda _: DescribeParameters.Request(names=["on"])),
        ("/own/get_logger_levels", GetLoggerLevels, lambda _: GetLoggerLevels.Request(names=["races"])),
        ("/own/set_logger_levels", SetLoggerLevels, lambda n: SetLoggerLevels.Request(levels=[level(n)])),
    ]
    return [_Calls(name, node.create_client(kind, name), request, counts) for name, kind, request in kinds]


def _serve(node: Any, counts: Counter[str]) -> None:
    from rclpy.action.server import ActionServer, CancelResponse
    from test_msgs.action import Fibonacci

    from tests.support.agent.add_two_ints import AddTwoInts

    for name in ("/ros/add", "/ros/sum"):

        def add(request: Any, response: Any, name: str = name) -> Any:
            counts[name] += 1
            response.sum = request.a + request.b
            return response

        node.create_service(AddTwoInts, name, add)

    async def walk(goal: Any) -> Any:
        counts["/ros/walk"] += 1
        goal.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
        if goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1])

    ActionServer(node, Fibonacci, "/ros/walk", walk, cancel_callback=lambda _: CancelResponse.ACCEPT)


def _walk(node: Any, counts: Counter[str]) -> Callable[[], None]:
    """Return what sends a goal to the device when none is pending."""
    from rclpy.action.client import ActionClient
    from test_msgs.action import Fibonacci

    client = ActionClient(node, Fibonacci, "/walk")
    state = {"age": GIVE_UP}

    def accepted(future: Any) -> None:
        handle = future.result()
        if handle.accepted:
            handle.get_result_async().add_done_callback(ended)

    def ended(_: Any) -> None:
        counts["/walk"] += 1
        state["age"] = GIVE_UP

    def turn() -> None:
        state["age"] += 1
        if state["age"] > GIVE_UP and client.server_is_ready():
            state["age"] = 0
            client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(accepted)

    return turn


def main() -> None:
    """Exchange until the standard input ends."""
    import rclpy
    from diagnostic_msgs.msg import DiagnosticArray
    from rcl_interfaces.msg import Log
    from rclpy.executors import SingleThreadedExecutor
    from rosgraph_msgs.msg import Clock
    from std_msgs.msg import Int32, String

    rclpy.init()
    node = rclpy.create_node("motor")  # its parameters are those of the device's client
    node.declare_parameter("speed", 1.0)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    counts: Counter[str] = Counter()
    topics = {"count": Int32, "large": String, "huge": String}
    topics |= {"/rosout": Log, "/diagnostics": DiagnosticArray}
    for topic, kind in topics.items():

        def hear(message: Any, topic: str = topic) -> None:
            if topic != "/rosout" or message.name == "races":
                counts[topic] += 1

        node.create_subscription(kind, topic, hear, 10)
    targets = node.create_publisher(Int32, "target", 10)
    plain = node.create_publisher(String, "plain", 10)
    texts = node.create_publisher(String, "text", 10)
    clock = node.create_publisher(Clock, "/clock", 1)
    calls = _calls(node, counts)
    _serve(node, counts)
    walk = _walk(node, counts)
    numbers = iter(range(1_000_000_000))

    def turn() -> None:
        number = next(numbers)
        if number % 200 < 100:  # then the topic is silent for a second
            targets.publish(Int32(data=number))
        plain.publish(String(data=str(number)))
        texts.publish(String(data="x" * (number * 37 % 1900)))
        time = Clock()
        time.clock.sec = 1000 + number // 100 + (number // 300) * 50  # it jumps
        clock.publish(time)
        for call in calls:
            call.turn(number)
        walk()

    node.create_timer(PERIOD_S, turn)
    lines: queue.Queue[str] = queue.Queue()
    threading.Thread(target=_read, args=(lines,), daemon=True).start()
    while True:
        executor.spin_once(timeout_sec=0.1)
        with suppress(queue.Empty):
            lines.get_nowait()
            print(json.dumps(counts), flush=True)


def _read(lines: queue.Queue[str]) -> None:
    for line in sys.stdin:
        lines.put(line)


if __name__ == "__main__":
    main()
