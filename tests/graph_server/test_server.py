# SPDX-License-Identifier: Apache-2.0
"""The graph server as a process, asked by a peer, besides what rclpy sees."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from itertools import product
from typing import Any

import pytest

from microros_gen.graph_server import answers
from microros_gen.graph_server.server import (
    CHANGE_QOS,
    CHANGE_TOPIC,
    ENDPOINTS_SERVICE,
    NAMES_SERVICE,
    STATUS_SERVICE,
    GraphServer,
)
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from tests.support.agent.process import environment, own_domain
from tests.support.e2e.graph_server import graph_server
from tests.support.patience import seconds
from tests.support.runtime.graph_agent import MadeGraph

pytestmark = pytest.mark.ros
IDLE_S = 15.0
"""What suffices on an idle machine; asked for at each wait, since the load changes while tests run."""
INT32 = "std_msgs/msg/Int32"
READY = "graph server ready: /microros_graph\n"


@pytest.fixture(scope="module")
def server() -> Iterator[subprocess.Popen[str]]:
    """The process; peers of this process are in its domain."""
    domain = own_domain()
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment(domain).items():
            patch.setenv(name, value)
        with graph_server(domain) as process:
            yield process


@pytest.fixture
def peer(server: subprocess.Popen[str]) -> Iterator[Peer]:
    with Peer("asking") as asking:
        yield asking


class Asked:
    """Both services, by the peer's clients."""

    def __init__(self, peer: Peer) -> None:
        self._names = peer.client(NAMES_SERVICE, "microros_graph_msgs/srv/ListNames")
        self._endpoints = peer.client(ENDPOINTS_SERVICE, "microros_graph_msgs/srv/ListEndpoints")

    def names(self, what: int, **request: Any) -> dict[str, Any]:
        response = self._names.call(
            {"what": what, "names_max": 999, "types_max": 9, **request}, seconds(IDLE_S)
        )
        assert response is not None
        return response

    def listed(self, what: int, **request: Any) -> tuple[Any, ...]:
        response = self.names(what, **request)
        assert response["status"] == answers.OK
        return tuple((item["name"], tuple(item["types"])) for item in response["names"])

    def endpoints(self, what: int, name: str, **request: Any) -> dict[str, Any]:
        whole = {"what": what, "name": name, "endpoints_max": 99, **request}
        response = self._endpoints.call(whole, seconds(IDLE_S))
        assert response is not None
        return response

    def nodes(self, what: int, topic: str) -> list[str]:
        """Return the nodes of the publishers or subscriptions of a topic."""
        return [endpoint["node"] for endpoint in self.endpoints(what, topic)["endpoints"]]


def agree(peer: Peer, expected: Callable[[], Any], answered: Callable[[], Any]) -> Any:
    """Wait until both sides have discovered the same; return it."""
    assert peer.spin(lambda: expected() == answered(), seconds(IDLE_S)), (expected(), answered())
    return expected()


def test_names_are_those_that_rclpy_sees(peer: Peer) -> None:
    querying, graph = Asked(peer), peer.graph()
    with Peer("arm", "/left") as arm:
        arm.publisher("state", INT32)
        arm.subscribe("/goal", "std_msgs/msg/String", print)
        arm.serve("enable", "std_srvs/srv/SetBool", lambda _: {})
        arm.client("/left/home", "std_srvs/srv/Trigger")
        node = arm.name
        sides: list[tuple[Callable[[], Any], Callable[[], Any]]] = [
            (lambda: tuple((n, ()) for n in graph.nodes()), lambda: querying.listed(answers.NODES)),
            (
                lambda: tuple((n, (enclave,)) for n, enclave in graph.nodes_with_enclaves()),
                lambda: querying.listed(answers.NODES_WITH_ENCLAVES),
            ),
            (graph.topics, lambda: querying.listed(answers.TOPICS)),
            (graph.services, lambda: querying.listed(answers.SERVICES)),
            (lambda: graph.publishers_of(node), lambda: querying.listed(answers.PUBLISHERS_OF, node=node)),
            (
                lambda: graph.subscriptions_of(node),
                lambda: querying.listed(answers.SUBSCRIPTIONS_OF, node=node),
            ),
            (lambda: graph.services_of(node), lambda: querying.listed(answers.SERVICES_OF, node=node)),
            (lambda: graph.clients_of(node), lambda: querying.listed(answers.CLIENTS_OF, node=node)),
            (lambda: graph.topics(demangle=False), lambda: querying.listed(answers.DDS_TOPICS)),
            (
                lambda: graph.publishers_of(node, demangle=False),
                lambda: querying.listed(answers.DDS_PUBLISHERS_OF, node=node),
            ),
            (
                lambda: graph.subscriptions_of(node, demangle=False),
                lambda: querying.listed(answers.DDS_SUBSCRIPTIONS_OF, node=node),
            ),
        ]
        assert peer.spin(lambda: graph.clients_of(node), seconds(IDLE_S))
        found = [agree(peer, expected, answered) for expected, answered in sides]
        assert {("/left/arm", ()), ("/microros_graph", ()), ("/asking", ())} <= set(found[0])
        assert ("/left/arm", ("/",)) in found[1]
        dds_int32 = "std_msgs::msg::dds_::Int32_"
        assert ("rt/left/state", (dds_int32,)) in found[8]
        assert ("rq/left/enableRequest", ("std_srvs::srv::dds_::SetBool_Request_",)) in found[8]
        assert ("rt/left/state", (dds_int32,)) in found[9]
        assert ("rt/goal", ("std_msgs::msg::dds_::String_",)) in found[10]
        assert found[4:8] == [
            (("/left/state", (INT32,)),),
            (("/goal", ("std_msgs/msg/String",)),),
            (("/left/enable", ("std_srvs/srv/SetBool",)),),
            (("/left/home", ("std_srvs/srv/Trigger",)),),
        ]
    agree(peer, graph.topics, lambda: querying.listed(answers.TOPICS))
    assert peer.spin(
        lambda: querying.names(answers.CLIENTS_OF, node=node)["status"] == answers.UNKNOWN_NODE,
        seconds(IDLE_S),
    )


