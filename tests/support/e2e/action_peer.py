# SPDX-License-Identifier: Apache-2.0
"""An rclpy process with a client of the action /arm/fibonacci, and the model, a server of rclpy: /model/fibonacci.

One JSON object a line; `do` is the name of a method of `_Peer`. Goals are numbered in the order of their requests.
"""

from __future__ import annotations

import json
import sys
import threading
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.support.agent.line_process import LineProcess, serving
from tests.support.patience import deadline, seconds

DEVICE, MODEL = "/arm/fibonacci", "/model/fibonacci"


class ActionPeer(LineProcess):
    """The test's side."""

    def send(self, order: int, same_id_as: int | None = None, action: str = DEVICE) -> dict[str, Any]:
        """Send a goal; the answer has `goal`, its number, and `accepted`, null without a response in time."""
        found: dict[str, Any] = self.ask(
            do="send", order=order, same=same_id_as, action=action, timeout=seconds(20)
        )
        return found

    def result(self, goal: int, timeout: float | None = None) -> Any:
        """Return status and sequence; null without a response in time."""
        return self.ask(do="result", goal=goal, timeout=seconds(20) if timeout is None else timeout)

    def cancel(self, goal: int | None, stamp: tuple[int, int] = (0, 0), action: str = DEVICE) -> Any:
        """Return the code and the numbers of the goals that are canceling; null without a response in time."""
        return self.ask(do="cancel", goal=goal, stamp=list(stamp), action=action, timeout=seconds(20))


@contextmanager
def action_peer(domain: int) -> Iterator[ActionPeer]:
    """Run the process in a ROS domain."""
    with serving("tests.support.e2e.action_peer", domain) as process:
        yield ActionPeer(process)


