# SPDX-License-Identifier: Apache-2.0
"""Sends a goal to an action server and follows it: three services and a topic.

Source: design.ros2.org/articles/actions.html, action_msgs.
"""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from typing import Any

from microros_gen.ros.endpoints import Client, Value
from microros_gen.ros.errors import RosError
from microros_gen.ros.peer import Peer

ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(1, 7)
"""Values of action_msgs/msg/GoalStatus."""
STATUS_NAMES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")
CANCEL_WAIT_S = 5.0
_TURN_S = 0.1


class Goal:
    """One goal of one action. Spin its peer to let callbacks run."""

    def __init__(
        self, peer: Peer, action: str, type_name: str, feedback: Callable[[Value], object] | None
    ) -> None:
        """Create the clients; `feedback` is called with each feedback of this goal.

        Raises UserError for an unknown type, RosError for an invalid name.
        """
        self._peer = peer
        self._goal_id = {"uuid": uuid.uuid4().bytes}
        self._feedback = feedback
        self._send = peer.client(f"{action}/_action/send_goal", f"{type_name}_SendGoal")
        self._result = peer.client(f"{action}/_action/get_result", f"{type_name}_GetResult")
        self._cancel = peer.client(f"{action}/_action/cancel_goal", "action_msgs/srv/CancelGoal")
        if feedback is not None:
            peer.subscribe(f"{action}/_action/feedback", f"{type_name}_FeedbackMessage", self._receive)

    @property
    def id(self) -> str:
        """The identity of the goal in hexadecimal digits."""
        return self._goal_id["uuid"].hex()

    def wait_for_server(self, wait_s: float) -> bool:
        """Spin until the three services of a server are discovered, for at most `wait_s` seconds each."""
        return all(client.wait(wait_s) for client in (self._send, self._result, self._cancel))

    def send(self, goal: Mapping[str, Any], given_up: Callable[[], bool]) -> bool | None:
        """Send the goal and wait for the answer; return whether the server accepted it.

        None if `given_up()` became true before. Raises RosError if the server is gone meanwhile.
        """
        response = self._asked(self._send, {"goal_id": self._goal_id, "goal": dict(goal)}, given_up)
        return None if response is None else bool(response["accepted"])

    def result(self, given_up: Callable[[], bool]) -> tuple[int, Value] | None:
        """Wait for the end of the goal; return its status and its result, None if `given_up()` became true before.

        Raises RosError if the server is gone meanwhile.
        """
        response = self._asked(self._result, {"goal_id": self._goal_id}, given_up)
        return None if response is None else (response["status"], response["result"])

    def cancel(self) -> bool:
        """Ask the server to cancel the goal; return whether it will. False after `CANCEL_WAIT_S` without an answer."""
        request = {"goal_info": {"goal_id": self._goal_id}}
        response = self._cancel.call(request, CANCEL_WAIT_S)
        return response is not None and bool(response["goals_canceling"])

    def _asked(self, client: Client, request: Value, given_up: Callable[[], bool]) -> Value | None:
        responses: list[Value] = []
        client.send(request, responses.append)
        while not responses and not given_up():
            self._peer.spin_once(_TURN_S)
            if not responses and not client.available():
                raise RosError(f"{client.name}: the server is gone")
        return responses[0] if responses else None

    def _receive(self, message: Value) -> None:
        if self._feedback is not None and message["goal_id"]["uuid"] == self._goal_id["uuid"]:
            self._feedback(message["feedback"])


def status_name(status: int) -> str:
    """Return the name of a status of a goal."""
    return STATUS_NAMES[status] if 0 <= status < len(STATUS_NAMES) else STATUS_NAMES[0]
