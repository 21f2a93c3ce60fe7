# SPDX-License-Identifier: Apache-2.0
"""What a policy lets clients do, also those that try to get around it."""

from __future__ import annotations

import json
from typing import Any

import pytest

from microros_gen.agent.configuration.entities_file import parse_preconfigured
from microros_gen.agent.history import UNREAD_BYTES
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import BURST, SUSTAINED
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.agent.states import Presence
from microros_gen.agent.wire.cdr import Writer
from microros_gen.agent.wire.constants import OBJECT_CLIENT, Format, Status
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Delete
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.agent.client import int32_body, participant_blob
from tests.support.agent.entities_file import content
from tests.support.agent.fakes import Bench
from tests.support.agent.newcomers import hello
from tests.support.agent.policies import DENIED, INT32, MATCHED, OK, Guest, policy_of
from tests.support.agent.references import PROFILES

LABEL = f"/ok [{INT32}]"
OF_ONE = "name: one, keys: [0x1], publish: [/ok], subscribe: [/ok]"
REQUESTER, REPLIER = 7, 8


def guarded(*rules: str, **more: Any) -> Bench:
    return Bench(policy=policy_of(*rules), watched=True, **more)


def admitted(bench: Bench, key: int = 1, address: str = "10.0.0.1", session: int = 0x81) -> Guest:
    """Return a client in session that has a node."""
    guest = Guest(bench, key, address, session)
    assert (guest.connect(), guest.node()) == (OK, OK)
    return guest


def sample(value: int = 5, writer: int = 0x15) -> bytes:
    return encode(WriteData(1, writer, int32_body(value)))


# Who may connect


@pytest.mark.parametrize(
    ("rule", "key", "address", "status"),
    [
        ("keys: [0x1]", 1, "10.0.0.1", OK),
        ("keys: [0x1]", 2, "10.0.0.1", DENIED),
        ("keys: [0x1, 0x10-0x1F]", 0x1F, "10.0.0.1", OK),
        ("keys: [0x1, 0x10-0x1F]", 0x20, "10.0.0.1", DENIED),
        ("addresses: [10.0.0.0/30]", 1, "10.0.0.3", OK),
        ("addresses: [10.0.0.0/30]", 1, "10.0.0.4", DENIED),
        ("addresses: [10.0.0.0/30]", 1, "fd00::1", DENIED),
        ("addresses: ['fd00::/64']", 1, "fd00::1%eth0", OK),
        ("addresses: ['fd00::/64']", 1, "fd00:1::1", DENIED),
        ("addresses: ['::/0']", 1, "10.0.0.1", DENIED),
        ("addresses: [0.0.0.0/0]", 1, "/dev/ttyS0", DENIED),
        ("devices: ['/dev/ttyS*']", 1, "/dev/ttyS0", OK),
        ("devices: ['/dev/ttyS*']", 1, "/dev/ttyUSB0", DENIED),
        ("devices: ['/dev/*']", 1, "10.0.0.1", DENIED),
        ("devices: [can0], addresses: [10.0.0.1]", 1, "can0", OK),
        ("devices: [can0], addresses: [10.0.0.1]", 1, "10.0.0.1", OK),
        ("keys: [0x1], addresses: [10.0.0.1]", 1, "10.0.0.2", DENIED),
    ],
)
@pytest.mark.parametrize("forgeable", [False, True])
def test_keys_and_places(rule: str, key: int, address: str, status: Status, forgeable: bool) -> None:
    bench = guarded(f"name: a, publish: [/ok], {rule}")
    bench.transport.forgeable = forgeable
    guest = Guest(bench, key, address)
    assert guest.connect() == status
    guest.say(encode(Delete(1, 0x11)))
    assert len(bench.agent.clients) == (status is OK)
    if status is DENIED:
        assert f"at {address} was refused: no rule of the policy is for it" in bench.text.getvalue()


