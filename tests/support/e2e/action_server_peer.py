# SPDX-License-Identifier: Apache-2.0
"""An rclpy process with a server of the action /arm/fibonacci, and a client of it that is not the device.

One JSON object a line; `do` is the name of a method of `_Peer`. Its order says what the server does with a goal.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import deadline

ACTION = "/arm/fibonacci"
ENDLESS, REJECTED, ABORTED, STUBBORN = 0, 90, 91, 92
"""Goals that go on until they are canceled, are rejected, are aborted, and go on in spite of cancel requests."""


class ActionServerPeer(LineProcess):
    """The test's side."""

    def goals(self) -> list[Any]:
        """Return order, id and state of every goal that was accepted."""
        found: list[Any] = self.ask(do="goals")
        return found


@contextmanager
def action_server_peer(domain: int) -> Iterator[ActionServerPeer]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.action_server_peer", domain) as process:
        yield ActionServerPeer(process)


def fibonacci(count: int) -> list[int]:
    """Return so many numbers."""
    numbers = [0, 1]
    while len(numbers) < count:
        numbers.append(numbers[-1] + numbers[-2])
    return numbers[:count]


class _Peer:
    """The peer's side."""

    def __init__(self, executor: Any) -> None:
        import rclpy
        from rclpy.action.client import ActionClient
        from test_msgs.action import Fibonacci

        self._executor = executor
        self._node = rclpy.create_node("server")
        executor.add_node(self._node)
        self._type = Fibonacci
        self._client = ActionClient(self._node, Fibonacci, ACTION)
        self._server: Any = None
        self._accepted: list[Any] = []
        self._released = threading.Event()

    def serve(self) -> bool:
        """Start the server."""
        from rclpy.action.server import ActionServer, CancelResponse, GoalResponse
        from rclpy.callback_groups import ReentrantCallbackGroup

        refused, accepted = CancelResponse.REJECT, CancelResponse.ACCEPT
        self._server = ActionServer(
            *(self._node, self._type, ACTION, self._execute),
            goal_callback=lambda r: GoalResponse.REJECT if r.order == REJECTED else GoalResponse.ACCEPT,
            cancel_callback=lambda g: refused if g.request.order == STUBBORN else accepted,
            callback_group=ReentrantCallbackGroup(),
            result_timeout=60,
        )
        return True

    def close(self) -> bool:
        """Remove the server."""
        self._server.destroy()
        return True

    def forget(self) -> bool:
        """Forget all goals; those that are sent from now on go on again."""
        self._accepted = []
        self._released.clear()
        return True

    def release(self) -> bool:
        """End the goals that go on."""
        self._released.set()
        return True

    def _execute(self, goal: Any) -> Any:
        order = goal.request.order
        self._accepted.append(goal)
        result = self._type.Result()
        end = deadline(60)
        if order == ABORTED:
            goal.abort()
            return result
        if order in (ENDLESS, STUBBORN):
            while not goal.is_cancel_requested and not self._released.is_set() and time.monotonic() < end:
                time.sleep(0.01)
            if goal.is_cancel_requested:
                goal.canceled()
                return result
        self._wait_for_readers()
        for count in range(1, order + 1 if order < REJECTED else 1):
            feedback = self._type.Feedback()
            feedback.sequence = fibonacci(count)
            goal.publish_feedback(feedback)
            time.sleep(0.02)
        time.sleep(
            0.3
        )  # result and feedback are of different topics: a result that overtakes feedback ends the goal
        goal.succeed()
        result.sequence = fibonacci(order if order < REJECTED else 0)
        return result

    def _wait_for_readers(self) -> None:
        """Wait until ROS knows who reads feedback: its own client and the device, whose goal can come earlier."""
        end = deadline(10)
        while self._node.count_subscribers(f"{ACTION}/_action/feedback") < 2 and time.monotonic() < end:
            time.sleep(0.01)

    def goals(self) -> list[Any]:
        return [[g.request.order, bytes(g.goal_id.uuid).hex(), int(g.status)] for g in self._accepted]

    def send(self, order: int) -> bool:
        """Send a goal as another client, and wait for its result."""
        self._client.wait_for_server(20)
        goal = _wait(self._client.send_goal_async(self._type.Goal(order=order)))
        return bool(_wait(goal.get_result_async()).status == 4)


def _wait(future: Any) -> Any:
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    done.wait(20)
    return future.result()


def main() -> None:
    """Serve commands from stdin; callbacks run in threads."""
    import rclpy
    from rclpy.executors import MultiThreadedExecutor

    rclpy.init()
    executor = MultiThreadedExecutor(6)
    peer = _Peer(executor)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
