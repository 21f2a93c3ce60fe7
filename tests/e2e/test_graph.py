# SPDX-License-Identifier: Apache-2.0
"""A device queries the ROS graph through a graph server, and sees what rclpy sees."""

from __future__ import annotations

import time
from functools import partial
from itertools import product
from pathlib import Path

import pytest

from tests.support.agent.line_process import LineProcess
from tests.support.agent.process import running_agent
from tests.support.e2e.graph_device import LISTS_OF_NODE, OK, STRICT, Device, alike, running
from tests.support.e2e.graph_peer import NODE, graph_peer
from tests.support.e2e.graph_server import SHORT, graph_server
from tests.support.e2e.images import C_FILES, Images
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph]
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
SERVER_READY = "graph server ready: /microros_graph"
TIMEOUT = 2


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "graph.c", tmp_path_factory.mktemp("graph") / "graph", *STRICT)


def served(device: Device) -> None:
    """Wait until a graph server answers; agent and server discover each other first."""
    end = deadline(60)
    while (result := device.call("count publishers /arm/count"))[2] != ["count 1"]:
        assert time.monotonic() < end, result
        time.sleep(0.1)


def matched_subscriptions(device: Device) -> int:
    """Wait until the server has discovered the device's publisher; return how many subscriptions match it."""
    end = deadline(30)
    while (result := device.call("count matched_subscriptions"))[0] != OK:
        assert time.monotonic() < end, result
        time.sleep(0.1)
    return int(result[2][0].partition(" ")[2])


def compare_names(device: Device, peer: LineProcess) -> None:
    for what, part in (
        ("topics", "/arm/count std_msgs/msg/Int32"),
        ("services", "/arm/set std_srvs/srv/SetBool"),
        ("mangled", "rt/arm/count std_msgs::msg::dds_::Int32_"),
    ):
        alike(
            partial(device.sorted, f"names {what}"),
            partial(peer.ask, do="names", what=what, node="", namespace=""),
            part,
        )
    for (namespace, name), what in product(
        (("/arm", "device"), NODE, ("/", "microros_graph")), LISTS_OF_NODE
    ):
        command = f"names {what} {name} {namespace}"
        alike(
            partial(device.sorted, command),
            partial(peer.ask, do="names", what=what, node=name, namespace=namespace),
        )


def compare_endpoints(device: Device, peer: LineProcess) -> None:
    topics = ("/arm/count", "/arm/order", "/parameter_events", "/microros_graph/changes")
    services = ("/arm/set", "/microros_graph/list_names")
    for what, topic in product(("publishers", "subscriptions"), topics):
        alike(
            partial(device.sorted, f"infos {what} {topic}"),
            partial(peer.ask, do="infos", what=what, topic=topic),
        )
    counted = [*product(("publishers", "subscriptions"), topics), *product(("servers", "clients"), services)]
    for what, name in counted:
        (count,) = device.lines(f"count {what} {name}")
        assert int(count) == peer.ask(do="count", what=what, name=name)


def test_what_rclpy_sees(program: Path, agent: object, domain: int) -> None:
    with graph_peer(domain) as peer, graph_server(domain), running(program) as device:
        served(device)
        peer.ask(do="subscribe", topic="/arm/count")
        peer.ask(do="serve", name="/arm/set")
        nodes = alike(lambda: sorted(device.lines("nodes")), lambda: peer.ask(do="nodes"), "/arm device")
        assert {"/ microros_graph", " ".join(NODE)} <= set(nodes)
        compare_names(device, peer)
        compare_endpoints(device, peer)
        assert device.lines("count available") == ["1"]