class _Peer:
    """The peer's side: a node with clients, and the model in the same node."""

    def __init__(self, executor: Any) -> None:
        import rclpy
        from action_msgs.srv import CancelGoal
        from rclpy.action.client import ActionClient
        from test_msgs.action import Fibonacci

        self._executor = executor
        self._node = rclpy.create_node("asker")
        executor.add_node(self._node)
        self._type = Fibonacci
        self._clients = {name: ActionClient(self._node, Fibonacci, name) for name in (DEVICE, MODEL)}
        self._cancels = {
            name: self._node.create_client(CancelGoal, f"{name}/_action/cancel_goal")
            for name in (DEVICE, MODEL)
        }
        self._goals: list[Any] = []
        self._ids: list[Any] = []
        self._results: dict[int, Any] = {}
        self._feedback: list[Any] = []
        self._statuses: list[Any] = []
        self._often: list[Any] = []
        self._watches: Any = None
        self._model = self._make_model()

    def _make_model(self) -> Any:
        """Return a server of rclpy that does with a goal what its order says."""
        from rclpy.action.server import ActionServer, CancelResponse
        from rclpy.callback_groups import ReentrantCallbackGroup

        def execute(goal: Any) -> Any:
            end = deadline(5)
            while goal.request.order != 0 and not goal.is_cancel_requested and time.monotonic() < end:
                time.sleep(0.01)
            if goal.is_cancel_requested:
                goal.canceled()
            else:
                goal.succeed()
            return self._type.Result()

        return ActionServer(
            *(self._node, self._type, MODEL, execute),
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
            result_timeout=2,
        )

    def wait(self, action: str, timeout: float) -> bool:
        """Wait for all services and topics of the server."""
        return bool(self._clients[action].wait_for_server(timeout))

    def send(self, order: int, same: int | None, action: str, timeout: float) -> dict[str, Any]:
        from unique_identifier_msgs.msg import UUID

        identifier = UUID(uuid=list(uuid.uuid4().bytes)) if same is None else self._ids[same]
        number = len(self._ids)
        self._ids.append(identifier)
        future = self._clients[action].send_goal_async(
            self._type.Goal(order=order),
            feedback_callback=lambda m: self._feedback.append([number, list(m.feedback.sequence)]),
            goal_uuid=identifier,
        )
        handle = _wait(future, timeout)
        self._goals.append(handle)
        if handle is None:
            return {"goal": number, "accepted": None}
        return {
            "goal": number,
            "accepted": handle.accepted,
            "stamp": [handle.stamp.sec, handle.stamp.nanosec],
        }

    def ask(self, goal: int) -> bool:
        """Ask for a result, without waiting."""
        self._results[goal] = self._goals[goal].get_result_async()
        return True

    def ask_often(self, goal: int, times: int) -> bool:
        """Ask for one result several times, without waiting."""
        self._often = [self._goals[goal].get_result_async() for _ in range(times)]
        return True

    def answered(self) -> list[int]:
        """Return which of these requests were answered, in their order."""
        return [index for index, future in enumerate(self._often) if future.done()]

    def result(self, goal: int, timeout: float) -> Any:
        if goal not in self._results:
            self.ask(goal)
        response = _wait(self._results[goal], timeout)
        if response is None:
            return None
        del self._results[goal]
        return [response.status, list(response.result.sequence)]

    def cancel(self, goal: int | None, stamp: list[int], action: str, timeout: float) -> Any:
        from action_msgs.srv import CancelGoal

        request = CancelGoal.Request()
        if goal is not None and goal >= len(self._ids):
            request.goal_info.goal_id.uuid = list(uuid.uuid4().bytes)
        elif goal is not None:
            request.goal_info.goal_id = self._ids[goal]
        request.goal_info.stamp.sec, request.goal_info.stamp.nanosec = stamp
        response = _wait(self._cancels[action].call_async(request), timeout)
        if response is None:
            return None
        return [response.return_code, sorted(self._number(info.goal_id) for info in response.goals_canceling)]

    def _number(self, identifier: Any) -> int:
        return next((i for i, known in enumerate(self._ids) if list(known.uuid) == list(identifier.uuid)), -1)

    def feedback(self) -> list[Any]:
        """Return the feedback since the last call: the goal's number and the sequence."""
        found, self._feedback = self._feedback, []
        return found

    def watch(self, action: str) -> bool:
        """Subscribe to the states of goals, from now on alone."""
        from action_msgs.msg import GoalStatusArray
        from rclpy.qos import QoSDurabilityPolicy, QoSProfile

        if self._watches is not None:
            self._node.destroy_subscription(self._watches)
        self._statuses = []
        qos = QoSProfile(depth=100, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
        self._watches = self._node.create_subscription(
            GoalStatusArray,
            f"{action}/_action/status",
            self._keep_status,
            qos,
        )
        return True

    def _keep_status(self, message: Any) -> None:
        self._statuses.append([[self._number(s.goal_info.goal_id), s.status] for s in message.status_list])

    def statuses(self) -> list[Any]:
        """Return all states since `watch`: for each message the goals' numbers and their states."""
        return list(self._statuses)

    def endpoints(self, action: str) -> list[Any]:
        """Return names, types, type hashes and QoS of the endpoints of an action, as the graph shows them."""
        found: list[Any] = []
        for topic in ("feedback", "status"):
            for info in self._node.get_publishers_info_by_topic(f"{action}/_action/{topic}"):
                qos = info.qos_profile
                found.append(
                    [
                        *(topic, info.topic_type, str(info.topic_type_hash)),
                        *(qos.reliability.name, qos.durability.name),
                    ]
                )
        names = dict(self._node.get_service_names_and_types())
        for service in ("send_goal", "cancel_goal", "get_result"):
            found.append([service, names.get(f"{action}/_action/{service}")])
        return found

    def hidden(self, action: str) -> list[str]:
        """Return every topic and service of an action."""
        topics = [name for name, _ in self._node.get_topic_names_and_types() if name.startswith(action)]
        services = [name for name, _ in self._node.get_service_names_and_types() if name.startswith(action)]
        return sorted(topics + services)


def _wait(future: Any, timeout: float) -> Any:
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    return future.result() if done.wait(timeout) else None


def main() -> None:
    """Serve commands from stdin; callbacks run in threads."""
    import rclpy
    from rclpy.executors import MultiThreadedExecutor

    rclpy.init()
    executor = MultiThreadedExecutor(4)
    peer = _Peer(executor)
    threading.Thread(target=executor.spin, daemon=True).start()
    for line in sys.stdin:
        command = json.loads(line)
        print(json.dumps(getattr(peer, command.pop("do"))(**command)), flush=True)


if __name__ == "__main__":
    main()
