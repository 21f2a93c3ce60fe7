# SPDX-License-Identifier: Apache-2.0
"""A board that calls a service of rclpy and waits, is told of new messages, and takes a node out of its executor."""

from __future__ import annotations

import time

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.running import BOARD, started
from tests.support.patience import deadline

APPLICATION = """\
version: 1
profiles: [pure_reader]
components: [+services, +executor, +service_call, +executor_nodes, +new_data_callbacks]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}  # a busy test machine
nodes:
  - name: asker
    clients: [{name: /sum, type: example_interfaces/srv/AddTwoInts}]
  - name: listener
    subscriptions: [{topic: /numbers, type: std_msgs/msg/Int32, qos: {reliability: reliable}}]
"""
RCL_RET_ERROR = 1
SUM, RESPONSES, TIME_OUTS, REPORTED, HEARD, IN_CALLBACK, AWAY, REPORTS = range(8)


@pytest.mark.system
@pytest.mark.ros
def test_calls_callbacks_and_nodes(builds: Builds, observer: Observer, domain: int) -> None:
    built = builds.merged(BOARD, APPLICATION)
    need(BOARD, emulator=True)
    image = builds.application(built, "calls.c")
    with (
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()

        def report() -> list[int]:
            return running.words("calls_report", REPORTS)

        running.wait_for(lambda: report()[TIME_OUTS] > 0)  # there is no server yet
        assert report()[RESPONSES] == 0
        observer.ask(do="add", service="/sum")
        running.wait_for(lambda: report()[RESPONSES] > 1)
        sums = report()
        assert sums[SUM] == 41 + sums[RESPONSES]
        _publish(observer, 3)
        running.wait_for(lambda: report()[HEARD] == 3)
        assert report()[IN_CALLBACK] == RCL_RET_ERROR
        _publish(observer, 2)
        running.wait_for(lambda: report()[HEARD] == 5)
        assert report()[REPORTED:] == [5, 5, RCL_RET_ERROR, 0]


def _publish(observer: Observer, count: int) -> None:
    """Publish `count` numbers when the board's subscription is there."""
    where = {"topic": "/numbers", "type": "std_msgs/msg/Int32"}
    observer.ask(do="publish", values=[], **where)
    end = deadline(15)
    while not observer.ask(do="matched", topic="/numbers"):
        assert time.monotonic() < end, "no subscription"
        time.sleep(0.05)
    observer.ask(do="publish", values=[{"data": value} for value in range(count)], **where)
