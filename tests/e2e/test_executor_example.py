# SPDX-License-Identifier: Apache-2.0
"""The generated main.c with declared executors and timers, run: with sanitizers, this project's agent and rclpy."""

from __future__ import annotations

import time
from itertools import pairwise

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import SANITIZE, Images, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+timers, +services]
nodes:
  - name: arm
    namespace: /executors
    publishers: [{topic: count, type: std_msgs/msg/UInt32}]
    subscriptions: [{topic: order, type: std_msgs/msg/Int32, qos: {depth: 10}}]
    services: [{name: power, type: std_srvs/srv/SetBool}]
    clients: [{name: power, type: std_srvs/srv/SetBool}]
    timers: [{name: fast, period: 20 ms}, {name: slow, period: 100 ms}]
    executors:
      - {name: control, handles: [fast, order], timeout: 5 ms}
      - {name: rest, handles: [slow, power]}
limits: {"*": {string: 16}}
"""
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")
COUNT, ORDER = "/executors/count", "/executors/order"


def test_declared_timers_publish_and_callbacks_take(
    images: Images, image_port: Relay, agent: AgentProcess, observer: Observer
) -> None:
    """Two executors: one publishes and hears orders, the other asks and answers itself."""
    image = images.build(image_port.port, APPLICATION, flags=(*SANITIZE, *WARNINGS))
    observer.subscribe(COUNT, "std_msgs/msg/UInt32")
    observer.ask(do="publish", topic=ORDER, type="std_msgs/msg/Int32", values=[])
    end = deadline(40)
    wanted = {"order: 7", "request of power", "reply of power"}
    with started(image.out / "bin" / "pure_sender+pure_reader") as process:
        while not observer.ask(do="matched", topic=ORDER):
            assert time.monotonic() < end, "nobody subscribes"
            time.sleep(0.05)
        observer.ask(do="publish", topic=ORDER, type="std_msgs/msg/Int32", values=[{"data": 7}])
        counts = [value["data"] for _, value in observer.got(20, topic=COUNT)]
        assert process.stdout is not None
        for line in process.stdout:  # it goes on printing requests and replies
            wanted -= {line.strip().partition(": ")[0], line.strip()}
            if not wanted:
                break
            assert time.monotonic() < end, f"not seen: {wanted}"
        process.terminate()
        _, errors = process.communicate(timeout=seconds(15))
    assert (wanted, errors) == (set(), "")
    assert all(former < later for former, later in pairwise(counts)), counts
