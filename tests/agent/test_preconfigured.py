# SPDX-License-Identifier: Apache-2.0
"""Entities that the agent makes by itself: the file, the life of the objects, and clients that never come again."""

from __future__ import annotations

import json
from typing import Any

import pytest

from microros_gen.agent.configuration.entities_file import parse_preconfigured
from microros_gen.agent.limits import Limits
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.wire.data_messages import ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Delete, Heartbeat
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from microros_gen.diagnostics import Diagnostics, Source, UserError
from tests.support.agent.captured import CREATE_CLIENT, PING, STATUS_AGENT
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import message
from tests.support.agent.entities_file import content
from tests.support.agent.fakes import Bench, FakeReplier, FakeRequester, FakeSource
from tests.support.agent.readers import FOREVER
from tests.support.ids import without_id

SERVICE = "/arm [std_srvs/srv/SetBool]"
IDENTITY = bytes.fromhex("010f78fdca7032130200030000000103 00000000 01000000")
GRAPH = ["7:/imu", "/count [std_msgs/msg/Int32]"]


def load(*contents: dict[str, Any], indent: int | str = 2) -> Preconfigured:
    diagnostics = Diagnostics()
    sources = [Source(f"e{i}.json", json.dumps(c, indent=indent)) for i, c in enumerate(contents)]
    clients = parse_preconfigured(sources, diagnostics)
    diagnostics.check()
    return Preconfigured(clients)


def bench_with(*contents: dict[str, Any]) -> Bench:
    return Bench(preconfigured=load(*contents or (content(),)))


def sample(value: int, sequence: int, session: int = 0x81, key: bytes = b"", stream: int = 1) -> bytes:
    return join(Header(session, stream, sequence, key), [encode(WriteData(1, 5, int32_body(value)))])


def values(bench: Bench) -> list[int]:
    return [int.from_bytes(data[4:8], "little") for _, data in bench.bridge.published]


# The life of the objects


@pytest.mark.parametrize("indent", [2, "\t"])
def test_they_exist_when_the_session_is_open(indent: int | str) -> None:
    bench = Bench(preconfigured=load(content(), indent=indent))
    assert bench.bridge.graph == []
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]
    assert bench.bridge.graph == GRAPH
    assert "node 7:/imu" in bench.text.getvalue()
    assert "(best_effort, transient_local, keep_last 3)" in bench.text.getvalue()
    assert bench.say(sample(5, 0)) == []
    assert values(bench) == [5]


def test_other_clients_get_nothing_and_a_star_is_for_all_others() -> None:
    other = CREATE_CLIENT.replace("a1 b2", "77 77")
    bench = bench_with()
    bench.say(other)
    assert bench.bridge.graph == []
    any_client = content("*")
    any_client["clients"][0]["objects"][0]["name"] = "other"
    bench = bench_with(content(), any_client)
    bench.say(CREATE_CLIENT)
    assert bench.bridge.graph == GRAPH
    bench.say(other, "b")
    assert bench.bridge.graph == [*GRAPH, "7:/other", GRAPH[1]]


def test_they_survive_sleep_and_a_second_create_client_and_leave_with_the_session() -> None:
    bench = bench_with()
    bench.say(CREATE_CLIENT)
    bench.wait(31)
    assert bench.bridge.graph == []
    bench.say(sample(1, 0))
    assert bench.bridge.graph == GRAPH
    assert values(bench) == [1]
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]
    assert bench.bridge.graph == GRAPH
    bench.say(sample(2, 0))
    assert values(bench) == [1, 2]
    bench.say("81 00 00 00 03 01 04 00 00 02 ff fe")
    assert bench.bridge.graph == []


def test_they_may_be_deleted_and_are_back_with_the_next_session() -> None:
    bench = bench_with()
    bench.say(CREATE_CLIENT)
    (answer,) = bench.say(message(Delete(9, 5)))
    assert answer.endswith("00 00")
    assert bench.bridge.graph == GRAPH[:1]
    bench.say(CREATE_CLIENT)
    assert bench.bridge.graph == GRAPH


def service(number: int, kind: str, **more: Any) -> dict[str, Any]:
    return {
        "id": f"0x00{number}",
        "kind": kind,
        "parent": "0x0001",
        "name": "/arm",
        "request_type": "std_srvs::srv::dds_::SetBool_Request_",
        "reply_type": "std_srvs::srv::dds_::SetBool_Response_",
        **more,
    }


