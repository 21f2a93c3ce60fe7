# SPDX-License-Identifier: Apache-2.0
"""A node of ROS 2 that drives a device with modes, /arm/device."""

from __future__ import annotations

import time
from typing import Any

from microros_gen.ros.peer import Peer
from tests.support.patience import deadline, seconds

KINDS = {
    "change_mode": "system_modes_msgs/srv/ChangeMode",
    "get_available_modes": "system_modes_msgs/srv/GetAvailableModes",
    "get_mode": "system_modes_msgs/srv/GetMode",
    "change_state": "lifecycle_msgs/srv/ChangeState",
    "get_parameters": "rcl_interfaces/srv/GetParameters",
    "set_parameters": "rcl_interfaces/srv/SetParameters",
}
CONFIGURE, CLEANUP, ACTIVATE, DEACTIVATE = 1, 2, 3, 4
DOUBLE = 3


class ModeAsker:
    """A node of ROS with clients of the device's services and its events."""

    def __init__(self, peer: Peer) -> None:
        """Wait until the device answers and its events arrive; it is unconfigured then."""
        self.peer = peer
        self.clients = {name: peer.client(f"/arm/device/{name}", kind) for name, kind in KINDS.items()}
        self.events: list[tuple[str, str]] = []
        self.times: list[int] = []
        peer.subscribe("/arm/device/mode_event", "system_modes_msgs/msg/ModeEvent", self._keep)
        self.await_answer("get_mode", {})
        self.await_answer("change_mode", {"mode_name": "NONE"})
        self.await_answer("change_state", {"transition": {"id": 0, "label": "none"}})
        self._await_events()

    def _keep(self, event: Any) -> None:
        self.events.append((event["start_mode"]["label"], event["goal_mode"]["label"]))
        self.times.append(event["timestamp"])

    def await_answer(self, name: str, request: dict[str, Any]) -> None:
        """Repeat a request that changes nothing until it is answered: the first ones may come too early."""
        end = deadline(60)
        while self.clients[name].call(request, seconds(1)) is None:
            assert time.monotonic() < end, name

    def _await_events(self) -> None:
        """Change modes until an event arrives, then begin with the state in which the device starts."""
        end = deadline(60)
        self.state(CONFIGURE)
        while not self.events:
            assert time.monotonic() < end
            self.change("__DEFAULT__")
            self.peer.spin(lambda: self.events, 0.5)
        self.state(CLEANUP)
        self.peer.spin(lambda: False, 0.5)
        self.events.clear()
        self.times.clear()

    def begin(self, name: str, **request: Any) -> list[Any]:
        """Send a request; return the list that its response will be in, if one arrives."""
        answers: list[Any] = []
        self.clients[name].send(request, answers.append)
        return answers

    def ask(self, name: str, **request: Any) -> Any:
        answer = self.clients[name].call(request, seconds(30))
        assert answer is not None, name
        return answer

    def change(self, mode: str) -> bool:
        return bool(self.ask("change_mode", mode_name=mode)["success"])

    def state(self, transition: int) -> None:
        assert self.ask("change_state", transition={"id": transition, "label": ""})["success"]

    def mode(self) -> str:
        return str(self.ask("get_mode")["current_mode"])

    def await_events(self, count: int) -> list[tuple[str, str]]:
        assert self.peer.spin(lambda: len(self.events) >= count, seconds(20)), self.events
        return self.events