def test_endpoints_and_counts_are_those_that_rclpy_sees(peer: Peer) -> None:
    querying, graph = Asked(peer), peer.graph()
    with Peer("pair", "/right") as pair:
        pair.publisher("/data", INT32, Qos(reliable=False, deadline_ms=20))
        pair.publisher("/data", INT32, Qos(transient_local=True, lifespan_ms=1500))
        pair.subscribe("/data", INT32, print)
        pair.serve("/enable", "std_srvs/srv/SetBool", lambda _: {})

        def complete() -> bool:
            found = (*graph.publishers("/data"), *graph.subscriptions("/data"))
            return [endpoint.node for endpoint in found] == [pair.name] * 3

        assert peer.spin(complete, seconds(IDLE_S))
        for what, endpoints_of in (
            (answers.PUBLISHERS, graph.publishers),
            (answers.SUBSCRIPTIONS, graph.subscriptions),
        ):
            expected = endpoints_of("/data")
            total = partial(querying.endpoints, what, "/data")
            agree(peer, lambda: len(endpoints_of("/data")), lambda: total()["total"])  # noqa: B023
            # Endpoints are discovered before the names of their nodes.
            known = lambda: {e["node"] for e in total()["endpoints"]}  # noqa: B023, E731
            agree(peer, lambda: {pair.name}, known)
            response = querying.endpoints(what, "/data")
            assert not response["truncated"]
            for item, endpoint in zip(response["endpoints"], expected, strict=True):
                for name in type(endpoint).__dataclass_fields__:
                    value = getattr(endpoint, name)
                    same = bytes(item[name]) if isinstance(value, bytes) else item[name]
                    assert same == value, name
        servers = lambda: querying.endpoints(answers.SERVERS, "/enable")["total"]  # noqa: E731
        assert agree(peer, lambda: graph.count_servers("/enable"), servers) == 1
        assert querying.endpoints(answers.CLIENTS, "/enable")["total"] == 0
    assert querying.endpoints(answers.PUBLISHERS, "no name")["status"] == answers.INVALID


KINDS = [
    Qos(),
    Qos(reliable=False),
    Qos(transient_local=True),
    Qos(deadline_ms=50),
    Qos(deadline_ms=100),
    Qos(reliable=False, transient_local=True, deadline_ms=50),
]