def everything(**more: Any) -> dict[str, Any]:
    """Return a client that writes, reads, serves and calls."""
    data = content(**more)
    data["clients"][0]["objects"] += [
        {"id": "0x0014", "kind": "subscriber", "parent": "0x0001"},
        {"id": "0x0016", "kind": "data_reader", "parent": "0x0014", "topic": "0x0002", "depth": 5},
        service(18, "replier"),
        service(17, "requester", request_topic="rq/goRequest", reply_topic="rr/goReply"),
    ]
    return data


def sources(bench: Bench) -> tuple[FakeSource, FakeReplier, FakeRequester]:
    reader, replier, requester = bench.bridge.sources
    assert isinstance(replier, FakeReplier)
    assert isinstance(requester, FakeRequester)
    return reader, replier, requester


def test_a_client_reads_serves_and_calls_without_creating() -> None:
    bench = bench_with(everything())
    bench.say(CREATE_CLIENT)
    assert bench.bridge.graph == [*GRAPH, GRAPH[1], SERVICE, SERVICE]
    reported = bench.text.getvalue()
    assert "subscription /count [std_msgs/msg/Int32] (reliable, volatile, keep_last 5)" in reported
    assert f"service {SERVICE}" in reported
    assert f"service client {SERVICE}" in reported
    reader, replier, requester = sources(bench)
    for number, wanted in enumerate((0x16, 0x18, 0x17)):
        assert bench.say(message(ReadData(9, wanted, 1, delivery=FOREVER), sequence=number)) == []
    reader.put(b"\0\1\0\0" + int32_body(7))
    assert [answer[-23:] for answer in bench.take()] == ["00 09 00 16 07 00 00 00"]
    replier.put((IDENTITY, b"\0\1\0\0\1"))
    assert [answer[-5:] for answer in bench.take()] == ["00 01"]
    bench.say(message(WriteData(8, 0x18, IDENTITY + b"\1"), sequence=3))
    assert replier.replies == [(IDENTITY, b"\0\1\0\0\1")]
    bench.say(message(WriteData(8, 0x17, b"\1"), sequence=4))
    assert requester.requests == [(1, b"\0\1\0\0\1")]
    requester.put((1, b"\0\1\0\0\2"))
    assert [answer[-26:] for answer in bench.take()] == ["00 09 00 17 00 08 00 17 02"]
    assert not bench.log.counters


@pytest.mark.parametrize(("object_id", "adopted"), [(5, True), (0x16, False), (0x17, True), (0x18, True)])
def test_an_adopted_client_writes_to_existing_readers(object_id: int, adopted: bool) -> None:
    bench = bench_with(everything(adopt=True))
    for sequence in (1, 2):
        bench.say(message(WriteData(1, object_id, bytes(28)), sequence=sequence))
        bench.now += Limits().adopt_after_s
    assert bool(bench.bridge.graph) is adopted


def test_objects_that_cannot_be_created_are_reported() -> None:
    unknown = content()
    unknown["clients"][0]["objects"][1]["type"] = "no_such_package::msg::dds_::T_"
    bench = bench_with(unknown)
    bench.say(CREATE_CLIENT)
    wanted = "client A1B2C3D4: datawriter 0x0005 refused (DDS_ERROR): type no_such_package/msg/T is not known"
    assert wanted in bench.text.getvalue()


# A client that never comes again


def test_without_permission_to_adopt_an_unknown_client_is_refused() -> None:
    bench = bench_with()
    bench.say(sample(5, 40))
    assert bench.bridge.graph == []
    assert bench.log.counters == {"no_session": 1}


def listened_to(bench: Bench, address: str = "a") -> Bench:
    """Let a sender without a session be heard for as long as it takes to know that it has no liveliness."""
    assert bench.say(sample(99, 0), address) == []
    assert bench.bridge.published == []
    bench.now += Limits().adopt_after_s
    return bench


def test_one_that_asks_for_the_agent_is_never_taken_for_another() -> None:
    """A client with liveliness whose agent was restarted: its samples are dropped, and it must detect that."""
    bench = bench_with(content(adopt=True))
    for i in range(9):
        assert bench.say(sample(i, 40 + i)) == []
        bench.now += 0.5
    (answer,) = bench.say(PING.replace("80 00", "81 00", 1))
    assert bytes.fromhex(answer)[12:14] == b"\0\0", answer  # implementation status 0: no session
    bench.now += 4
    assert bench.say(sample(9, 49)) == []
    assert values(bench) == []
    assert bench.bridge.graph == []


