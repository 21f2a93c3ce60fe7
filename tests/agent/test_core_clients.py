# SPDX-License-Identifier: Apache-2.0
"""Two clients with one key, limits on messages, manifests, what GET_INFO tells of objects, the time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.wire.constants import Format, Status
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Create, Fragment
from microros_gen.agent.wire.session_messages import GetInfo, Info, ReaderActivity, WriterActivity
from microros_gen.agent.wire.submessages import decode
from tests.support.agent import captured
from tests.support.agent.captured import CREATE_CLIENT, PING, STATUS_AGENT
from tests.support.agent.dialogue import GRAPH, WRITE, connected, entities, message, publishing
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, READER, Listener, put, reader_entities, subscribing

WARNING = "warning: two clients use the key A1B2C3D4: one at {}, one at {};"
OTHER_SESSION = CREATE_CLIENT.replace("d4 81", "d4 82")


# Two clients with one key


def warnings(bench: Bench) -> list[str]:
    return [line for line in bench.text.getvalue().splitlines() if "two clients" in line]


def test_who_goes_on_sending_from_the_old_place_is_another() -> None:
    bench = publishing()
    bench.say(CREATE_CLIENT, "b")
    bench.say("81 01 09 00" + WRITE, "a")
    assert warnings(bench) == [], "it may have been on its way"
    bench.now += 2
    for sequence in range(10, 20):
        bench.say(f"81 01 {sequence:02x} 00" + WRITE, "a")
    (line,) = warnings(bench)
    assert line.startswith(WARNING.format("b", "a"))
    assert line.endswith("Give each its own, in its application file: `session: {key: …}`")


@pytest.mark.parametrize("second", [CREATE_CLIENT, OTHER_SESSION], ids=["same session", "another session"])
def test_back_and_forth_is_two_clients(second: str) -> None:
    bench = Bench()
    for _ in range(5):
        bench.say(CREATE_CLIENT, "a")
        bench.now += 3
        bench.say(second, "b")
        bench.now += 3
    (line,) = warnings(bench)
    assert line.startswith(WARNING.format("b", "a"))


def test_with_the_key_in_the_header_too() -> None:
    bench = Bench()
    bench.say(captured.CREATE_CLIENT_KEYED, "a")
    for _ in range(3):
        for address in ("b", "a"):
            bench.now += 1
            bench.say("01 00 00 00 a1 b2 c3 d4" + PING[11:], address)
    assert len(warnings(bench)) == 1


def test_a_restart_from_another_port_is_one_client() -> None:
    bench = publishing()
    for port in "bcdef":
        bench.now += 1
        bench.say(CREATE_CLIENT, port)
        bench.now += 61
        bench.say(PING.replace("80", "81", 1), port)
    bench.say(CREATE_CLIENT, "b")  # a port that was used long ago
    assert warnings(bench) == []


# Limits


def test_messages_of_a_client_are_limited() -> None:
    bench = publishing(Limits(messages_per_second=20))
    for sequence in range(4, 54):
        bench.say(message(WriteData(1, 0x15, b"1234"), sequence=sequence))
    assert len(bench.bridge.published) == 16, "four created the entities"
    assert bench.log.counters == {"too_many_messages": 34}
    bench.now += 1
    bench.say(message(WriteData(1, 0x15, b"1234"), sequence=60))
    assert len(bench.bridge.published) == 17


def test_what_is_dropped_for_its_rate_is_not_lost_on_a_reliable_stream() -> None:
    bench = publishing(Limits(messages_per_second=8))
    sent = [message(WriteData(1, 0x15, bytes([i])), stream=0x80, sequence=i) for i in range(6)]
    for data in sent:
        bench.say(data)
    assert len(bench.bridge.published) == 4
    bench.now += 1
    assert bench.say("81 00 00 00 0b 01 05 00 00 00 05 00 80") == ["81 00 00 00 0a 01 05 00 04 00 00 03 80"]
    for data in sent[4:]:
        bench.say(data)
    assert [data[4] for _, data in bench.bridge.published] == list(range(6))


def test_strangers_are_limited_and_clients_served_meanwhile() -> None:
    bench = publishing(Limits(strangers_per_second=10))
    answers = [bench.say(PING, f"stranger {i}") for i in range(50)]
    assert sum(map(len, answers)) == 9, "one made the session"
    assert bench.log.counters == {"too_many_strangers": 41}
    bench.say("81 01 04 00" + WRITE)
    assert len(bench.bridge.published) == 1
    assert len(bench.say(PING)) == 1, "whoever is in session is no stranger"
    bench.now += 1
    assert len(bench.say(PING, "stranger")) == 1


# Manifests


@pytest.mark.parametrize("name", ["0xA1B2C3D4", "0xa1b2c3d4", "/a", "a"])
def test_a_manifest_is_handed_to_the_ros_side(name: str) -> None:
    bench = Bench(manifests=Manifests({name: {"std_msgs/msg/Int32": "RIHS01_12"}}))
    bench.say(CREATE_CLIENT)
    bench.say(message(entities()[0]))
    (hash_of,) = bench.bridge.hashes
    assert hash_of is not None
    assert hash_of("std_msgs/msg/Int32") == "RIHS01_12"
    assert hash_of("std_msgs/msg/Int64") is None


def test_without_a_manifest_the_bridge_uses_its_own_definitions() -> None:
    bench = Bench(manifests=Manifests({"0x01020304": {}, "/b": {}}))
    bench.say(CREATE_CLIENT)
    bench.say(message(entities()[0]))
    assert bench.bridge.hashes == [None]


# GET_INFO


def info(bench: Bench, object_id: int, mask: int = 3, stream: int = 0, sequence: int = 0) -> Info:
    answers = bench.say(message(GetInfo(7, object_id, mask), stream=stream, sequence=sequence))
    raw = bytes.fromhex(answers[-1])
    found = decode(raw[4], raw[5], raw, 8, 8 + (raw[6] | raw[7] << 8))
    assert isinstance(found, Info)
    assert (found.request, found.object, found.implementation_status) == (7, object_id, 1)
    return found


def test_info_on_a_writer() -> None:
    """7.8.3.3: configuration as it was created, activity (7.7.12) of writers and readers."""
    bench = publishing()
    created = entities()[3]
    for i in range(3):
        bench.say(message(WriteData(1, 0x15, b"1234"), stream=0x80, sequence=i))
    found = info(bench, 0x15)
    assert (found.status, found.config, found.activity) == (0, created.representation, WriterActivity(3, 2))
    assert info(bench, 0x15, mask=1).activity is None
    assert info(bench, 0x15, mask=2).config is None
    assert info(bench, 0x15, mask=0) == Info(7, 0x15, 0, 1)


def test_info_on_a_reader() -> None:
    bench = subscribing()
    listener = Listener(bench)
    assert info(bench, READER).activity == ReaderActivity(-1), "nothing was acknowledged yet"
    listener.read(stream=0x80)
    put(bench, 1, 2, 3)
    listener.take()
    listener.acknowledge(2)
    found = info(bench, READER)
    assert found.activity == ReaderActivity(1)
    assert found.config == reader_entities()[-1].representation


@pytest.mark.parametrize("index", [0, 1, 2])
def test_info_on_what_has_no_activity(index: int) -> None:
    bench = publishing()
    created = entities()[index]
    assert info(bench, created.object) == Info(7, created.object, 0, 1, created.representation)


@pytest.mark.parametrize("object_id", [0x25, 0x16, 0x00, 0x1F, 0xFFFF])
def test_info_on_what_is_not_there(object_id: int) -> None:
    assert info(publishing(), object_id) == Info(7, object_id, Status.UNKNOWN_REFERENCE, 1)


@pytest.mark.parametrize("object_id", [0xFFFD, 0xFFFE])
def test_info_on_the_agent_and_the_client_is_the_agents(object_id: int) -> None:
    assert info(publishing(), object_id, mask=2).config is not None, (
        "as the public agent: the mask does not matter"
    )


def test_a_long_configuration_goes_where_there_is_room_for_it() -> None:
    bench = connected()
    text = captured.PARTICIPANT_XML.replace("p1", "p" * 100) + " " * 600
    chunks = [
        message(Create(1, 0x11, 1, Format.REFERENCE, b"x"), stream=0),
        message(Create(2, 0x11, 1, Format.XML, text.encode()), stream=0),
    ]
    for data in chunks:
        bench.say(data)
    assert info(bench, 0x11).config is None
    answers = bench.say(message(GetInfo(7, 0x11, 1), stream=0x80))
    fragments = [bytes.fromhex(a) for a in answers if a[12:14] == "0d"]
    whole = b"".join(chunk[8:] for chunk in fragments)
    found = decode(whole[0], whole[1], whole, 4, len(whole))
    assert isinstance(found, Info)
    assert found.config is not None
    assert fragments[0][4] == Fragment.ID


# Time


def test_time_is_that_of_arrival_and_of_sending(monkeypatch: pytest.MonkeyPatch) -> None:
    """8.3.5.16: receive is when the question came, transmit when the answer goes."""
    bench = connected()
    moments = iter([1_700_000_000_000_000_000, 1_700_000_000_000_250_000])
    monkeypatch.setattr("microros_gen.agent.operations.time.time_ns", lambda: next(moments))
    monkeypatch.setattr(bench.agent._processor, "_clock", lambda: bench.now + 0.001)
    (answer,) = bench.say("81 00 00 00 0e 01 08 00 01 02 03 04 05 06 07 08")
    raw = bytes.fromhex(answer)
    numbers = [int.from_bytes(raw[at : at + 4], "little") for at in range(8, 24, 4)]
    assert numbers == [1_700_000_000, 250_000, 1_699_999_999, 999_000_000]


def test_a_session_with_id_zero_is_invalid() -> None:
    """8.3.2.1: 0x00 and 0x80 mean *no session*."""
    bench = Bench()
    keyed = captured.CREATE_CLIENT_KEYED.replace("d4 01", "d4 00")
    (answer,) = bench.say(keyed)
    assert answer.startswith("00 00 00 00 a1 b2 c3 d4 04 01 0b 00 85")
    assert bench.say(CREATE_CLIENT.replace("d4 81", "d4 80"))[0][24:26] == "85"
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]


def test_nothing_is_read_by_one_that_sleeps_for_good() -> None:
    bench = subscribing(Limits(client_timeout_s=1.0, sleep_timeout_s=5.0))
    Listener(bench).read(stream=0x80, control=FOREVER)
    put(bench, *range(40))
    bench.take()
    bench.wait(6)
    assert len(bench.agent.clients) == 0
    assert bench.bridge.graph == []
    assert bench.agent._deliveries._by_source == {}
    assert GRAPH[0] not in bench.bridge.graph


def test_the_domain_of_a_node_is_reported() -> None:
    bench = connected()
    bench.say(message(replace(entities()[0], domain=7), stream=0))
    assert "client A1B2C3D4: node 7:/a in ROS domain 7" in bench.text.getvalue()


def test_clients_of_an_agent_before_this_one_are_not_called_malformed() -> None:
    """After a restart they go on sending, until they notice."""
    bench = Bench()
    for sequence in range(5):
        assert bench.say(message(WriteData(1, 0x15, b"1234"), stream=0x80, sequence=sequence)) == []
    (line,) = bench.text.getvalue().splitlines()
    assert "it is of a session that this agent does not know (WRITE_DATA without a session)" in line
    assert "perhaps of the agent before this one" in line
    assert "malformed" not in line
    assert bench.log.counters == {"no_session": 5}
