# SPDX-License-Identifier: Apache-2.0
"""Nodes and publishers: names, pools, declarations, QoS, refusals; each error names what to do."""

from __future__ import annotations

import pytest

from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.plans import DECLARED, POOL, changed
from tests.support.runtime.bench import Bench

TOPIC_INVALID = 103
NODE_NAME_INVALID = 201
NAMESPACE_INVALID = 202
UNSUPPORTED = 3


@pytest.mark.parametrize(
    ("kind", "shown"),
    [
        ("participant", "node n"),
        ("topic", "topic /x"),
        ("publisher", "publisher /x"),
        ("datawriter", "datawriter /x"),
    ],
)
@pytest.mark.parametrize(("status", "name"), [(0x80, "DDS_ERROR"), (0x83, "DENIED"), (0x20, "32")])
def test_a_refusal_names_entity_and_status(
    bench: Bench, kind: str, shown: str, status: int, name: str
) -> None:
    client = bench.start()
    client.ok("init")
    client.agent.refuse = {kind: status}
    results = [client.call("node 0 n -"), client.call("publisher 0 0 Int32 x reliable")]
    failed = results[0 if kind == "participant" else 1]
    assert (failed.code, failed.error) == (
        1,
        f"{shown}: the agent refuses it: {name} (entities in microros.yaml)",
    )
    client.spin(20, 50)
    assert len(client.agent.objects) == (0 if kind == "participant" else 1), (
        "what was created before is deleted"
    )
    client.agent.refuse = {}
    if kind == "participant":
        client.ok("node 0 n -")
    client.ok("publisher 0 0 Int32 x reliable")


def test_an_agent_that_stops_half_way(bench: Bench) -> None:
    client = bench.start()
    client.ok("init")
    client.ok("node 0 n -")
    client.agent.drop = lambda datagram: datagram[12] == 3  # CREATE of the publisher
    result = client.call("publisher 0 0 Int32 x reliable")
    assert (result.code, result.error) == (2, "publisher /x: no answer of the agent within 400 ms")
    assert POOL.times.create_timeout_ms <= result.slept <= POOL.times.create_timeout_ms + 1
    client.agent.drop = lambda datagram: False
    client.ok("publisher 0 0 Int32 x reliable")
    client.ok("publish 0 1")
    assert client.agent.values() == [1]


@pytest.mark.parametrize(
    ("topic", "reason"),
    [
        ("a//b", "a part is empty"),
        ("a/", "a part is empty"),
        ("/", "a part is empty"),
        ("9a", "a part begins with a digit"),
        ("a/9", "a part begins with a digit"),
        ("a-b", "only letters, digits and _"),
        ("a/~", "only letters, digits and _"),
        ("{node}", "only letters, digits and _"),
        ("~a", "no / after ~"),
        ("~/", "a part is empty"),
        ("~//a", "a part is empty"),
    ],
)
def test_bad_topics(bench: Bench, topic: str, reason: str) -> None:
    client = bench.connected()
    result = client.call(f"publisher 1 0 Int32 {topic} reliable")
    assert (result.code, result.error) == (TOPIC_INVALID, f"name '{topic}': {reason}")


@pytest.mark.parametrize(
    ("topic", "expanded"),
    [("a", "/ns/a"), ("a/b_2", "/ns/a/b_2"), ("/a", "/a"), ("~", "/ns/n"), ("~/a", "/ns/n/a")],
)
def test_good_topics(bench: Bench, topic: str, expanded: str) -> None:
    client = bench.start()
    for call in ("init", "node 0 n ns", f"publisher 0 0 Int32 {topic} reliable"):
        client.ok(call)
    assert client.ok("names 0 0").lines == (f"names n /ns {expanded} 0",)


@pytest.mark.parametrize(
    ("name", "namespace", "code"),
    [
        ("a/b", "-", NODE_NAME_INVALID),
        ("1a", "-", NODE_NAME_INVALID),
        ("a.b", "-", NODE_NAME_INVALID),
        ("a", "/b/", NAMESPACE_INVALID),
        ("a", "b//c", NAMESPACE_INVALID),
        ("a", "/1", NAMESPACE_INVALID),
        ("a", "/", 0),
        ("a", "b", 0),
        ("a", "/b/c", 0),
    ],
)
def test_names_of_nodes(bench: Bench, name: str, namespace: str, code: int) -> None:
    client = bench.start()
    client.ok("init")
    assert client.call(f"node 0 {name} {namespace}").code == code


def test_full_pools_name_the_key(bench: Bench) -> None:
    client = bench.connected()
    client.ok("node 1 second -")
    assert (
        client.call("node 2 third -").error == "all 2 nodes are open: set pools: {nodes: 3} in microros.yaml"
    )
    for index in (1, 2):
        client.ok(f"publisher {index} 0 Int32 t{index} reliable")
    result = client.call("publisher 3 0 Int32 t3 reliable")
    assert (result.code, result.error) == (
        1,
        "all 3 publishers are open: set pools: {publishers: 4} in microros.yaml",
    )
    client.ok("publisher_fini 1 0")
    client.ok("publisher 3 0 Int32 t3 reliable")