def test_an_agent_that_was_restarted_adopts() -> None:
    bench = listened_to(bench_with(content(adopt=True)))
    for i in range(3):
        bench.say(sample(i, 40 + i))
    assert values(bench) == [0, 1, 2]
    assert bench.bridge.graph == GRAPH
    assert "client A1B2C3D4 adopted at a" in bench.text.getvalue()
    assert not bench.log.counters
    assert bench.say(CREATE_CLIENT, "b") == [STATUS_AGENT]  # it boots
    bench.say(sample(3, 0), "b")
    assert values(bench)[-1] == 3


def test_a_key_in_the_header_is_exact() -> None:
    other = content("0x01020304", adopt=True)
    bench = bench_with(content(adopt=True), other)
    bench.say(sample(1, 9, 0x01, bytes.fromhex("A1B2C3D4")))
    bench.say(sample(2, 9, 0x01, bytes.fromhex("11111111")), "b")
    assert values(bench) == [1]
    assert bench.log.counters == {"no_session": 1}


def test_two_that_could_be_meant_are_none() -> None:
    bench = bench_with(content(adopt=True), content("0x01020304", adopt=True))
    bench.say(sample(1, 9))
    assert values(bench) == []
    bench.say(CREATE_CLIENT)
    listened_to(bench, "b")
    bench.say(sample(2, 9), "b")  # now only one is missing
    assert values(bench) == [2]


def test_a_sample_for_another_writer_is_not_taken() -> None:
    bench = bench_with(content(adopt=True))
    bench.say(message(WriteData(1, 0x15, int32_body(1)), sequence=9))
    assert bench.bridge.graph == []
    assert bench.log.counters == {"no_session": 1}


def test_a_reliable_stream_goes_on_where_its_heartbeat_says() -> None:
    bench = listened_to(bench_with(content(adopt=True)))
    bench.say(sample(7, 0xFFF0, stream=0x80))
    assert values(bench) == []
    (answer,) = bench.say(message(Heartbeat(0xFFEF, 0xFFF0, 0x80), stream=0))
    assert "0a 01 05 00 ef ff 00 03 80" in answer
    bench.say(sample(6, 0xFFEF, stream=0x80))
    bench.say(sample(7, 0xFFF0, stream=0x80))
    assert values(bench) == [6, 7]


def test_one_that_pings_is_another_and_heals() -> None:
    bench = listened_to(bench_with(content(adopt=True)))
    bench.say(sample(1, 9))
    assert bench.say(PING.replace("80 00", "81 00", 1)) == []
    assert bench.bridge.graph == []
    assert "disconnected: it is not the client" in bench.text.getvalue()
    (answer,) = bench.say(PING)
    assert bytes.fromhex(answer)[12:14] == b"\0\0", answer  # implementation status 0: no session
    bench.say(sample(2, 10))
    assert values(bench) == [1]
    assert bench.say(CREATE_CLIENT) == [STATUS_AGENT]


# The file


def faults(text: str) -> list[str]:
    diagnostics = Diagnostics()
    parse_preconfigured([Source("e.json", text)], diagnostics)
    return [without_id(d.headline()) for d in diagnostics]


def changed(place: int, **more: Any) -> str:
    data = content()
    item = data["clients"][0]["objects"][place]
    item.update({key: value for key, value in more.items() if value is not None})
    for key in [key for key, value in more.items() if value is None]:
        del item[key]
    return "{" + json.dumps(data)[1:].replace('{"id"', '\n{"id"')


def one(client: str) -> str:
    return '{"version": 1, "clients": [{' + client + "}]}"


