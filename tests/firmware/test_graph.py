# SPDX-License-Identifier: Apache-2.0
"""A board queries the ROS graph over its serial line, and counts what rclpy counts."""

from __future__ import annotations

import time
from contextlib import nullcontext

import pytest

from tests.support.agent.line_process import LineProcess
from tests.support.e2e.graph_peer import graph_peer
from tests.support.e2e.graph_server import graph_server
from tests.support.firmware.board import Builds, board, need
from tests.support.firmware.running import started
from tests.support.patience import deadline
from tests.support.slices import first

NAME = "qemu-mps2-an386"
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+{component}]
errors: code
memory: {{arena: 8192}}
session: {{connect_timeout: 20 s, create_timeout: 6 s, liveliness_timeout: 20 s}}
nodes:
  - name: device
    namespace: /arm
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
"""


def seen_by_rclpy(peer: LineProcess) -> list[int]:
    """Return what the report of the firmware has after its first word, but for the changes."""
    topics = peer.ask(do="names", what="topics", node="", namespace="")
    return [
        int(peer.ask(do="count", what="subscriptions", name="/arm/count")),
        len(peer.ask(do="nodes")),
        sum(len(word) for topic in topics for word in topic.split()),
    ]


@pytest.mark.variant  # of tests/e2e/test_graph.py, on a board
@pytest.mark.system
@pytest.mark.ros
@pytest.mark.parametrize("component", first(["graph", "graph_topic"]))
def test_the_firmware_sees_what_rclpy_sees(builds: Builds, domain: int, component: str) -> None:
    """By a graph server, and by the topic of micro_ros_agent, which this agent offers too."""
    built = builds.merged(NAME, APPLICATION.format(component=component))
    need(NAME, emulator=True)
    image = builds.application(built, "graph.c")
    with (
        graph_peer(domain) as peer,
        graph_server(domain) if component == "graph" else nullcontext(),
        board(built, image) as running,
        started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        running.go_on()

        def equal(subscriptions: int) -> None:
            end = deadline(60)
            while True:
                report, wanted = running.words("graph_report", 5), seen_by_rclpy(peer)
                if report[0] and report[1:4] == wanted and wanted[0] == subscriptions:
                    return
                assert time.monotonic() < end, (report, wanted)
                time.sleep(0.1)

        equal(0)
        peer.ask(do="subscribe", topic="/arm/count")
        equal(1)
        peer.ask(do="leave")
        equal(0)
        assert running.words("graph_report", 5)[4] > 0
