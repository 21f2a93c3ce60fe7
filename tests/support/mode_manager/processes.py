# SPDX-License-Identifier: Apache-2.0
"""Managers and nodes in processes, and another node that asks them."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

from microros_gen.mode_manager.diagnosis import TOPIC, TYPE, Row, read_rows
from microros_gen.mode_manager.messages import parameters_of
from microros_gen.ros.peer import Peer
from tests.support.patience import deadline, seconds
from tests.support.ros.running import running


def manager(domain: int, *arguments: str) -> Any:
    """Return a context with `microros-gen modes manage`."""
    return running(domain, "microros_gen", "modes", "manage", *arguments)


def node(domain: int, name: str, **values: Any) -> Any:
    """Return a context with a node of rclpy."""
    namespace, _, base = f"/{name}".rpartition("/")
    module = "tests.support.mode_manager.lifecycle_node"
    return running(domain, module, base, namespace or "/", json.dumps(values))


class Asking:
    """A node that requests and reads; requests without a response are repeated."""

    def __init__(self, peer: Peer) -> None:
        self.peer = peer
        self.rows: dict[str, Row] = {}
        peer.subscribe(TOPIC, TYPE, self._read)

    def _read(self, message: dict[str, Any]) -> None:
        for row in read_rows(message):
            self.rows[row.part] = row

    def call(self, service: str, kind: str, **request: Any) -> dict[str, Any]:
        client, end = self.peer.client(service, kind), deadline(60)
        while (response := client.call(request, seconds(5))) is None:
            assert time.monotonic() < end, f"no response of {service}"
        return response

    def change_mode(self, part: str, mode: str) -> bool:
        response = self.call(f"/{part}/change_mode", "system_modes_msgs/srv/ChangeMode", mode_name=mode)
        return bool(response["success"])

    def change_state(self, part: str, number: int) -> bool:
        response = self.call(
            f"/{part}/change_state", "lifecycle_msgs/srv/ChangeState", transition={"id": number}
        )
        return bool(response["success"])

    def state(self, part: str) -> str:
        response = self.call(f"/{part}/get_state", "lifecycle_msgs/srv/GetState")
        return str(response["current_state"]["label"])

    def mode(self, part: str) -> str:
        return str(self.call(f"/{part}/get_mode", "system_modes_msgs/srv/GetMode")["current_mode"])

    def set(self, part: str, **values: Any) -> None:
        results = self.call(
            f"/{part}/set_parameters", "rcl_interfaces/srv/SetParameters", parameters=parameters_of(values)
        )["results"]
        assert all(result["successful"] for result in results), results

    def until(self, condition: Callable[[], bool], idle_s: float = 30.0) -> None:
        end = deadline(idle_s)
        while not condition():
            self.peer.spin_once(0.1)
            assert time.monotonic() < end, self.rows

    def until_row(self, part: str, actual: str, idle_s: float = 30.0) -> None:
        self.until(lambda: part in self.rows and self.rows[part].actual == actual, idle_s)
