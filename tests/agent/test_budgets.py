# SPDX-License-Identifier: Apache-2.0
"""What clients may make the agent hold, kind by kind: refused with a status, shared, and released."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from microros_gen.agent.budgets import CALL_BYTES, ROS_BYTES, Shares, cost_of
from microros_gen.agent.history import CHANGE_BYTES
from microros_gen.agent.limits import Limits
from microros_gen.agent.streams_out import ReliableOut
from microros_gen.agent.wire.constants import Format, ObjectKind
from microros_gen.agent.wire.data_messages import ReadData, WriteData
from microros_gen.agent.wire.entity_messages import Acknack, Create, Delete
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.budgets import OK, RESOURCES, ask, connect, reading
from tests.support.agent.client import dds_type, reader_blob, service_blob, topic_blob, writer_blob
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities, sample

RELIABLE, TRANSIENT_LOCAL, KEEP_ALL_RELIABLE = 3, 1 | 2 | 8, 1


def shares(bench: Bench, address: str = "client 1") -> Shares:
    client = bench.agent.clients.at(address)
    assert client is not None
    return client.shares


def endpoint(kind: int, flags: int, depth: int) -> Create:
    blob = writer_blob if kind == 5 else reader_blob
    return Create(
        13, 0x10 | kind, kind, Format.BINARY, blob(0x12, flags, depth), 0x13 if kind == 5 else 0x14, 0
    )


def publisher(limits: Limits | None = None, flags: int = RELIABLE, depth: int = 10) -> Bench:
    """Return the bench of a client with a writer."""
    bench = Bench(limits)
    connect(bench)
    for create in entities()[:3]:
        assert ask(bench, create) == OK
    assert ask(bench, endpoint(5, flags, depth)) == OK
    return bench


def write(bench: Bench, size: int, stream: int = 0, sequence: int = 0) -> bool:
    """Write a sample; return whether ROS 2 got it."""
    before = len(bench.bridge.published)
    bench.say(message(WriteData(1, 0x15, bytes(size)), stream=stream, sequence=sequence), "client 1")
    return len(bench.bridge.published) > before


# Histories


@pytest.mark.parametrize("kind", [5, 6])
@pytest.mark.parametrize("flags", [RELIABLE, TRANSIENT_LOCAL])
def test_a_depth_that_no_budget_has_room_for_is_refused(kind: int, flags: int) -> None:
    bench = Bench()
    connect(bench)
    for create in (*entities()[:3], reader_entities()[2]):
        assert ask(bench, create) == OK
    assert ask(bench, endpoint(kind, flags, 60_000)) == RESOURCES
    assert (
        "a history of 60000 samples takes 30720000 bytes or more, 8388608 are allowed"
        in bench.text.getvalue()
    )
    assert ask(bench, endpoint(kind, flags, 1_000)) == OK


@pytest.mark.parametrize(("client", "whole"), [(50_000, 1 << 20), (1 << 20, 100_000)])
def test_what_a_lasting_writer_keeps_is_bounded(client: int, whole: int) -> None:
    """By the budgets of the object, the client and all clients; what fits goes on."""
    limits = Limits(clients=1, object_history_bytes=60_000, client_history_bytes=client, history_bytes=whole)
    bench = publisher(limits, TRANSIENT_LOCAL, 100)
    most = min(60_000, client)
    written = sum(write(bench, 1_000) for _ in range(120))
    assert written == most // (1_004 + CHANGE_BYTES)
    assert bench.log.counters["history_full"] == 120 - written
    assert shares(bench).history.held <= most
    assert "its history would take more than 60000 bytes" in bench.text.getvalue()
    assert not write(bench, 1_000)
    ask(bench, Delete(1, 0x15))
    assert shares(bench).history.held == 0


def test_a_history_that_is_full_takes_samples_for_ever() -> None:
    bench = publisher(None, TRANSIENT_LOCAL, 10)
    assert all(write(bench, 1_000) for _ in range(100))
    assert shares(bench).history.held == 10 * (1_004 + CHANGE_BYTES)
    assert all(write(bench, 10) for _ in range(100))
    assert shares(bench).history.held == 10 * (1_004 + CHANGE_BYTES)
    assert write(bench, 2_000), "and larger ones, where there is room"
    assert shares(bench).history.held == 10 * (2_004 + CHANGE_BYTES)


def test_a_volatile_writer_whose_readers_keep_up_needs_little() -> None:
    bench = publisher(Limits(object_history_bytes=600_000), RELIABLE, 1_000)
    assert all(write(bench, 60_000) for _ in range(100))
    assert not bench.log.counters


@pytest.mark.parametrize("flags", [RELIABLE, KEEP_ALL_RELIABLE])
def test_a_volatile_writer_whose_readers_do_not_keep_up_waits(flags: int) -> None:
    """Nothing is lost on a reliable stream: it continues when they have taken the samples."""
    bench = publisher(Limits(object_history_bytes=3_000_000), flags, 1_000)
    bench.bridge.settled = False
    taken = sum(write(bench, 60_000, 0x80, number) for number in range(60))
    assert taken == 3_000_000 // (60_004 + CHANGE_BYTES)
    assert bench.log.counters["publish_waits"] == 1
    bench.bridge.settled = True
    bench.wait(0.2, 0.01)
    assert len(bench.bridge.published) > taken


def test_a_best_effort_writer_keeps_one_sample() -> None:
    bench = publisher(Limits(object_history_bytes=100_000), 2, 100)
    bench.bridge.settled = False
    assert all(write(bench, 60_000) for _ in range(100))
    assert shares(bench).history.held == 60_004 + CHANGE_BYTES


def test_histories_of_all_clients_are_shared() -> None:
    """Who takes what it can get leaves the others their shares."""
    limits = Limits(clients=4, object_history_bytes=1 << 20, history_bytes=80_000)
    bench = publisher(limits, TRANSIENT_LOCAL, 1_000)
    taken = sum(write(bench, 1_000) for _ in range(100))
    assert taken == 50_000 // 1_516
    address = connect(bench, 2)
    for create in (*entities(2)[:3], *entities(2)[3:]):
        assert ask(bench, create, address) == OK
    assert bench.say(message(WriteData(1, 0x25, bytes(1_000)), stream=0), address) == []
    assert len(bench.bridge.published) == taken + 1


# Objects


def types(count: int, size: int) -> Iterator[Create]:
    text = f'<types><struct name="T">{" " * size}</struct></types>'
    for number in range(count):
        yield Create(1, number << 4 | ObjectKind.TYPE, ObjectKind.TYPE, Format.XML, text.encode(), 0, 0)


def test_objects_of_all_clients_are_bounded_by_their_bytes() -> None:
    """S2: 512 TYPE objects of 64 kB are 33 MB of one client; eight clients find no room for that."""
    limits = Limits(clients=8, object_bytes=8 << 20)
    bench = Bench(limits)
    created = 0
    for number in range(1, 9):
        address = connect(bench, number)
        for count, create in enumerate(types(64, 60_000)):
            bench.now += 0.1
            status = ask(bench, create, address)
            assert status in (OK, RESOURCES)
            created += status == OK
            if status == RESOURCES:
                assert count > 0, "each has a share"
                break
        else:
            pytest.fail("no bound")
    held = sum(client.shares.objects.held for client in bench.agent.clients)
    assert held <= 8 << 20
    assert created * 60_000 <= held
    for client in bench.agent.clients:
        bench.say(message(Delete(1, 0xFFFE), stream=0), client.address)
    address = connect(bench, 9)
    assert [ask(bench, create, address) for create in types(30, 60_000)] == [OK] * 30


@pytest.mark.parametrize("action", ["delete", "delete all", "leave", "refused"])
def test_memory_of_an_object_is_returned(action: str) -> None:
    bench = publisher()
    objects = shares(bench).objects
    whole = sum(cost_of(create.object, len(create.representation.body)) for create in entities())
    assert objects.held == whole
    client = bench.agent.clients.at("client 1")
    assert client is not None
    if action == "delete":
        ask(bench, Delete(1, 0x15))
        assert objects.held == whole - cost_of(0x15, len(entities()[3].representation.body))
    elif action == "delete all":
        ask(bench, Delete(1, 0x11))
        assert objects.held == 0
    elif action == "leave":
        ask(bench, Delete(1, 0xFFFE))
        assert objects.held == 0
    else:
        strange = topic_blob("rt/x", dds_type("no_such_package/msg/X"))
        assert ask(bench, Create(1, 0x22, 2, Format.BINARY, strange, 0x11, 0)) == OK
        for number in (2, 3):
            blob = writer_blob(0x22, RELIABLE, 10)
            assert ask(bench, Create(1, number << 4 | 5, 5, Format.BINARY, blob, 0x13, 0)) >= 0x80
        ask(bench, Delete(1, 0x22))
        assert objects.held == whole
        assert ask(bench, entities()[3]) in (0, 1)
        assert objects.held == whole


def test_the_side_in_ros_2_counts() -> None:
    assert cost_of(0x16, 0) - cost_of(0x12, 0) == ROS_BYTES[ObjectKind.DATAREADER]


def test_parts_that_went_with_their_container_are_not_remembered_for_ever() -> None:
    bench = Bench(Limits(objects=8))
    connect(bench)
    for number in range(1, 30):
        bench.now += 1
        for create in entities(number)[:3]:
            ask(bench, create)
        ask(bench, Delete(1, number << 4 | 1))
    (client,) = bench.agent.clients
    assert len(client.objects._gone_with_container) <= 8


# Output and requests


def test_output_of_all_clients_is_bounded_and_nothing_of_it_lost() -> None:
    """S2: those that never acknowledge. What they do not get stays in DDS; one that acknowledges gets all of it."""
    limits = Limits(clients=20, output_bytes=400_000)
    bench = Bench(limits)
    places = [reading(bench, number) for number in range(1, 21)]
    body = b"\0\1\0\0" + bytes(20_000)
    for number in range(1, 21):
        bench.bridge.source(f"/t{number} [std_msgs/msg/Int32]").put(*[body] * 30)
    bench.take()
    held = [shares(bench, place).output.held for place in places]
    assert all(size >= 20_000 for size in held), "one submessage may wait in any case"
    assert sum(held) <= 400_000 + 20 * 21_000
    source = bench.bridge.source("/t7 [std_msgs/msg/Int32]")
    left = len(source.waiting)
    assert left > 0
    client = bench.agent.clients.at(places[6])
    assert client is not None
    output = client.session.output(0x80)
    assert isinstance(output, ReliableOut)
    for _ in range(3_000):
        bench.say(message(Acknack(output.probe().last + 1, 0, 0x80), stream=0), places[6])
        if not source.waiting:
            break
    assert not source.waiting
    assert not bench.log.counters
    for place in places:
        bench.say(message(Delete(1, 0xFFFE), stream=0), place)
    address = connect(bench, 30)
    assert shares(bench, address).output._pool.free == 200_000  # type: ignore[union-attr]


def test_unanswered_requests_are_bounded() -> None:
    """Of one client in all its objects together; what is answered makes room."""
    limits = Limits(clients=2, call_bytes=40 * CALL_BYTES)
    bench = Bench(limits)
    connect(bench)
    ask(bench, entities()[0])
    for number in (2, 3):
        blob = service_blob(f"/s{number}", "std_srvs/srv/SetBool")
        assert ask(bench, Create(1, number << 4 | 8, 8, Format.BINARY, blob, 0x11, 0)) == OK
        assert ask(bench, Create(1, number << 4 | 7, 7, Format.BINARY, blob, 0x11, 0)) == OK
    for number in range(100):
        bench.say(
            message(WriteData(number, 0x27, b"\0\0\0\0"), WriteData(number, 0x37, b"\0\0\0\0"), stream=0),
            "client 1",
        )
    (client,) = bench.agent.clients
    open_requests = sum(len(entity.outstanding) for entity in client.objects)
    assert open_requests == 30
    assert client.shares.calls.held == 30 * CALL_BYTES
    assert bench.log.counters["request_forgotten"] == 170
    bench.say(message(Delete(1, 0xFFFE), stream=0), "client 1")
    assert client.shares.calls.held == 0


def test_a_session_that_is_reset_holds_no_output() -> None:
    bench = Bench()
    address = reading(bench, 1)
    bench.bridge.source("/t1 [std_msgs/msg/Int32]").put(*(b"\0\1\0\0" + bytes(5_000) for _ in range(10)))
    bench.take()
    assert shares(bench).output.held >= 5_000
    connect(bench, 1)
    assert shares(bench, address).output.held == 0


@pytest.mark.parametrize("sleep", [False, True])
def test_nothing_is_counted_twice_or_forgotten(sleep: bool) -> None:
    """What a client holds when it leaves, after whatever it did, is nothing."""
    bench = publisher(Limits(client_timeout_s=2))
    do: list[Callable[[], object]] = [
        lambda: write(bench, 3_000),
        lambda: ask(bench, endpoint(5, TRANSIENT_LOCAL, 7)),
        lambda: write(bench, 9_000),
        lambda: [ask(bench, create) for create in reader_entities(2)],
        lambda: bench.say(message(ReadData(7, 0x26, 0x80, delivery=FOREVER), stream=0), "client 1"),
        lambda: bench.bridge.source("/a [std_msgs/msg/Int32]").put(sample(1)),
        lambda: bench.take(),
        lambda: ask(bench, Delete(1, 0x13)),
        lambda: [ask(bench, create) for create in entities()],
    ]
    (client,) = bench.agent.clients
    for step in do:
        step()
        if sleep:
            bench.wait(5)
            assert client.asleep
            bench.say(join(Header(0x81, 0, 0), [encode(Acknack(0, 0, 0x80))]), "client 1")
    ask(bench, Delete(1, 0xFFFE))
    assert client.shares.held == 0