@pytest.mark.parametrize(
    ("text", "place", "wanted"),
    [
        ("", "", "this file is empty"),
        ("[]", "[]", "an entities file must be a mapping"),
        ('{"version": 1', "", ""),
        ('{"version": 2, "clients": []}', "2,", "unknown version of the file. Write 1"),
        ('{"version": 1, "clients": [], "name": 1}', '"name"', "unknown key 'name'"),
        ('{"version": 1, "clients": {}}', "{}", "'clients' must be a list"),
        (one('"key": "0x0", "objects": []'), '"0x0"', "a client key is a hexadecimal number"),
        (one('"key": "*", "adopt": true, "objects": []'), "true", "a client of any key cannot be adopted"),
        (one('"key": "0x1", "adopt": 1, "objects": []'), "1, ", "'adopt' must be true or false"),
        (changed(0, id="0x0012"), '"0x0012"', 'the last digit of a participant\'s id is 1. Perhaps "0x0011"'),
        (changed(0, id="1"), '"1"', "'id' must be an object id"),
        (changed(0, domain=233), "233", "'domain' must be a number from 0 to 232, or 255"),
        (changed(0, name=""), '""', "'name' is empty"),
        (
            changed(1, parent="0x0011"),
            '"0x0011"',
            "unknown participant 0x0011: no earlier object has this id",
        ),
        (changed(1, type=None), '{"id": "0x0002"', "missing key 'type'"),
        (changed(1, type=3), "3}", "'type' must be a text"),
        (changed(2, kind="publsher"), '"publsher"', "'kind' must be one of"),
        (changed(2, kind=None), '{"id": "0x0003"', "missing key 'kind'"),
        (changed(3, topic="0x0001"), '"0x0001", "rel', "unknown topic 0x0001: no earlier object has this id"),
        (changed(3, reliability="relable"), '"relable"', "'reliability' must be one of"),
        (changed(3, depth=70000), "70000", "'depth' must be a number from 0 to 65535"),
        (changed(3, deadline=1), '"deadline"', "unknown key 'deadline'"),
    ],
)
def test_faults(text: str, place: str, wanted: str) -> None:
    (found,) = faults(text)
    where, _, what = found.partition(": error: ")
    line, column = map(int, where.split(":")[1:])
    assert what.startswith(wanted), found
    assert text.split("\n")[line - 1][column - 1 :].startswith(place), found


def test_every_fault_in_one_run() -> None:
    data = content()
    data["clients"][0]["key"] = "me"
    data["clients"][0]["objects"][0]["domain"] = -1
    data["clients"][0]["objects"][3]["depth"] = "x"
    assert len(faults(json.dumps(data))) == 3


def test_adopting_a_client_that_reads_is_a_warning() -> None:
    """A new agent cannot reach it: it asked the one before, and says nothing more."""
    data = content(adopt=True)
    assert faults(json.dumps(data)) == []
    data["clients"][0]["objects"].append(service(28, "replier"))
    diagnostics = Diagnostics()
    text = json.dumps(data)
    assert parse_preconfigured([Source("e.json", text)], diagnostics)[0].adopt
    (warning,) = diagnostics
    assert not diagnostics.has_errors()
    assert warning.span is not None
    assert text[warning.span.column - 1 :].startswith("true")
    assert "after a restart of the agent this client receives nothing from ROS 2: 1 of" in warning.message
    assert "liveliness: ping" in str(warning.hint)


def test_an_id_or_a_key_twice() -> None:
    data = content()
    data["clients"][0]["objects"].append(data["clients"][0]["objects"][0])
    assert "duplicate id 0x0001" in faults(json.dumps(data))[0]
    with pytest.raises(
        UserError, match=r"e1.json:5:14: error: duplicate client 0xA1B2C3D4; first in e0.json"
    ):
        load(content(), content())


def test_names_that_ros_does_not_have() -> None:
    data = content()
    data["clients"][0]["objects"][1]["name"] = "count"
    with pytest.raises(UserError, match=r"e0.json:\d+:\d+: error: topic 'count' is not a ROS topic"):
        load(data)


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        ({"id": "0x0027"}, 'the last digit of a replier\'s id is 8. Perhaps "0x0028"'),
        ({"parent": "0x0003"}, "unknown participant 0x0003: no earlier object has this id"),
        ({"reply_type": 1}, "'reply_type' must be a text"),
        ({"depth": 3}, "unknown key 'depth'"),
        ({"request_type": "std_srvs::srv::dds_::SetBool_"}, "is not"),
        ({"reply_type": "std_srvs::srv::dds_::Empty_Response_"}, "Empty"),
        ({"request_topic": "rt/arm"}, "request topic 'rt/arm' is not that of a ROS service"),
        ({"reply_topic": "rr/legReply"}, "requests are for the service /arm, replies for /leg"),
    ],
)
def test_faults_of_services(change: dict[str, Any], wanted: str) -> None:
    data = content()
    data["clients"][0]["objects"].append(service(28, "replier", **change))
    with pytest.raises(UserError) as caught:
        load(data)
    (found,) = caught.value.diagnostics
    assert wanted in without_id(found.headline())
    assert found.span is not None
