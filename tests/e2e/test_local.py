# SPDX-License-Identifier: Apache-2.0
"""Local delivery besides ROS: rclpy receives and publishes, and a node receives each local message once."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
nodes:
  - name: device
    namespace: /local
    domain_id: DOMAIN
    publishers:
      - {topic: said, type: std_msgs/msg/Int32, local: also}
      - {topic: told, type: std_msgs/msg/Int32, local: only}
      - {topic: inside, type: std_msgs/msg/Int32, local: only}
    subscriptions:
      - {topic: said, type: std_msgs/msg/Int32, local: only}
      - {topic: told, type: std_msgs/msg/Int32, local: also, queue: 8}
      - {topic: inside, type: std_msgs/msg/Int32, local: only}
"""
FROM_ROS, COUNT = 100_000, 5
SERVED = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services, +executor]
nodes:
  - name: server
    namespace: /local
    domain_id: DOMAIN
    services: [{name: sum, type: example_interfaces/srv/AddTwoInts, local: also}]
  - name: caller
    namespace: /local
    domain_id: DOMAIN
    clients: [{name: sum, type: example_interfaces/srv/AddTwoInts, local: only}]
"""
PAIRS = [[FROM_ROS + i, i] for i in range(COUNT)]


def test_besides_rclpy(
    images: Images, shared_agent: AgentProcess, observer: Observer, domain: int, tmp_path: Path
) -> None:
    image = images.build(shared_agent.port, APPLICATION.replace("DOMAIN", str(domain)))
    program = image.application(C_FILES / "local.c", tmp_path / "local", "-std=c99", "-Wall", "-Werror")
    observer.subscribe("/local/said", "std_msgs/msg/Int32")
    request = {"do": "publish", "topic": "/local/told", "type": "std_msgs/msg/Int32"}
    observer.ask(**request, values=[])
    with started(program) as process:
        values = [value["data"] for _, value in observer.got(20, topic="/local/said")]
        end = deadline(15)
        while observer.ask(do="matched", topic="/local/told") != 1:
            assert time.monotonic() < end, "no subscription of /local/told"
            time.sleep(0.05)
        for topic, ends in (("said", ["publisher"]), ("told", ["subscription"]), ("inside", [])):
            found = observer.ask(do="endpoints", topic=f"/local/{topic}")
            of_device = [e for e in found if e["node"].endswith("device")]
            assert len(of_device) == len(ends), (topic, found)
        observer.ask(**request, values=[{"data": FROM_ROS + i} for i in range(COUNT)])
        ends_well(process, 30)
    assert values == list(range(values[0], values[0] + len(values)))


def test_a_service_besides_rclpy(
    images: Images, shared_agent: AgentProcess, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """The server answers the client of its image and clients of ROS; only the server exists in ROS."""
    image = images.build(shared_agent.port, SERVED.replace("DOMAIN", str(domain)))
    program = image.application(
        C_FILES / "local_services.c", tmp_path / "local", "-std=c99", "-Wall", "-Werror"
    )
    with started(program) as process:
        observer.ask(do="ask_sums", service="/local/sum", pairs=PAIRS)
        ends_well(process, 60)
        end = deadline(15)
        while observer.ask(do="sums") != [sum(pair) for pair in PAIRS]:
            assert time.monotonic() < end, observer.ask(do="sums")
            time.sleep(0.05)