def test_without_a_policy_all_clients_may_do_everything() -> None:
    bench = Bench()
    guest = admitted(bench, 77)
    assert (guest.writer("/any"), guest.reader("/any")) == (OK, OK)
    assert guest.service("/any", REQUESTER) == OK


def test_an_empty_policy_refuses_all_clients() -> None:
    assert Guest(guarded()).connect() == DENIED


def test_the_first_rule_that_fits_decides() -> None:
    bench = guarded("name: bad, refuse: true, keys: [0x2]", "name: all, publish: [/ok]")
    assert [Guest(bench, key, f"10.0.0.{key}").connect() for key in (1, 2, 3)] == [OK, DENIED, OK]
    assert "the rule 'bad' (policy.yaml:3) refuses it" in bench.text.getvalue()


def test_a_device_is_found_by_a_link_that_leads_to_it(tmp_path: Any) -> None:
    """As /dev/serial/by-id does; a link that leads elsewhere is none of it."""
    (tmp_path / "usb-board").symlink_to("/dev/null")
    (tmp_path / "usb-other").symlink_to("/dev/zero")
    bench = guarded(f"name: a, publish: [/ok], devices: ['{tmp_path}/usb-b*']")
    assert Guest(bench, 1, "/dev/null").connect() == OK
    assert Guest(bench, 2, "/dev/zero").connect() == DENIED


# What each may use


def test_topics() -> None:
    bench = guarded("name: a, publish: [/ok, /arm/**], subscribe: [/in]")
    guest = admitted(bench)
    assert guest.writer("/secret") == DENIED
    assert guest.writer("/ok") == OK
    assert guest.writer("/arm/a/b", number=4) == OK
    assert guest.writer("/in", number=5) == DENIED
    assert guest.reader("/in") == OK
    assert guest.reader("/ok", number=6) == DENIED
    assert bench.bridge.graph == ["0:/node", LABEL, f"/arm/a/b [{INT32}]", f"/in [{INT32}]"]
    assert "the rule 'a' (policy.yaml:3) does not let it publish on /secret" in bench.text.getvalue()
    guest.say(sample(1))
    assert [label for label, _ in bench.bridge.published] == [LABEL]


@pytest.mark.parametrize(
    ("qos", "flags", "depth", "status"),
    [
        ("reliability: reliable", 3, 10, OK),
        ("reliability: reliable", 2, 10, DENIED),
        ("reliability: best_effort", 3, 10, DENIED),
        ("durability: volatile", 3, 10, OK),
        ("durability: volatile", 11, 10, DENIED),
        ("durability: [volatile, transient_local]", 11, 10, OK),
        ("durability: [volatile, transient_local]", 0x13, 10, DENIED),
        ("depth: 10", 3, 10, OK),
        ("depth: 10", 3, 11, DENIED),
        ("depth: 10", 3, 0, OK),
        ("depth: 10", 1, 10, DENIED),
        ("history: keep_last", 1, 10, DENIED),
        ("history: [keep_last, keep_all]", 1, 10, OK),
    ],
)
def test_qos_of_writers_and_readers(qos: str, flags: int, depth: int, status: Status) -> None:
    bench = guarded(f"name: a, publish: [/ok], subscribe: [{{name: /ok, {qos}}}], qos: {{{qos}}}")
    guest = admitted(bench)
    assert (guest.writer("/ok", flags, depth), guest.reader("/ok", flags, depth)) == (status, status)
    assert bench.bridge.graph == ["0:/node", *[LABEL] * (2 if status is OK else 0)]


def test_an_entry_has_its_own_qos_and_the_first_one_decides() -> None:
    rule = "name: a, qos: {durability: volatile}, publish: [{name: /no, refuse: true},"
    bench = guarded(rule + " {name: /map, durability: transient_local}, /**]")
    guest = admitted(bench)
    assert (guest.writer("/no"), guest.writer("/map", 11), guest.writer("/map", 3, number=4)) == (
        DENIED,
        OK,
        DENIED,
    )
    assert (guest.writer("/x", 11, number=5), guest.writer("/x", 3, number=5)) == (DENIED, OK)


