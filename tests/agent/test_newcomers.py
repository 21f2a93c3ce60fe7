# SPDX-License-Identifier: Apache-2.0
"""Sessions that are opened from forged addresses: they replace no client, and leave almost no memory behind."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import INFO_CONFIG, Format
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import GetInfo
from microros_gen.agent.wire.submessages import encode
from tests.support.agent.captured import PING
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.newcomers import hello

OK, RESOURCES = "00", "87"


def over_udp(limits: Limits | None = None) -> Bench:
    bench = Bench(limits)
    bench.transport.forgeable = True
    return bench


def connect(bench: Bench, key: int, address: str) -> str:
    """Open a session; return the status that the agent told."""
    (answer,) = bench.say(hello(key), address)
    return answer.split()[8]


def create(bench: Bench, address: str) -> list[str]:
    """Create a node."""
    return bench.say(message(entities()[0], stream=0), address)


def test_a_client_is_one_after_its_first_word() -> None:
    bench = over_udp()
    assert connect(bench, 1, "a") == OK
    assert len(bench.agent.clients) == 0
    assert bench.say(PING, "a")[0].split()[14] == "01", "told that its session is there"
    assert len(bench.agent.clients) == 0
    assert create(bench, "a")
    assert len(bench.agent.clients) == 1
    assert len(bench.bridge.graph) == 1


def test_the_first_message_has_the_address_of_the_session() -> None:
    bench = over_udp()
    bench.say(hello(1, 0x01), "a")
    first = join(Header(1, 0, 0, (1).to_bytes(4, "big")), [encode(entities()[0])])
    assert bench.say(first, "b") == []
    assert not bench.bridge.graph
    assert bench.say(join(Header(2, 0, 0, (1).to_bytes(4, "big")), [encode(entities()[0])]), "a") == []
    assert bench.say(first, "a")
    assert len(bench.agent.clients) == 1


def test_a_flood_of_forged_sessions_locks_no_client_out() -> None:
    """With long time-outs, more than there are places: a new client is served at once, those in session stay."""
    limits = Limits(clients=8, newcomers=64, strangers_per_second=1_000_000)
    bench = over_udp(limits)
    connect(bench, 0x77, "honest")
    create(bench, "honest")
    for key in range(0x1000, 0x1000 + 2_000):
        bench.say(hello(key, timeout_ms=10_000_000), f"forged {key}")
    assert len(bench.agent.clients) == 1
    assert len(bench.agent._admission.newcomers) == 64
    assert connect(bench, 0x78, "new") == OK
    assert create(bench, "new")
    assert len(bench.agent.clients) == 2
    assert create(bench, "honest")


def test_what_a_forged_session_leaves_is_small() -> None:
    bench = over_udp(Limits(newcomers=1_000, strangers_per_second=1_000_000))
    for key in range(1, 1_001):
        bench.say(hello(key), f"forged {key}")
    newcomers = bench.agent._admission.newcomers._by_address
    each = next(iter(newcomers.values()))
    assert len(newcomers) == 1_000
    assert sys.getsizeof(newcomers) / 1_000 + sys.getsizeof(each.__dict__) + sys.getsizeof(each.link) < 1_000


def test_one_datagram_does_not_take_a_session_over() -> None:
    """A CREATE_CLIENT with the key of somebody else, from elsewhere, changes nothing until more comes from there."""
    bench = over_udp()
    connect(bench, 1, "a")
    create(bench, "a")
    (client,) = bench.agent.clients
    for session in (0x81, 0x82):
        bench.say(hello(1, session), "b")
        assert bench.agent.clients.at("a") is client
        assert create(bench, "a")
    assert bench.agent.clients.at("b") is None
    bench.say(message(entities()[0], stream=0).replace(b"\x81", b"\x82", 1), "b")
    assert bench.agent.clients.at("a") is None
    assert bench.agent.clients.at("b") is not None


def test_a_restart_from_another_port_is_the_same_client() -> None:
    bench = over_udp()
    connect(bench, 1, "a")
    create(bench, "a")
    assert connect(bench, 1, "b") == OK
    assert create(bench, "b")
    assert len(bench.agent.clients) == 1
    assert len(bench.bridge.graph) == 1


def test_a_restart_from_another_port_begins_again_where_the_session_has_a_key() -> None:
    """The key and session id are those of the session before; the streams are new, and so is the next restart."""
    bench = over_udp()
    head = Header(0x01, 0x80, 0, (1).to_bytes(4, "big"))
    for address, count in (("a", 4), ("b", 2), ("a", 1)):
        bench.say(hello(1, 0x01), address)
        for number, item in enumerate(entities()[:count]):
            bench.say(join(replace(head, sequence=number), [encode(item)]), address)
        (client,) = bench.agent.clients
        assert client.address == address
        assert client.session.acknack(0x80)[12:14] == count.to_bytes(2, "little")


@pytest.mark.parametrize("silent", ["empty", "asleep", "silent"])
def test_who_is_silent_gives_its_place(silent: str) -> None:
    bench = over_udp(Limits(clients=2, client_timeout_s=10))
    for key, address in ((1, "a"), (2, "b")):
        connect(bench, key, address)
        bench.say(PING.replace("80", "81", 1), address)
        if silent != "empty":
            create(bench, address)
    assert connect(bench, 3, "c") == RESOURCES, "both have just sent something"
    bench.wait({"empty": 1.2, "silent": 8, "asleep": 12}[silent])
    create(bench, "b")
    assert connect(bench, 3, "c") == OK
    assert create(bench, "c")
    assert [client.address for client in bench.agent.clients] == ["b", "c"]


def test_those_that_are_heard_keep_their_places() -> None:
    bench = over_udp(Limits(clients=2, client_timeout_s=10))
    for key, address in ((1, "a"), (2, "b")):
        connect(bench, key, address)
        create(bench, address)
    for _ in range(10):
        bench.wait(3)
        for address in ("a", "b"):
            create(bench, address)
        assert connect(bench, 3, "c") == RESOURCES
        assert create(bench, "c") == []


@pytest.mark.parametrize("forgeable", [True, False])
def test_an_unverified_address_gets_no_more_bytes_than_it_sent(forgeable: bool) -> None:
    """S9: 200 times the 60 kB of a TYPE, asked in one datagram from a forged address, was 4,997 times what came."""
    bench = over_udp()
    bench.transport.forgeable = forgeable
    sent = 0

    def say(data: bytes) -> int:
        nonlocal sent
        sent += len(data)
        return sum(len(bytes.fromhex(answer)) for answer in bench.say(data, "a"))

    text = f'<types><struct name="T">{" " * 60_000}</struct></types>'.encode()
    answered = say(hello(1, mtu=65_000))
    answered += say(message(Create(1, 0x1A, 0x0A, Format.XML, text, 0, 0), stream=0))
    answered += say(message(*(GetInfo(number, 0x1A, INFO_CONFIG) for number in range(200)), stream=0))
    assert (answered > 2.2 * sent) is not forgeable
    assert answered > 60_000, "it is reported more than once"
    assert bool(bench.log.counters["info_withheld"]) is forgeable