def test_long_names_name_the_key(bench: Bench) -> None:
    client = bench.connected()
    name = "a" * (POOL.entities.name_size - 2)
    client.ok(f"publisher 1 0 Int32 {name} reliable")
    result = client.call(f"publisher 2 0 Int32 {name}b reliable")
    assert result.error == f"name '{name}b' takes 32 bytes: set pools: {{name_size: 33}} in microros.yaml"


def test_places_are_reused_with_other_topics(bench: Bench) -> None:
    client = bench.connected()
    for round_ in range(5):
        client.ok("publisher_fini 0 0")
        client.ok(f"publisher 0 0 Int32 topic{round_} best_effort")
    assert any(b"topic4" in body for body in client.agent.objects.values())
    assert len(client.agent.objects) == 4


def test_a_place_that_could_not_be_deleted_is_deleted_before_it_is_used_again(bench: Bench) -> None:
    client = bench.connected(changed(POOL, entities__publishers__max=1))
    client.agent.silent = True
    client.ok("publisher_fini 0 0")
    client.agent.silent = False
    client.ok("publisher 0 0 Int32 other reliable")
    client.ok("publish 0 4")
    assert client.agent.values() == [4]
    kinds = [(d[4], d[11]) for d in client.sent if d[4] in (1, 3)]
    assert kinds[-6:] == [(3, 5), (3, 3), (3, 2), (1, 2), (1, 3), (1, 5)]


def test_an_old_owner_that_cannot_be_deleted_is_said(bench: Bench) -> None:
    client = bench.connected(changed(POOL, entities__publishers__max=1))
    client.agent.silent = True
    client.ok("publisher_fini 0 0")
    result = client.call("publisher 0 0 Int32 other reliable")
    assert (result.code, result.error) == (2, "datawriter /other: no answer of the agent within 400 ms")


def test_what_was_closed_without_a_session_is_deleted_in_the_next(bench: Bench) -> None:
    client = bench.connected()
    client.ok("publisher 1 0 Int32 second reliable")
    client.agent.silent = True
    client.spin(POOL.times.liveliness_attempts + 3, POOL.times.liveliness_period_ms)
    client.ok("destroy_timeout 0")
    client.ok("publisher_fini 1 0")
    client.agent.silent = False
    client.spin(30, 50)
    assert len(client.agent.objects) == 4
    assert client.call("connected").code == 1


def test_a_node_takes_its_publishers_with_it(bench: Bench) -> None:
    client = bench.connected()
    client.ok("node_fini 0")
    assert not client.agent.objects
    assert client.call("publish 0 1").code == 300
    assert client.ok("node_fini 0")


@pytest.mark.parametrize(
    ("qos", "policy"),
    [
        ("deadline", "deadline"),
        ("lifespan", "lifespan"),
        ("liveliness", "liveliness"),
        ("best_available", "reliability"),
        ("depth", "depth"),
        ("bare_names", "avoid_ros_namespace_conventions"),
    ],
)
def test_qos_that_cannot_be_carried_is_refused(bench: Bench, qos: str, policy: str) -> None:
    client = bench.connected()
    result = client.call(f"publisher 1 0 Int32 x {qos}")
    assert (result.code, result.error) == (UNSUPPORTED, f"publisher x: XRCE carries no such QoS: {policy}")


def test_an_undeclared_publisher_gets_the_line_to_add(bench: Bench) -> None:
    client = bench.connected(DECLARED)
    expected = "publisher not declared: add to its node's publishers: in microros.yaml: {topic: %s, type: %s}"
    result = client.call("publisher 1 0 Int32 ~/other reliable")
    assert (result.code, result.error) == (1, expected % ("~/other", "std_msgs/msg/Int32"))
    assert client.call("publisher 1 0 String chatter reliable").error == expected % (
        "chatter",
        "std_msgs/msg/String",
    )
    assert (
        client.call("publisher 1 0 Int32 /arm/chatter reliable").error
        == "publisher /arm/chatter is open already"
    )
    client.ok("publisher_fini 0 0")
    client.ok("publisher 1 0 Int32 /arm/chatter reliable")


def test_an_undeclared_node_gets_the_line_to_add(bench: Bench) -> None:
    client = bench.start(DECLARED)
    client.ok("init")
    result = client.call("node 0 imu /leg")
    assert result.error == "node not declared: add to nodes: in microros.yaml: {name: imu, namespace: '/leg'}"
    line = result.error.split("microros.yaml: ")[1]
    for namespace, full in (("/leg", "/leg"), ("", "/")):  # rclc_node_init_default is often called with ""
        diagnostics = Diagnostics()
        text = f"nodes:\n  - {line.replace('/leg', namespace)}\n"
        application = parse_application(Source("f", text), diagnostics)
        assert application is not None
        assert list(diagnostics) == []
        assert application.nodes[0].namespace == full
    client.ok("node 0 imu arm")
    assert client.call("node 1 imu /arm").error == "node imu is open already"


