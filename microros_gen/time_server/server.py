# SPDX-License-Identifier: Apache-2.0
"""A ROS node that publishes /clock and has the parameters of that clock."""

from __future__ import annotations

import time
from collections.abc import Callable

from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving
from microros_gen.time_server.clock import NS_PER_S, SimulatedClock
from microros_gen.time_server.parameters import ClockParameters

NODE = "microros_time"
TOPIC = "/clock"
QOS = Qos(depth=1)
"""Reliable: subscriptions of both reliabilities get it."""
_LONGEST_S = 0.5


class TimeServer(Serving):
    """Publishes in the thread that calls `turn`, `rate_hz` times a second and at each change, also while paused."""

    def __init__(
        self,
        peer: Peer,
        clock: SimulatedClock,
        rate_hz: float,
        report: Callable[[str], object],
        elapsed_s: Callable[[], float] = time.monotonic,
    ) -> None:
        """Create publisher and services; `report` gets a line about each request that could not be answered.

        Raises RosError if the node cannot have them.
        """
        super().__init__(peer, report)
        self._clock, self._elapsed_s, self._period_s = clock, elapsed_s, 1 / rate_hz
        self._parameters = ClockParameters(clock)
        self._published, self._due_s = 0, elapsed_s()
        self._publisher = peer.publisher(TOPIC, "rosgraph_msgs/msg/Clock", QOS)
        for name, kind, answer in (
            ("set_parameters", "SetParameters", self._parameters.set_each),
            ("set_parameters_atomically", "SetParametersAtomically", self._parameters.set_all),
            ("get_parameters", "GetParameters", self._parameters.get),
            ("get_parameter_types", "GetParameterTypes", self._parameters.types),
            ("describe_parameters", "DescribeParameters", self._parameters.describe),
            ("list_parameters", "ListParameters", self._parameters.names),
        ):
            peer.serve(f"/{NODE}/{name}", f"rcl_interfaces/srv/{kind}", answer)

    def turn(self) -> None:
        """Wait for requests until the next time is due, and publish it. What is late is left out."""
        self._spin(min(self._due_s - self._elapsed_s(), _LONGEST_S))
        now_s = self._elapsed_s()
        if now_s >= self._due_s:
            self._due_s += self._period_s * (1 + (now_s - self._due_s) // self._period_s)
        elif self._published == self._parameters.changed:
            return
        self._published = self._parameters.changed
        self._attempt(self._publish)

    def _publish(self) -> None:
        seconds, rest_ns = divmod(self._clock.now_ns(), NS_PER_S)
        self._publisher.publish({"clock": {"sec": seconds, "nanosec": rest_ns}})