def connects(offered: Qos, requested: Qos) -> bool:
    """Return what rclpy says: whether DDS connects them."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    return bool(
        qos_check_compatible(rclpy_profile(offered), rclpy_profile(requested))[0] == QoSCompatibility.OK
    )


def rclpy_profile(qos: Qos) -> Any:
    from rclpy.duration import Duration, Infinite
    from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

    profile = QoSProfile(depth=qos.depth, liveliness=LivelinessPolicy.AUTOMATIC)
    if not qos.reliable:
        profile.reliability = ReliabilityPolicy.BEST_EFFORT
    if qos.transient_local:
        profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
    profile.deadline = Duration(nanoseconds=qos.deadline_ms * 1_000_000) if qos.deadline_ms else Infinite
    return profile


def test_matched_counts_are_those_of_dds(peer: Peer) -> None:
    """Every pair of QoS: what publishers and subscriptions say themselves, and what rclpy expects of them.

    Each number is waited for by itself: a slow machine has time for every one of them.
    """
    querying = Asked(peer)
    with Peer("writing") as writing, Peer("reading") as reading:
        pairs = list(product(KINDS, KINDS))
        topics = [f"/matched_{i}" for i in range(len(pairs))]
        writers = [
            writing.publisher(topic, INT32, pair[0]) for topic, pair in zip(topics, pairs, strict=True)
        ]
        readers = [
            reading.subscribe(topic, INT32, print, pair[1]) for topic, pair in zip(topics, pairs, strict=True)
        ]
        both = [(answers.PUBLISHERS, "/writing", "/reading"), (answers.SUBSCRIPTIONS, "/reading", "/writing")]
        for pair, writer, reader, topic in zip(pairs, writers, readers, topics, strict=True):
            expected = int(connects(*pair))
            for what, own, _ in both:
                agree(peer, lambda: [own], partial(querying.nodes, what, topic))  # noqa: B023
            found = lambda: (writer.subscriptions(), reader.publishers())  # noqa: B023, E731
            agree(peer, lambda: (expected, expected), found)  # noqa: B023
            for what, _, other in both:
                assert querying.endpoints(what, topic, matched_by=other)["total"] == expected, (topic, what)
        nobody = querying.endpoints(answers.SUBSCRIPTIONS, "/matched_0", matched_by="/reading")
        assert nobody["status"] == answers.UNKNOWN_NODE, "it has no publisher there"
    assert 0 < sum(connects(offered, requested) for offered, requested in pairs) < len(pairs)


def test_matched_counts_of_one_endpoint_among_those_of_its_node(peer: Peer) -> None:
    """Publishers of one node with one topic: their QoS says which one is meant."""
    querying = Asked(peer)
    with Peer("several") as several, Peer("wanting") as wanting:
        writers = [(qos, several.publisher("/many", INT32, qos)) for qos in KINDS]
        for qos in KINDS:
            wanting.subscribe("/many", INT32, print, qos)
        agree(peer, lambda: ["/several"] * len(KINDS), partial(querying.nodes, answers.PUBLISHERS, "/many"))
        agree(
            peer, lambda: ["/wanting"] * len(KINDS), partial(querying.nodes, answers.SUBSCRIPTIONS, "/many")
        )
        totals = []
        for qos, writer in writers:
            expected = sum(connects(qos, requested) for requested in KINDS)
            agree(peer, lambda: expected, writer.subscriptions)  # noqa: B023
            own = {
                "matched_by": "/several",
                "reliability": 1 if qos.reliable else 2,
                "durability": 1 if qos.transient_local else 2,
                "deadline": qos.deadline_ms * 1_000_000 or 2**63 - 1,
            }
            totals.append((querying.endpoints(answers.SUBSCRIPTIONS, "/many", **own)["total"], expected))
        assert [found for found, _ in totals] == [expected for _, expected in totals]
        assert len(set(totals)) > 2
        node = querying.endpoints(answers.SUBSCRIPTIONS, "/many", matched_by="/several")["total"]
        assert node == len(KINDS), "each one matches some of them"


def test_a_change_is_announced_and_makes_another_version(peer: Peer) -> None:
    versions: list[int] = []
    querying = Asked(peer)
    peer.subscribe(
        CHANGE_TOPIC, "microros_graph_msgs/msg/Change", lambda m: versions.append(m["version"]), CHANGE_QOS
    )
    assert peer.spin(lambda: versions, seconds(IDLE_S)), "the last notice is kept for those that come later"
    settled = lambda: querying.names(answers.NODES, names_max=0)["version"] == versions[-1]  # noqa: E731
    assert peer.spin(settled, seconds(IDLE_S))
    with Peer("passing"):
        seen = lambda: ("/passing", ()) in querying.listed(answers.NODES)  # noqa: E731
        assert peer.spin(seen, seconds(IDLE_S))
        assert peer.spin(settled, seconds(IDLE_S))
        with_it = versions[-1]
    is_removed = lambda: ("/passing", ()) not in querying.listed(answers.NODES)  # noqa: E731
    assert peer.spin(is_removed, seconds(IDLE_S))
    assert peer.spin(settled, seconds(IDLE_S))
    assert versions[-1] > with_it
    assert versions == sorted(set(versions)), "each notice has a new version"


def test_of_two_servers_one_answers_those_that_know_it(peer: Peer) -> None:
    """A request that names another server has an answer when that one has left."""
    querying = Asked(peer)
    client = peer.client(STATUS_SERVICE, "microros_graph_msgs/srv/EndpointStatus")
    nobody = 1

    def instance(requested: int) -> int | None:
        response = client.call({"topic": "/x", "node": "/y", "instance": requested}, 0.5)
        return None if response is None else response["instance"]

    with graph_server(int(os.environ["ROS_DOMAIN_ID"])) as other:
        assert peer.spin(lambda: peer.graph().count_servers(STATUS_SERVICE) == 2, seconds(IDLE_S))
        assert peer.spin(lambda: instance(nobody) is None, seconds(IDLE_S)), "both know each other"
        assert peer.spin(lambda: instance(0) is not None, seconds(IDLE_S))
        first = instance(0)
        assert first is not None
        assert {instance(first) for _ in range(10)} <= {first, None}
        page = querying.names(answers.NODES, names_max=1)
        rest = querying.names(answers.NODES, first=1, version=page["version"])
        assert 0 <= rest["version"] - page["version"] < 100, "versions of one server"
        assert client.call(
            {"topic": "/x", "node": "/y", "instance": nobody, "any_server": True}, seconds(IDLE_S)
        )
        other.send_signal(signal.SIGTERM)
        other.wait(seconds(IDLE_S))
        assert peer.spin(lambda: instance(nobody) is not None, seconds(IDLE_S)), "one is left"


def test_pages_of_one_version_are_of_one_graph(peer: Peer) -> None:
    """The graph of the node changes before the node notices."""
    serving = GraphServer(peer, print)
    ask = {"what": answers.NODES, "node": "", "filter": "", "name_size": 0, "types_max": 0, "names_max": 1}
    graph: Any = MadeGraph(node_names=("/a", "/b"))
    pages = [answers.list_names(graph, {**ask, "first": first}, serving.version) for first in (0, 1)]
    assert [page["names"][0]["name"] for page in pages] == ["/a", "/b"]
    assert pages[0]["version"] == pages[1]["version"]
    graph.node_names = ("/a", "/c")
    third = answers.list_names(graph, {**ask, "first": 1}, serving.version)
    assert third["version"] != pages[0]["version"]
    assert answers.list_names(graph, {**ask, "first": 0}, serving.version)["version"] == third["version"]
    assert GraphServer(peer, print).version((), ()) != third["version"], "a server that starts again"


def test_many_changes_are_few_notices_and_the_last_is_announced(server: object) -> None:
    """With the test's clock: what happens until the pause is over is one notice more."""
    now, versions = [100.0], list[int]()
    domain = own_domain() + 100
    with Peer("storm", domain=domain) as peer, Peer("listening", domain=domain) as listening:
        serving = GraphServer(peer, print, clock=lambda: now[0])
        change = "microros_graph_msgs/msg/Change"
        listening.subscribe(CHANGE_TOPIC, change, lambda m: versions.append(m["version"]), CHANGE_QOS)

        def until(done: Callable[[], object]) -> None:
            """Let both sides work until it is so, and on until what they know by then has been served."""

            def turns() -> object:
                serving.turn(0.01)
                return done()

            assert listening.spin(turns, seconds(IDLE_S))
            for _ in range(5):
                serving.turn(0.01)
                listening.spin_once(0.01)

        until(lambda: versions)
        until(lambda: {"/storm", "/listening"} <= set(peer.graph().nodes()))
        before = len(versions)
        now[0] += 0.25
        listening.publisher("/burst_0", INT32)
        until(lambda: len(versions) > before)
        topics = [f"/burst_{index}" for index in range(10)]
        for topic in topics[1:]:
            listening.publisher(topic, INT32)

        def discovered() -> bool:
            """Return whether the server knows the topics and, which comes later, whose they are."""
            return all([p.node for p in peer.graph().publishers(topic)] == ["/listening"] for topic in topics)

        until(discovered)
        assert len(versions) == before + 1, "one at once, the others wait"
        now[0] += 0.25
        until(lambda: len(versions) > before + 1)
        assert len(versions) == before + 2
        now[0] += 0.25
        until(lambda: True)
        assert len(versions) == before + 2, "nothing has changed"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in environment(own_domain()).items():
        monkeypatch.setenv(name, value)
    process = subprocess.Popen(
        [sys.executable, "-m", "microros_gen", "graph-server", "--domain", str(own_domain())],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == READY
    process.send_signal(number)
    assert process.wait(seconds(IDLE_S)) == 0
    assert process.stdout.read() == ""
    process.stdout.close()


HIDDEN = """import sys
sys.modules["rclpy"] = None
from microros_gen.cli.main import main
main(["graph-server"])
"""


def test_without_ros_it_says_what_to_install() -> None:
    done = subprocess.run([sys.executable, "-c", HIDDEN], capture_output=True, text=True)
    assert done.returncode == 2
    assert "the graph server needs ROS 2: rclpy (ROS 2) is not installed" in done.stderr
    assert "[MG-9724]" in done.stderr
