# SPDX-License-Identifier: Apache-2.0
"""The ways to create entities, on both streams: bytes, refusals, repetitions, reconnections, losses, deletions."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from microros_gen.client.plan.creation import CreateNames, create_size, participant_reference
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan
from tests.support.plans import DECLARED, INT32, POOL, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.creating_agent import CREATE, DELETE, CreatingAgent
from tests.support.runtime.driver import Client

WAYS = ("binary", "xml", "reference")
STREAMS = ("best_effort", "reliable")
OBJECTS = [b"\0\1", b"\0\2", b"\0\3", b"\0\5"]
CALLS = ("init", "node 0 my_node -", "publisher 0 0 String chatter reliable")

# xrce-facts: captured from the reference client; its object ids begin at 1, here at 0.
XML_PARTICIPANT = b"<dds><participant><rtps><name>my_node</name></rtps></participant></dds>\0"
XML_TOPIC = (
    b"<dds><topic><name>rt/chatter</name><dataType>std_msgs::msg::dds_::String_</dataType></topic></dds>\0"
)
XML_WRITER = (
    b"<dds><data_writer><topic><kind>NO_KEY</kind><name>rt/chatter</name>"
    b"<dataType>std_msgs::msg::dds_::String_</dataType><historyQos><kind>KEEP_LAST</kind><depth>10</depth>"
    b"</historyQos></topic><qos><durability><kind>VOLATILE</kind></durability><reliability><kind>RELIABLE</kind>"
    b"</reliability></qos></data_writer></dds>\0"
)


def plan_of(entities: str, creation: str) -> RuntimePlan:
    """Return a plan with the storage that its largest CREATE takes; one with references has one node."""
    base = (
        changed(POOL, entities__nodes__max=1)
        if (entities, creation) == ("reference", "best_effort")
        else POOL
    )
    name = base.entities.name_size - 1
    names = CreateNames(
        2 * name + 1, name + 2, 28, len(participant_reference("x" * 2 * name, base.entities.nodes.max))
    )
    size = create_size(names, entities)
    if creation == "best_effort":
        return changed(base, creation__entities=entities, streams__best_effort_size=size)
    return changed(
        base,
        creation__entities=entities,
        creation__stream=creation,
        creation__size=size,
        input__reliable_slots=1,
        input__reliable_slot_size=base.input.size,
    )


@pytest.fixture(params=[(e, c) for e in WAYS for c in STREAMS], ids="-".join)
def plan(request: pytest.FixtureRequest) -> RuntimePlan:
    return plan_of(*request.param)


def started(bench: Bench, plan: RuntimePlan, liveliness: str = "ping") -> tuple[Client, CreatingAgent]:
    agent = CreatingAgent()
    client = bench.start(plan, liveliness, agent)
    for call in CALLS:
        client.ok(call)
    return client, agent


def requests_of(datagrams: list[bytes]) -> list[bytes]:
    return [d for d in datagrams if d[4] in (CREATE, DELETE) and d[10:12] != b"\xff\xfe"]


def stream_of(plan: RuntimePlan) -> int:
    return 0x80 if plan.creation.stream == "reliable" else 0x01


def test_entities_are_created_once_each(bench: Bench, plan: RuntimePlan) -> None:
    client, agent = started(bench, plan)
    assert agent.created() == OBJECTS
    sent = requests_of(client.sent)
    assert [d[1] for d in sent] == [stream_of(plan)] * 4
    assert [d[2:4] for d in sent] == [bytes([i, 0]) for i in range(4)]
    client.ok("say 0 hello")
    client.ok("flush 100")
    assert agent.written == [(b"\0\5", b"\6\0\0\0hello\0")]
    assert client.call("connected").code == 1
    assert not agent.unacknowledged, "what the agent sends reliably is acknowledged"


def test_deletion_goes_on_the_stream_of_creation(bench: Bench, plan: RuntimePlan) -> None:
    client, agent = started(bench, plan)
    client.sent.clear()
    for call in ("publisher_fini 0 0", "node_fini 0", "fini"):
        client.ok(call)
    assert [(d[1], d[10:12]) for d in requests_of(client.sent)] == [
        (stream_of(plan), identity) for identity in reversed(OBJECTS)
    ]
    assert not agent.objects
    assert client.sent[-1] == bytes.fromhex("81000000 03010400 0002fffe")


@pytest.mark.parametrize(
    ("kind", "shown"), [("participant", "node my_node"), ("datawriter", "datawriter /chatter")]
)
def test_a_refusal_is_reported_and_others_continue(
    bench: Bench, plan: RuntimePlan, kind: str, shown: str
) -> None:
    agent = CreatingAgent(refuse={kind: 0x84})
    client = bench.start(plan, "ping", agent)
    results = [client.call(call) for call in CALLS]
    failed = results[1 if kind == "participant" else 2]
    words = "the agent refuses it: UNKNOWN_REFERENCE (entities in microros.yaml)"
    assert (failed.code, failed.error) == (1, f"{shown}: {words}")
    agent.refuse.clear()
    if kind == "participant":
        client.ok(CALLS[1])
    client.ok(CALLS[2])
    client.ok("say 0 x")
    client.ok("flush 100")
    assert agent.written


def test_a_request_is_repeated_until_its_status_arrives(bench: Bench, plan: RuntimePlan) -> None:
    agent = CreatingAgent()
    client = bench.start(plan, "ping", agent)
    client.ok("init")
    lost = 3
    agent.drop = lambda datagram: len(requests_of(client.sent)) <= lost and datagram[4] == CREATE
    client.ok("node 0 my_node -")
    sent = requests_of(client.sent)
    assert len(sent) == lost + 1
    assert len({d[4:] for d in sent}) == 1, "under one request id"
    if plan.creation.stream == "reliable":
        assert len(set(sent)) == 1, "the same message again"
    assert agent.created() == OBJECTS[:1]


def test_a_lost_status_does_not_create_twice(bench: Bench) -> None:
    plan = plan_of("binary", "reliable")
    agent = CreatingAgent()
    client = bench.start(plan, "ping", agent)
    client.ok("init")
    answers: list[bytes] = []

    def lose(answer: bytes) -> bool:
        answers.append(answer)
        return len(answers) <= 4

    agent.drop_answer = lose
    client.ok("node 0 my_node -")
    client.ok("publisher 0 0 String chatter reliable")
    assert agent.created() == OBJECTS


def test_a_restarted_agent_gets_entities_before_what_was_kept(bench: Bench, plan: RuntimePlan) -> None:
    client, agent = started(bench, plan)
    agent.silent = True
    for word in "ab":
        client.ok(f"say 0 {word}")
    client.spin(plan.times.liveliness_attempts + 3, plan.times.liveliness_period_ms)
    agent.restart()
    agent.requests.clear()
    agent.silent = False
    client.sent.clear()
    client.spin(40, 20)
    assert agent.created() == OBJECTS
    assert [body for _, body in agent.written] == [b"\2\0\0\0a\0\0\0"[:6], b"\2\0\0\0b\0"]
    client.ok("say 0 c")
    client.ok("flush 200")
    assert [body[4:5] for _, body in agent.written] == [b"a", b"b", b"c"]
    data = [d for d in client.sent if d[4] == 0x07]
    first = 4 if plan.creation.stream == "reliable" else 0
    assert data[0][2:4] == bytes([first, 0]), "numbers go on behind the requests"


def test_what_is_dropped_while_entities_are_created_leaves_no_gap(bench: Bench) -> None:
    plan = changed(plan_of("binary", "reliable"), streams__on_full="drop_oldest")
    client, agent = started(bench, plan)
    agent.silent = True
    client.spin(plan.times.liveliness_attempts + 3, plan.times.liveliness_period_ms)
    for i in range(plan.streams.reliable_slots + 2):
        client.ok(f"say 0 {i}")
    agent.restart()
    agent.silent = False
    agent.refuse = {"datawriter": 0x80}
    client.spin(8, 20)
    client.ok("say 0 last")
    agent.refuse = {}
    client.spin(60, 20)
    assert [body[4:-1] for _, body in agent.written] == [b"3", b"4", b"5", b"last"]


def test_a_request_between_data_takes_the_next_number(bench: Bench) -> None:
    plan = plan_of("reference", "reliable")
    client, agent = started(bench, plan)
    agent.drop = lambda datagram: datagram[4] == 0x07
    client.ok("say 0 a")
    client.ok("say 0 b")
    assert client.call("publisher 1 0 Int32 other reliable").code == 2, "data is unacknowledged"
    agent.drop = lambda datagram: False
    client.sent.clear()
    client.ok("publisher 1 0 Int32 other reliable")
    client.ok("publish 1 5")
    client.ok("flush 200")
    assert [body[4:5] for target, body in agent.written if target == b"\0\5"] == [b"a", b"b"]
    assert agent.values(1) == [5]
    numbers = [d[2] for d in client.sent if d[1] == 0x80 and d[4] in (CREATE, 0x07)]
    assert sorted(set(numbers)) == list(range(4, 4 + 2 + 3 + 1))


def lossy(seed: int) -> Iterator[bool]:
    source = random.Random(seed)
    while True:
        yield source.random() < 0.3


@pytest.mark.parametrize("seed", range(6))
def test_reliable_creation_with_losses_acts_once(bench: Bench, seed: int) -> None:
    plan = changed(
        plan_of("binary", "reliable"), times__create_timeout_ms=4000, times__connect_timeout_ms=4000
    )
    losses = lossy(seed)
    agent = CreatingAgent(drop=lambda datagram: next(losses), drop_answer=lambda answer: next(losses))
    client = bench.start(plan, "none", agent)
    for call in CALLS:
        client.ok(call)
    sent = 0
    for _ in range(60):
        if client.call(f"say 0 {sent}").code == 0:
            sent += 1
        client.spin(2, 30)
    client.ok("publisher 1 0 Int32 other reliable")
    client.spin(60, 50)
    assert agent.created() == [*OBJECTS, b"\0\x12", b"\0\x13", b"\0\x15"]
    assert [body[4:-1] for target, body in agent.written if target == b"\0\5"] == [
        str(i).encode() for i in range(sent)
    ]
    assert sent > 20


@pytest.mark.parametrize("creation", STREAMS)
def test_the_request_of_a_former_owner_does_not_count_for_the_next(bench: Bench, creation: str) -> None:
    client, agent = started(bench, plan_of("binary", creation))
    client.ok("publisher_fini 0 0")
    # The agent acts on the topic, but its answer does not come while the caller waits.
    agent.drop_answer = lambda answer: answer[4] in (0x05, 0x0B)
    assert client.call("publisher 0 0 Int32 wrong reliable").code == 2
    agent.drop_answer = lambda answer: False
    client.ok("publisher 0 0 Int32 right reliable")
    assert b"rt/right\0" in agent.objects[b"\0\2"]
    client.ok("publish 0 3")
    client.ok("flush 200")
    assert agent.values() == [3]


def test_acknack_notices_an_agent_that_is_lost_while_it_creates(bench: Bench) -> None:
    client, agent = started(bench, plan_of("binary", "reliable"), "acknack")
    agent.restart()
    client.call("publisher 1 0 Int32 other reliable")
    client.call("say 0 a")
    client.spin(60, 50)
    assert client.statistics()["reconnects"] == 1
    assert set(OBJECTS) <= set(agent.objects)


def _string_body(kind: int, way: int, text: bytes, tail: bytes) -> bytes:
    return bytes([kind, way, 0, 0]) + len(text).to_bytes(4, "little") + text + tail


def test_xml_as_captured(bench: Bench) -> None:
    client, _ = started(bench, plan_of("xml", "best_effort"))
    bodies = [
        _string_body(1, 2, XML_PARTICIPANT, b"\0\0" if len(XML_PARTICIPANT) % 2 == 0 else b"\0\0\0"),
        _string_body(2, 2, XML_TOPIC, b"\0\1"),
        bytes.fromhex("03020000 01000000 00 0001"),
        _string_body(5, 2, XML_WRITER, b"\0\3"),
    ]
    assert [d[12:] for d in requests_of(client.sent)] == bodies
    assert requests_of(client.sent)[2][:12] == bytes.fromhex("81010200 01070f00 000d0003")


def test_references_as_the_rmw_of_micro_ros_names_them(bench: Bench) -> None:
    client, _ = started(bench, plan_of("reference", "best_effort"))
    assert [d[12:] for d in requests_of(client.sent)] == [
        _string_body(1, 1, b"participant_profile\0", b"\0\0"),
        _string_body(2, 1, b"chatter__t\0", b"\0\1"),
        bytes.fromhex("03020000 01000000 00 0001"),
        _string_body(5, 1, b"chatter__dw\0", b"\0\3"),
    ]


def test_nodes_among_several_have_references_of_their_own(bench: Bench) -> None:
    client = bench.start(plan_of("reference", "reliable"), "ping", CreatingAgent())
    for call in ("init", "node 0 my_node -", "node 1 imu /arm/left"):
        client.ok(call)
    assert [d[20:] for d in requests_of(client.sent)] == [
        b"my_node__p\0" + b"\0" * 3,
        b"arm/left/imu__p\0\0\0",
    ]


@pytest.mark.parametrize(
    ("qos", "words"),
    [
        ("best_effort", (b"KEEP_LAST</kind><depth>5</depth>", b"VOLATILE", b"BEST_EFFORT")),
        ("system_default", (b"KEEP_LAST</kind></historyQos>", b"VOLATILE", b"RELIABLE")),
        ("transient_local", (b"KEEP_LAST</kind><depth>10</depth>", b"TRANSIENT_LOCAL", b"RELIABLE")),
        ("keep_all", (b"KEEP_ALL</kind><depth>10</depth>", b"VOLATILE", b"RELIABLE")),
        ("longest", (b"KEEP_LAST</kind><depth>65535</depth>", b"TRANSIENT_LOCAL", b"BEST_EFFORT")),
    ],
)
def test_qos_in_xml(bench: Bench, qos: str, words: tuple[bytes, ...]) -> None:
    client, _ = started(bench, plan_of("xml", "best_effort"))
    client.ok(f"publisher 1 0 Int32 x {qos}")
    last_message = client.sent[-1]
    assert [last_message.find(word) >= 0 for word in words] == [True] * len(words)
    assert last_message.find(b"<durability><kind>" + words[1]) < last_message.find(
        b"<reliability><kind>" + words[2]
    )


def test_the_largest_create_fits_to_the_byte(bench: Bench, plan: RuntimePlan) -> None:
    name = "n" * (plan.entities.name_size - 1)
    client = bench.start(plan, "ping", CreatingAgent())
    for call in (
        "init",
        f"node 0 {name} /{name[1:]}",
        f"publisher 0 0 String /{name[1:]} longest",
    ):
        client.ok(call)
    largest = max(len(d) for d in requests_of(client.sent))
    room = plan.creation.size if plan.creation.stream == "reliable" else plan.streams.best_effort_size
    assert largest == room


PRECONFIGURED = changed(
    DECLARED,
    creation__entities="preconfigured",
    entities__nodes__max=2,
    entities__publishers__max=3,
    entities__nodes__declared=(*DECLARED.entities.nodes.declared, NodePlan(1, "leg", "/", "leg", 0)),
    entities__publishers__declared=(
        *DECLARED.entities.publishers.declared,
        PublisherPlan(2, 1, "/walk", "rt/walk", INT32, False),
    ),
)


def preconfigured(bench: Bench) -> tuple[Client, CreatingAgent]:
    """Return a client and an agent that has its writers."""
    agent = CreatingAgent(objects={b"\0\5": b"", b"\0\x15": b"", b"\0\x25": b""})
    client = bench.start(PRECONFIGURED, "ping", agent)
    client.ok("init")
    return client, agent


def test_a_preconfigured_client_only_connects_and_writes(bench: Bench) -> None:
    client, agent = preconfigured(bench)
    for call in (
        "node 0 imu arm",
        "publisher 0 0 Int32 chatter reliable",
        "publisher 1 0 Int32 ~/fast best_effort",
    ):
        client.ok(call)
    client.ok("publish 0 7")
    client.ok("publish 1 8")
    client.ok("flush 100")
    assert agent.values(0) == [7]
    assert agent.values(1) == [8]
    assert client.call("connected").code == 1
    for call in ("publisher_fini 0 0", "node_fini 0", "fini"):
        client.ok(call)
    assert {d[4] for d in client.sent} == {0x00, 0x07}


def test_a_preconfigured_client_finds_its_way_back(bench: Bench) -> None:
    client, agent = preconfigured(bench)
    for call in ("node 0 imu arm", "publisher 0 0 Int32 chatter reliable"):
        client.ok(call)
    agent.silent = True
    client.ok("publish 0 1")
    client.spin(PRECONFIGURED.times.liveliness_attempts + 3, PRECONFIGURED.times.liveliness_period_ms)
    result = client.call("publish 0 2")
    assert result.error == "publisher /arm/chatter: no session with the agent"
    opened = client.call("publisher 1 0 Int32 ~/fast best_effort")
    assert (opened.code, opened.error) == (
        2,
        "datawriter /arm/imu/fast: no answer of the agent within 400 ms",
    )
    agent.silent = False
    client.spin(20, 50)
    client.ok("publisher 1 0 Int32 ~/fast best_effort")
    client.ok("publish 0 3")
    client.ok("flush 100")
    assert agent.values(0) == [1, 3]


def test_a_preconfigured_node_takes_its_publishers_with_it(bench: Bench) -> None:
    client, agent = preconfigured(bench)
    for call in (
        "node 0 imu arm",
        "node 1 leg -",
        "publisher 0 0 Int32 chatter reliable",
        "publisher 1 1 Int32 walk best_effort",
        "node_fini 0",
    ):
        client.ok(call)
    assert client.call("publish 0 1").code == 300
    client.ok("publish 1 2")
    assert agent.values(2) == [2]
    client.ok("node 0 imu arm")
    client.ok("publisher 0 0 Int32 chatter reliable")