def test_services() -> None:
    guest = admitted(guarded("name: a, call: [/lift/*], serve: [/reset]"))
    assert guest.service("/lift/up", REQUESTER) == OK
    assert guest.service("/lift/up", REPLIER, 4) == DENIED
    assert guest.service("/reset", REPLIER, 5) == OK
    assert guest.service("/reset", REQUESTER, 6) == DENIED


def test_a_service_is_known_by_its_topics() -> None:
    """They decide in ROS 2, whatever the name says."""
    guest = admitted(guarded("name: a, call: [/lift]"))
    blob = Writer().string("/lift")
    for half in ("Request", "Response"):
        blob.string(f"std_srvs::srv::dds_::SetBool_{half}_")
    blob.flag(True).string("rq/armRequest").flag(True).string("rr/armReply")
    assert guest.create(0x37, blob.content(), 0x01) == DENIED


@pytest.mark.parametrize(
    ("rule", "serves", "calls"),
    [
        ("serve_actions: [/move]", OK, DENIED),
        ("call_actions: [/move]", DENIED, OK),
        ("publish: [/**], subscribe: [/**], call: [/**], serve: [/**]", DENIED, DENIED),
    ],
)
def test_actions_are_permitted_as_such(rule: str, serves: Status, calls: Status) -> None:
    guest = admitted(guarded(f"name: a, {rule}, qos: {{durability: volatile}}"))
    names = ("send_goal", "cancel_goal", "get_result")
    for number, name in enumerate(names, 4):
        assert guest.service(f"/move/_action/{name}", REPLIER, number) == serves
        assert guest.service(f"/move/_action/{name}", REQUESTER, number + 4) == calls
    for number, (name, flags) in enumerate((("feedback", 3), ("status", 11)), 12):
        assert guest.writer(f"/move/_action/{name}", flags, number=number) == serves
        assert guest.reader(f"/move/_action/{name}", flags, number=number + 2) == calls
    assert guest.service("/turn/_action/send_goal", REPLIER, 3) == DENIED


def test_the_domain_of_a_rule_and_those_to_choose_from() -> None:
    bench = guarded("name: a, keys: [0x1], domain: 7, graph: true", "name: b, domains: [0, 3], graph: true")
    first, second = Guest(bench, 1, "10.0.0.1"), Guest(bench, 2, "10.0.0.2")
    assert (first.connect(), second.connect()) == (OK, OK)
    assert first.node("a", domain=5) == OK
    assert first.node("a", domain=5) == MATCHED
    assert [second.node("b", domain=domain) for domain in (5, 3)] == [DENIED, OK]
    assert bench.bridge.graph == ["7:/a", "3:/b"]
    assert "does not let it use domain 5" in bench.text.getvalue()


