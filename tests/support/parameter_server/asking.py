# SPDX-License-Identifier: Apache-2.0
"""A board that is there while a block runs, and another node that uses the parameters that are held for it."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from microros_gen.parameter_server.server import NOTICES_QOS, NOTICES_TOPIC
from microros_gen.parameter_server.values import DOUBLE, ParameterValue, value_of
from microros_gen.ros.peer import Peer
from tests.support.parameter_server.board import Board
from tests.support.patience import deadline, seconds
from tests.support.ros.running import node_in_thread

KIND = "rcl_interfaces/srv"


def alive(board: Board, node: str = "/arm") -> AbstractContextManager[None]:
    """Return a context in which the board is there, in a thread."""

    def begin(peer: Peer) -> Callable[[], object]:
        peer.serve(f"{node}/exchange_parameters", "microros_parameter_msgs/srv/Exchange", board.answer)
        notices = peer.publisher(NOTICES_TOPIC, "microros_parameter_msgs/msg/Notice", NOTICES_QOS)
        due = 0.0

        def turn() -> None:
            nonlocal due
            if board.has_news and time.monotonic() > due:
                notices.publish(board.notice(node))
                due = time.monotonic() + 1

        return turn

    return node_in_thread("arm_board", begin)


class Asking:
    """Another node that uses the six services of /arm."""

    def __init__(self, peer: Peer, node: str = "/arm") -> None:
        self.peer = peer
        self._node = node
        self.events: list[dict[str, Any]] = []
        peer.subscribe("/parameter_events", "rcl_interfaces/msg/ParameterEvent", self.events.append)

    def call(self, service: str, kind: str, **request: Any) -> dict[str, Any]:
        """Repeat a request without a response: it may have gone to a server that was killed, which DDS still knows."""
        client, end = self.peer.client(f"{self._node}/{service}", f"{KIND}/{kind}"), deadline(60)
        while (response := client.call(request, seconds(10))) is None:
            assert time.monotonic() < end, f"no response of {service}"
        return response

    def get(self, *names: str) -> list[Any]:
        values = self.call("get_parameters", "GetParameters", names=list(names))["values"]
        return [value_of(value).value for value in values]

    def set(self, **values: ParameterValue) -> list[tuple[bool, str]]:
        parameters = [{"name": name, "value": value.message()} for name, value in values.items()]
        results = self.call("set_parameters", "SetParameters", parameters=parameters)["results"]
        return [(result["successful"], result["reason"]) for result in results]

    def set_double(self, name: str, value: float) -> None:
        ((done, reason),) = self.set(**{name: ParameterValue(DOUBLE, value)})
        assert (done, reason) == (True, "")

    def until(self, condition: Callable[[], bool]) -> None:
        end = deadline(20)
        while not condition():
            self.peer.spin_once(0.1)
            assert time.monotonic() < end