def test_actions_that_rclpy_sees(program: Path, agent: object, domain: int) -> None:
    """Servers and clients of actions of a node without, with some, and with other topics; and of the whole graph."""
    with graph_peer(domain) as peer, graph_server(domain), running(program) as device:
        served(device)
        # those of an earlier test may not have expired yet
        before = alike(
            partial(device.sorted, "names actions"),
            partial(peer.ask, do="names", what="actions", node="", namespace=""),
        )
        assert not any("/arm/walk" in action or "/run" in action for action in before)
        peer.ask(do="act", server="/arm/walk", client="/run")
        kind = "test_msgs/action/Fibonacci"
        end = deadline(20)
        while "is not known" in device.call(f"names action_servers_of {NODE[1]} {NODE[0]}")[1]:
            assert time.monotonic() < end, "the node is not discovered"
        for what, node, wanted in (
            ("action_servers_of", NODE, [f"/arm/walk {kind}"]),
            ("action_clients_of", NODE, [f"/run {kind}"]),
            ("action_servers_of", ("/arm", "device"), []),
        ):
            found = alike(
                partial(device.sorted, f"names {what} {node[1]} {node[0]}"),
                partial(peer.ask, do="names", what=what, node=node[1], namespace=node[0]),
                wanted[0] if wanted else None,
            )
            assert found == wanted
        found = alike(
            partial(device.sorted, "names actions"),
            partial(peer.ask, do="names", what="actions", node="", namespace=""),
            f"/run {kind}",
        )
        assert f"/arm/walk {kind}" in found


@pytest.mark.system
def test_a_short_script_instead_of_the_server(program: Path, agent: object, domain: int) -> None:
    """It has the contract of the page, and nothing else of this tool's server: queries, changes, matched counts."""
    with graph_peer(domain) as peer, graph_server(domain, SHORT), running(program) as device:
        served(device)
        before = matched_subscriptions(device)
        peer.ask(do="serve", name="/arm/set")
        peer.ask(do="subscribe", topic="/arm/count")
        assert device.call("change 20000")[0] == OK
        alike(lambda: device.lines("count matched_subscriptions"), lambda: [str(before + 1)])
        nodes = alike(lambda: sorted(device.lines("nodes")), lambda: peer.ask(do="nodes"), "/arm device")
        assert {"/ microros_graph", "/ short_graph_server", " ".join(NODE)} <= set(nodes)
        compare_names(device, peer)
        compare_endpoints(device, peer)
        assert device.lines("count available") == ["1"]
        peer.ask(do="leave")
        alike(lambda: device.lines("count matched_subscriptions"), lambda: [str(before)])


@pytest.mark.system
def test_changes_and_matched_counts(program: Path, agent: object, domain: int) -> None:
    with graph_peer(domain) as peer, graph_server(domain), running(program) as device:
        served(device)
        before = matched_subscriptions(device)
        peer.ask(do="subscribe", topic="/arm/count")
        assert device.call("change 20000")[0] == OK
        alike(lambda: device.lines("count matched_subscriptions"), lambda: [str(before + 1)])
        peer.ask(do="publish", topic="/arm/order")
        alike(lambda: device.lines("count matched_publishers"), lambda: [str(peer.ask(do="matched"))], "1")
        peer.ask(do="leave")
        alike(lambda: device.lines("count matched_subscriptions"), lambda: [str(before)])
        end = deadline(20)
        while device.lines("changes") == ["0"]:  # a notice comes at most 0.2 s after the change
            device.call("spin 100")
            assert time.monotonic() < end


@pytest.mark.system
def test_a_server_inside_the_agent(program: Path, relay: Relay, domain: int) -> None:
    options = ("--domain", str(domain), "--graph-server")
    with running_agent(domain, *options) as agent:
        relay.connect(agent.port)
        if not any(
            SERVER_READY in line for line in agent.log
        ):  # on stderr, which may be read later than stdout
            agent.wait_for(SERVER_READY)
        with graph_peer(domain) as peer, running(program) as device:
            served(device)
            assert matched_subscriptions(device) == 0
            alike(lambda: sorted(device.lines("nodes")), lambda: peer.ask(do="nodes"), "/ microros_graph")
            peer.ask(do="subscribe", topic="/arm/count")
            assert device.call("change 20000")[0] == OK
            alike(lambda: device.lines("count matched_subscriptions"), lambda: ["1"])
        assert agent.stop() == 0


@pytest.mark.system
def test_a_server_that_restarts(program: Path, agent: object, domain: int) -> None:
    with graph_server(domain) as server, running(program) as device:
        served(device)
        server.kill()
        server.wait()
        code, error, _ = device.call("count publishers /arm/count")
        assert (code, error) == (
            TIMEOUT,
            "no answer of a graph server within 4000 ms: start `microros-gen graph-server`",
        )
        with graph_server(domain):
            served(device)
            assert device.call("change 20000")[0] == OK