@pytest.mark.parametrize(("own", "status"), [("3", OK), ("4", DENIED)])
def test_the_domain_of_the_agent_is_one_of_the_list(
    monkeypatch: pytest.MonkeyPatch, own: str, status: Status
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", own)
    guest = Guest(guarded("name: b, domains: [3], publish: [/ok]"))
    guest.connect()
    assert guest.node(domain=255) == status


@pytest.mark.parametrize(
    ("name", "status"), [("arm", OK), ("left/arm", OK), ("left/leg", DENIED), ("", DENIED), ("/arm/", OK)]
)
def test_names_of_nodes(name: str, status: Status) -> None:
    guest = Guest(guarded("name: a, nodes: [/arm, /*/arm], publish: [/ok]"))
    guest.connect()
    assert guest.node(name) == status


@pytest.mark.parametrize("rule", ["subscribe: [/**]", "graph: false, subscribe: [/**]"])
def test_the_graph_is_a_separate_permission(rule: str) -> None:
    guest = admitted(guarded(f"name: a, {rule}"))
    xml = (
        "<dds><data_reader><topic><kind>NO_KEY</kind><name>ros_to_microros_graph</name>"
        "<dataType>micro_ros_msgs::msg::dds_::Graph_</dataType></topic></data_reader></dds>"
    )
    assert guest.create(0x26, xml, 0x04) == DENIED


# The same rule in every form in which an object can be described

WRITER_XML = (
    "<dds><data_writer><topic><kind>NO_KEY</kind><name>rt/{topic}</name><dataType>std_msgs::msg::dds_::Int32_</dataType>"
    "<historyQos><kind>KEEP_LAST</kind><depth>{depth}</depth></historyQos></topic><qos><durability><kind>{durability}"
    "</kind></durability><reliability><kind>RELIABLE</kind></reliability></qos></data_writer></dds>"
)
APPLICATION = """<application_library name="L"><application name="A">
<domain_participant name="n" domain_id="0"><topic name="rt/{topic}" register_type_ref="std_msgs::msg::dds_::Int32_"/>
<publisher name="p"><data_writer name="w" topic_ref="rt/{topic}"/></publisher></domain_participant>
</application></application_library>"""
STRICT = "name: a, publish: [/ok], qos: {durability: volatile, depth: 10}"


@pytest.mark.parametrize(
    ("topic", "durability", "depth", "status"),
    [("ok", "VOLATILE", 10, OK), ("no", "VOLATILE", 10, DENIED), ("ok", "TRANSIENT_LOCAL", 10, DENIED),
     ("ok", "VOLATILE", 11, DENIED)],
)  # fmt: skip
def test_in_xml(topic: str, durability: str, depth: int, status: Status) -> None:
    bench = guarded(STRICT)
    xml = WRITER_XML.format(topic=topic, durability=durability, depth=depth)
    assert admitted(bench).create(0x15, xml, 0x03) == status
    assert (LABEL in bench.bridge.graph) == (status is OK)


@pytest.mark.parametrize(("topic", "status"), [("/count", OK), ("/ok", DENIED)])
def test_by_reference(topic: str, status: Status) -> None:
    references = read_references([Source("refs.xml", PROFILES)])
    guest = admitted(guarded(f"name: a, publish: [{topic}]", references=references))
    assert guest.create(0x15, "count__dw", 0x03, form=Format.REFERENCE) == status


@pytest.mark.parametrize(("topic", "status"), [("ok", OK), ("no", DENIED)])
def test_in_an_application(topic: str, status: Status) -> None:
    """Its parts are refused together."""
    bench = guarded("name: a, publish: [/ok]")
    guest = Guest(bench)
    guest.connect()
    assert guest.create(0x1C, APPLICATION.format(topic=topic)) == status
    assert bench.bridge.graph == (["0:/n", LABEL] if status is OK else [])


@pytest.mark.parametrize(
    ("rule", "graph"),
    [
        ("publish: [/count]", ["7:/imu", f"/count [{INT32}]"]),
        ("publish: [/count], domain: 2", ["2:/imu", f"/count [{INT32}]"]),
        ("publish: [/other]", ["7:/imu"]),
        ("publish: [/count], qos: {durability: volatile}", ["7:/imu"]),
        ("publish: [/count], qos: {depth: 2}", ["7:/imu"]),
        ("publish: [/count], domains: [2]", []),
    ],
)
def test_preconfigured(rule: str, graph: list[str]) -> None:
    diagnostics = Diagnostics()
    clients = parse_preconfigured([Source("e.json", json.dumps(content()))], diagnostics)
    diagnostics.check()
    bench = guarded(f"name: a, {rule}", preconfigured=Preconfigured(clients))
    assert Guest(bench, 0xA1B2C3D4).connect() == OK
    assert bench.bridge.graph == graph


# Clients that try to get around it


def test_no_session_continues_at_a_place_that_is_not_permitted() -> None:
    bench = guarded(
        "name: a, keys: [0x1], addresses: [10.0.0.1, 10.0.0.2], publish: [/ok]", "name: b, publish: [/b]"
    )
    guest = admitted(bench, session=0x01)
    assert guest.writer("/ok") == OK
    thief = Guest(bench, 1, "10.9.9.9", 0x01)
    assert thief.say(sample()) == []
    assert thief.say(encode(Delete(1, OBJECT_CLIENT))) == []
    assert thief.say(encode(Delete(1, 0x15))) == []
    assert bench.bridge.graph == ["0:/node", LABEL]
    assert bench.bridge.published == []
    assert bench.log.counters["move_denied"] == 3
    moved = Guest(bench, 1, "10.0.0.2", 0x01)
    moved.say(sample())
    assert len(bench.bridge.published) == 1, "where the same rule is for it"


@pytest.mark.parametrize("session", [0x81, 0x82, 0x01])
def test_a_session_that_is_opened_at_a_refused_place_takes_nothing_from_the_client(session: int) -> None:
    bench = guarded("name: a, keys: [0x1], addresses: [10.0.0.1], publish: [/ok]")
    guest = admitted(bench)
    guest.writer("/ok")
    assert Guest(bench, 1, "10.9.9.9", session).connect() == DENIED
    guest.say(sample())
    assert (len(bench.bridge.published), bench.bridge.graph) == (1, ["0:/node", LABEL])


@pytest.mark.parametrize("session", [0x81, 0x82, 0x01])
@pytest.mark.parametrize("forgeable", [True, False])
def test_no_session_at_a_place_of_another_rule_ends_one_that_is_heard(session: int, forgeable: bool) -> None:
    """Its key is in each of its messages: somebody else opens a session with it from where a wider rule fits."""
    bench = guarded("name: a, keys: [0x1], addresses: [10.0.0.1], publish: [/ok]", "name: b, publish: [/b]")
    bench.transport.forgeable = forgeable
    guest = admitted(bench)
    guest.writer("/ok")
    thief = Guest(bench, 1, "10.0.0.2", session)
    for count in (1, 2):
        assert thief.connect() == DENIED
        thief.say(sample())
        assert bench.log.counters["takeover_denied"] == count
    guest.say(sample())
    assert (len(bench.bridge.published), bench.bridge.graph) == (1, ["0:/node", LABEL])
    (state,) = bench.agent.client_states()
    assert (state.address, state.presence, state.denied) == ("10.0.0.1", Presence.CONNECTED, 2)
    assert "in session at 10.0.0.1" in state.last_error
    assert bench.log.counters["client_denied"] == 0


def test_a_session_at_a_place_of_another_rule_restarts_after_a_silence() -> None:
    """Objects of one rule are not kept under another one."""
    bench = guarded("name: a, addresses: [10.0.0.1], publish: [/ok]", "name: b, publish: [/b]")
    guest = admitted(bench)
    guest.writer("/ok")
    other = Guest(bench, 1, "10.0.0.2")
    assert other.connect() == DENIED
    bench.wait(Limits.client_timeout_s + 1)
    assert other.connect() == OK
    assert bench.bridge.graph == []
    assert (other.node(), other.writer("/ok"), other.writer("/b")) == (OK, DENIED, OK)


def test_a_refused_client_at_the_address_of_another_one_does_not_replace_it() -> None:
    bench = guarded(OF_ONE)
    guest = admitted(bench)
    guest.writer("/ok")
    assert Guest(bench, 2, guest.address).connect() == DENIED
    guest.say(sample())
    assert len(bench.bridge.published) == 1


def test_objects_that_are_deleted_and_created_again() -> None:
    bench = guarded(OF_ONE)
    guest = admitted(bench)
    assert guest.writer("/ok") == OK
    guest.say(encode(Delete(1, 0x15)))
    assert guest.writer("/no") == DENIED
    assert guest.writer("/ok") == OK
    assert guest.writer("/no") == DENIED, "replacing the topic takes the writer with it"
    assert bench.bridge.graph == ["0:/node"]
    guest.say(sample())
    assert bench.bridge.published == []


def test_the_object_of_another_client_cannot_be_used() -> None:
    bench = guarded(OF_ONE, "name: two, subscribe: [/ok]")
    admitted(bench).writer("/ok")
    other = admitted(bench, 2, "10.0.0.2")
    other.say(sample())
    assert bench.bridge.published == []
    assert other.writer("/ok") == DENIED


def test_a_client_of_a_forged_address_gets_no_state() -> None:
    bench = guarded(OF_ONE)
    bench.transport.forgeable = True
    for number in range(100):
        assert Guest(bench, 2 + number, f"10.0.1.{number}").connect() == DENIED
    assert len(bench.agent.clients) == 0
    assert bench.log.counters["client_denied"] == 100


def test_a_policy_that_changes_between_opening_a_session_and_using_it() -> None:
    bench = guarded(OF_ONE)
    bench.transport.forgeable = True
    guest = Guest(bench)
    assert guest.connect() == OK
    bench.agent.apply_policy(policy_of("name: a, keys: [0x2], publish: [/ok]"))
    assert guest.say(encode(Delete(1, 0x11))) == []
    assert len(bench.agent.clients) == 0


def test_only_permitted_clients_are_adopted() -> None:
    diagnostics = Diagnostics()
    clients = parse_preconfigured([Source("e.json", json.dumps(content(adopt=True)))], diagnostics)
    message = join(Header(0x01, 1, 0, bytes.fromhex("a1b2c3d4")), [encode(WriteData(1, 5, int32_body(1)))])
    for address, taken in (("10.0.0.1", 1), ("10.0.0.2", 0)):
        bench = guarded(
            "name: a, addresses: [10.0.0.1], publish: [/count]", preconfigured=Preconfigured(clients)
        )
        bench.say(message, address)
        assert len(bench.bridge.published) == taken


# Quotas


def test_a_rule_replaces_limits() -> None:
    bench = guarded("name: a, keys: [0x1], publish: [/**], limits: {objects: 5}", "name: b, publish: [/**]")
    first, second = admitted(bench), admitted(bench, 2, "10.0.0.2")
    assert first.writer("/ok") == OK
    assert first.create(0x41, participant_blob("x")) == Status.RESOURCES
    assert (second.writer("/ok"), second.writer("/ok", number=4)) == (OK, OK)


def test_messages_of_a_client_that_floods_and_of_another_one() -> None:
    bench = guarded(
        "name: a, keys: [0x1], publish: [/**], limits: {messages_per_second: 20}", "name: b, publish: [/**]"
    )
    flood, other = admitted(bench), admitted(bench, 2, "10.0.0.2")
    flood.writer("/flood")
    other.writer("/calm")
    bench.now += 1.5
    for _ in range(100):
        flood.say(sample())
        other.say(sample())
    labels = [label for label, _ in bench.bridge.published]
    assert (labels.count(f"/flood [{INT32}]"), labels.count(f"/calm [{INT32}]")) == (20, 100)
    assert bench.log.counters["too_many_messages"] == 80


def test_histories_of_a_client() -> None:
    depth = 6000 // UNREAD_BYTES
    rule = f"name: a, subscribe: [/**], limits: {{object_history_bytes: {depth * 512}, client_history_bytes: 12000}}"
    guest = admitted(guarded(rule))
    assert guest.reader("/a", depth=depth + 1) == Status.RESOURCES
    assert guest.reader("/a", depth=depth) == OK
    assert guest.reader("/b", depth=depth, number=4) == OK
    assert guest.reader("/c", depth=depth, number=5) == Status.RESOURCES


def test_the_time_of_the_agent_for_one_client() -> None:
    """Each message takes 10 ms here: of 200 ms for each second, 20 messages pass in the first and then 20 a second."""
    bench = guarded(
        "name: a, keys: [0x1], publish: [/**], limits: {work_ms_per_second: 200}", "name: b, publish: [/**]"
    )
    busy, other = admitted(bench), admitted(bench, 2, "10.0.0.2")
    busy.writer("/busy")
    other.writer("/calm")
    bench.now += 10
    publish = type(next(iter(bench.agent.clients)).objects.find(0x15).writer).publish  # type: ignore[union-attr]

    def slow(writer: Any, serialized: bytes) -> None:
        bench.now += 0.01
        publish(writer, serialized)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("tests.support.agent.fakes.FakeWriter.publish", slow)
        for number in range(300):
            before = bench.now
            busy.say(sample())
            bench.now = before + 0.01
            if number % 10 == 0:
                other.say(sample())
    labels = [label for label, _ in bench.bridge.published]
    assert 75 <= labels.count(f"/busy [{INT32}]") <= 90, "20 at once, and 20 in each of 3.3 s"
    assert labels.count(f"/calm [{INT32}]") == 30
    assert bench.log.counters["too_much_work"] > 200


@pytest.mark.parametrize("cause", ["other programs", "DDS"])
def test_the_load_of_the_machine_is_not_charged(cause: str) -> None:
    """Each message takes 10 ms here; 9.9 of them have other programs, or the agent waits for DDS."""
    bench = guarded("name: a, keys: [0x1], publish: [/**], limits: {work_ms_per_second: 200}")
    client = admitted(bench)
    client.writer("/busy")
    for _ in range(10):  # the agent sees that the machine is busy
        bench.now += 1.0
        bench.waited += 0.5
        client.say(sample())
    sent = len(bench.bridge.published)
    publish = type(next(iter(bench.agent.clients)).objects.find(0x15).writer).publish  # type: ignore[union-attr]

    def slow(writer: Any, serialized: bytes) -> None:
        bench.now += 0.01
        bench.waited += 0.0099 if cause == "other programs" else 0.0005
        publish(writer, serialized)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("tests.support.agent.fakes.FakeWriter.publish", slow)
        for _ in range(100):
            client.say(sample())
    passed = len(bench.bridge.published) - sent
    assert passed == 100 if cause == "other programs" else passed <= 45


# Another policy


def reload(bench: Bench, policy: Policy) -> list[tuple[Any, str]]:
    """Apply a policy; return what the agent sent."""
    del bench.transport.sent[:]
    bench.agent.apply_policy(policy)
    return [(address, data.hex(" ")) for address, data in bench.transport.sent]


def test_those_that_stay_allowed_stay() -> None:
    bench = guarded(OF_ONE, "name: two, publish: [/**]")
    first, second = admitted(bench), admitted(bench, 2, "10.0.0.2")
    first.writer("/ok")
    second.writer("/x")
    sent = reload(bench, policy_of("name: again, keys: [0x1], publish: [/ok, /new]"))
    assert sent == [("10.0.0.2", "81 00 00 00 05 01 06 00 00 02 ff fe 83 00")]
    assert bench.bridge.graph == ["0:/node", LABEL]
    assert "disconnected by the new policy: no rule of the policy is for it" in bench.text.getvalue()
    assert second.connect() == DENIED
    first.say(sample())
    assert len(bench.bridge.published) == 1
    assert first.writer("/new", number=4) == OK


@pytest.mark.parametrize(
    ("rule", "stays"),
    [
        ("name: one, keys: [0x1], publish: [/ok], subscribe: [/ok]", True),
        ("name: all, publish: [/**]", True),
        ("name: one, publish: [/other]", False),
        ("name: one, publish: [{name: /ok, depth: 3}]", False),
        ("name: one, publish: [/ok], domain: 4", False),
        ("name: one, publish: [/ok], nodes: [/other]", False),
        ("name: one, refuse: true", False),
        ("name: one, publish: [/ok], devices: [can0]", False),
    ],
)
@pytest.mark.parametrize("asleep", [False, True])
def test_a_client_whose_entities_are_no_longer_permitted_goes(rule: str, stays: bool, asleep: bool) -> None:
    bench = guarded(OF_ONE, limits=Limits(client_timeout_s=1.0))
    admitted(bench).writer("/ok")
    if asleep:
        bench.wait(4)
        assert bench.bridge.graph == []
    sent = reload(bench, policy_of(rule))
    assert len(bench.agent.clients) == stays
    assert bool(sent) == (not stays and not asleep)


def test_new_limits_hold_at_once() -> None:
    bench = guarded(OF_ONE)
    guest = admitted(bench)
    guest.writer("/ok")
    reload(bench, policy_of(OF_ONE + ", limits: {messages_per_second: 5, work_ms_per_second: 1000}"))
    bench.now += 2
    for _ in range(10):
        guest.say(sample())
    assert len(bench.bridge.published) == 5
    reload(bench, policy_of(OF_ONE))
    bench.now += 2
    for _ in range(10):
        guest.say(sample())
    assert len(bench.bridge.published) == 15


# What is seen of it


def test_denials_are_in_the_view_of_clients() -> None:
    bench = guarded(OF_ONE, "name: bad, refuse: true, keys: [0x2]")
    guest = admitted(bench)
    guest.writer("/no")
    guest.writer("/no")
    Guest(bench, 2, "10.0.0.2").connect()
    Guest(bench, 2, "10.0.0.3").connect()
    first, second = bench.agent.client_states()
    assert (first.key, first.presence, first.denied) == ("00000001", Presence.CONNECTED, 2)
    assert first.last_error.endswith("does not let it publish on /no")
    assert (second.key, second.presence, second.denied, second.sessions) == (
        "00000002",
        Presence.REFUSED,
        2,
        0,
    )
    assert (second.address, second.nodes) == ("10.0.0.3", ())
    assert second.last_error == "the rule 'bad' (policy.yaml:4) refuses it"
    assert (bench.log.counters["denied"], bench.log.counters["client_denied"]) == (2, 2)
    guest.bench.say(hello(1, 0x82), guest.address)
    guest.session = 0x82
    guest.node()
    guest.writer("/no")
    assert bench.agent.client_states()[0].denied == 3, "over all sessions"


def test_a_client_that_is_refused_after_a_reload_and_let_in_again() -> None:
    bench = guarded(OF_ONE)
    guest = admitted(bench)
    reload(bench, policy_of())
    assert guest.connect() == DENIED
    assert bench.agent.client_states()[0].presence is Presence.REFUSED
    reload(bench, policy_of(OF_ONE))
    assert guest.connect() == OK
    (state,) = bench.agent.client_states()
    assert (state.presence, state.denied, state.sessions) == (Presence.CONNECTED, 1, 2)


def test_the_records_of_refused_clients_are_limited() -> None:
    bench = guarded(OF_ONE, limits=Limits(clients=8))
    admitted(bench)
    for key in range(2, 100):
        Guest(bench, key, "10.0.0.9").connect()
    states = bench.agent.client_states()
    assert len(states) <= 9
    assert states[0].key == "00000001"


def test_a_flood_of_refused_sessions_writes_a_limited_log() -> None:
    bench = guarded(OF_ONE)
    for key in range(2, 3000):
        bench.now += 0.001
        Guest(bench, key, "10.0.0.9").connect()
    lines = bench.text.getvalue().count("was refused")
    assert BURST <= lines <= BURST + 3 * SUSTAINED, "in the three seconds of the bench"
    assert bench.log.counters["client_denied"] > 1900
