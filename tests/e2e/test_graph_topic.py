# SPDX-License-Identifier: Apache-2.0
"""A device queries the ROS graph by the topic of micro_ros_agent, which this project's agent offers too."""

from __future__ import annotations

import time
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from tests.support.agent.line_process import LineProcess
from tests.support.agent.process import running_agent
from tests.support.e2e.graph_device import LISTS_OF_NODE, OK, STRICT, Device, alike, running
from tests.support.e2e.graph_peer import NODE, graph_peer
from tests.support.e2e.images import C_FILES, Images
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_topic]
memory: {arena: 60000}
pools: {guard_conditions: 1}
session: {connect_timeout: 20 s, create_timeout: 4 s}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: order, type: std_msgs/msg/Int32}]
    clients: [{name: set, type: std_srvs/srv/SetBool, limits: {message: 8}, storage: none}]
"""


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(
        C_FILES / "graph.c", tmp_path_factory.mktemp("graph_topic") / "graph_topic", *STRICT
    )


def counted(device: Device, peer: LineProcess, what: str, name: str, part: Any = None) -> Any:
    """Wait until both count the same, which is `part`; return it."""
    return alike(
        lambda: device.lines(f"count {what} {name}"),
        lambda: [str(peer.ask(do="count", what=what, name=name))],
        part,
    )


def test_what_rclpy_sees(program: Path, agent: object, domain: int) -> None:
    with graph_peer(domain) as peer, running(program) as device:
        peer.ask(do="subscribe", topic="/arm/count")
        peer.ask(do="serve", name="/arm/set")
        nodes = alike(lambda: sorted(device.lines("nodes")), lambda: peer.ask(do="nodes"), "/arm device")
        assert " ".join(NODE) in nodes
        for what, part in (
            ("topics", "/arm/count std_msgs/msg/Int32"),
            ("services", "/arm/set std_srvs/srv/SetBool"),
        ):
            alike(
                partial(device.sorted, f"names {what}"),
                partial(peer.ask, do="names", what=what, node="", namespace=""),
                part,
            )
        for (namespace, name), what in product((("/arm", "device"), NODE), LISTS_OF_NODE):
            alike(
                partial(device.sorted, f"names {what} {name} {namespace}"),
                partial(peer.ask, do="names", what=what, node=name, namespace=namespace),
            )
        for what, name in (
            *product(("publishers", "subscriptions"), ("/arm/count", "/arm/order", "/parameter_events")),
            *product(("servers", "clients"), ("/arm/set",)),
        ):
            counted(device, peer, what, name)
        assert device.lines("count available") == ["1"]
        assert device.lines("count matched_subscriptions") == ["1"]


@pytest.mark.system
def test_changes(program: Path, agent: object, domain: int) -> None:
    with graph_peer(domain) as peer, running(program) as device:
        counted(device, peer, "subscriptions", "/arm/count", "0")
        peer.ask(do="subscribe", topic="/arm/count")
        assert device.call("change 20000")[0] == OK
        counted(device, peer, "subscriptions", "/arm/count", "1")
        peer.ask(do="leave")
        counted(device, peer, "subscriptions", "/arm/count", "0")
        end = deadline(20)
        while device.lines("changes") == ["0"]:
            device.call("spin 100")
            assert time.monotonic() < end


@pytest.mark.variant
@pytest.mark.system
def test_an_agent_that_restarts(program: Path, relay: Relay, domain: int) -> None:
    with graph_peer(domain) as peer:
        peer.ask(do="subscribe", topic="/arm/count")
        with running_agent(domain, "--domain", str(domain)) as agent:
            relay.connect(agent.port)
            with running(program) as device:
                counted(device, peer, "subscriptions", "/arm/count", "1")
                agent.process.kill()
                agent.process.wait()
                code, error, _ = device.call("count subscriptions /arm/count")
                assert code != OK, error
                with running_agent(domain, "--domain", str(domain)) as other:
                    relay.connect(other.port)
                    end = deadline(30)
                    while device.call("count subscriptions /arm/count")[2] != ["count 1"]:
                        device.call("spin 100")
                        assert time.monotonic() < end
                    assert other.stop() == 0