def test_a_domain_of_the_application_wins(bench: Bench) -> None:
    client = bench.start(DECLARED)
    client.ok("init_options 12 h 1 1")
    client.ok("node 0 imu /arm")
    assert client.sent[-1][-2:] == b"\x0c\0"
    assert client.ok("names 0 0").lines[0].endswith(" 12")


def test_the_domain_of_the_agent_can_be_requested(bench: Bench) -> None:
    client = bench.start(DECLARED)
    client.ok("init_options 255 h 1 1")
    client.ok("node 0 imu /arm")
    assert client.sent[-1][-2:] == b"\xff\0"


@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("init_options 233 h 1 1", "domain 233 is above 232"),
        ("init_options 254 h 1 1", "domain 254 is above 232"),
        ("init_options 0 h 0 1", "address h or port 0 is not valid (host: up to 31 bytes)"),
        ("init_options 0 h 65536 1", "address h or port 65536 is not valid (host: up to 31 bytes)"),
        ("init_options 0 h 8x 1", "address h or port 8x is not valid (host: up to 31 bytes)"),
        (
            "init_options 0 " + "h" * 32 + " 1 1",
            "address " + "h" * 32 + " or port 1 is not valid (host: up to 31 bytes)",
        ),
        ("init_options 0 h 1 0", "client_key or rmw_options: NULL or not initialized"),
    ],
)
def test_bad_options(bench: Bench, call: str, error: str) -> None:
    result = bench.start().call(call)
    assert (result.code, result.error) == (11, error)


def test_a_field_above_its_limit_names_field_and_limit(bench: Bench) -> None:
    client = bench.connected()
    client.ok("publisher 1 0 String words reliable")
    client.ok("say 1 12345678")
    result = client.call("say 1 123456789")
    assert (result.code, result.error) == (
        1,
        "limit 8: set limits: {std_msgs/msg/String: {data: 9}} in microros.yaml",
    )
    client.ok("say 1 x")
    client.ok("flush 100")
    assert [body for target, body in client.agent.written] == [b"\x09\0\0\x0012345678\0", b"\x02\0\0\0x\0"]


def test_a_type_whose_name_does_not_fit_a_create(bench: Bench) -> None:
    """A type that the plan does not know; the longest CREATE that it knows fills the stream to the last byte."""
    size = len("std_msgs::msg::dds_::Int32_") + 1
    fits = 4 + 16 + 24 + 4 + size + 2
    bench.connected(
        changed(POOL, streams__best_effort_size=fits, entities__type_name_size=size), topic="twelve_bytes"
    )
    client = bench.start(changed(POOL, entities__type_name_size=size - 1))
    for call in ("init", "node 0 n -"):
        client.ok(call)
    result = client.call("publisher 0 0 Int32 twelve_bytes reliable")
    assert (result.code, result.error) == (
        1,
        "name 'std_msgs::msg::dds_::Int32_': too long for the stream of this plan",
    )


def test_a_type_that_does_not_fit_its_stream(bench: Bench) -> None:
    client = bench.connected(changed(POOL, streams__reliable_slot_size=24))
    result = client.call("publisher 1 0 String words reliable")
    assert result.error.startswith("std_msgs/msg/String takes 13 bytes and its stream holds 12: ")
    client.ok("publisher 1 0 String words best_effort")


def test_a_stream_that_the_plan_does_not_have(bench: Bench) -> None:
    plan = changed(POOL, streams__reliable_slots=0, streams__reliable_slot_size=0)
    client = bench.connected(plan, qos="best_effort")
    assert client.call("publisher 1 0 Int32 x reliable").error.startswith(
        "std_msgs/msg/Int32 takes 4 bytes and its "
    )
    client.ok("publish 0 3")
    assert client.agent.values() == [3]


def test_codes_instead_of_text(bench: Bench) -> None:
    client = bench.connected(changed(POOL, errors__text_size=0))
    assert client.call("publisher 1 0 Int32 9 reliable").error == "E08"
    assert client.call("node 0 a/b -").error == "E08"
    assert client.call("init").error == "E03"


def test_a_publisher_of_an_ended_context(bench: Bench) -> None:
    """Its handle is none in the next context, and can be finalized there."""
    client = bench.connected()
    client.ok("fini")
    client.ok("init")
    assert client.call("publish 0 1").code == 300
    client.ok("node 0 talker -")
    client.ok("publisher_fini 0 0")
    client.ok("publisher 0 0 Int32 chatter reliable")
    client.ok("publish 0 2")
    assert client.agent.values() == [2]


def test_a_status_of_another_object_is_no_answer(bench: Bench) -> None:
    """The ids of requests come again; the first one is not that of a ping."""
    client = bench.start()
    client.ok("init")
    client.agent.silent = True
    client.sent.clear()
    client.on_sleep = lambda: client.queued.append(
        bytes.fromhex("81010000 05010600") + client.sent[0][8:10] + bytes.fromhex("fffd 00 00")
    )
    assert client.call("node 0 n -").code != 0, "nobody has said anything of the node"
    assert client.sent[0][8:12] == bytes.fromhex("000b 0001")
