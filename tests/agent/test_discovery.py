# SPDX-License-Identifier: Apache-2.0
"""Multicast discovery on the loopback interface: bytes as captured from the public client and agent, and more."""

from __future__ import annotations

import ipaddress
import select
import socket
import struct
from collections.abc import Iterator

import pytest

from microros_gen.agent.transport.addresses import OwnAddress, own_addresses, parse_address
from microros_gen.agent.transport.discovery import ANSWERS_PER_SECOND, GROUP, Discovery
from microros_gen.agent.transport.sockets import TCP4, UDP4, UDP6
from microros_gen.agent.transport.tcp import Tcp
from microros_gen.agent.transport.udp import Udp
from microros_gen.diagnostics import UserError
from tests.support.agent.fakes import Bench
from tests.support.agent.served import Served
from tests.support.free_ports import free_port
from tests.support.patience import seconds

QUESTION = bytes.fromhex("80000000020108000009fffd03000000")
"""GET_INFO as the public client sends it to the group."""
ANSWER = "80000000 0601%s00 0009fffd 0000 01 0d 58524345 0100 010f 00 01 0d 00 0100 0000"
"""INFO up to the number of locators; after `0601` its length."""


@pytest.fixture
def asker() -> Iterator[socket.socket]:
    """A client that asks on the loopback interface."""
    client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    client.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
    client.settimeout(seconds(3))
    yield client
    client.close()


def test_the_answer_that_the_public_client_understands(asker: socket.socket) -> None:
    """Byte for byte as the public agent's, with the address and port of this one."""
    bench = Bench()
    udp = Udp(UDP4, "127.0.0.1", 0)
    port = free_port()
    with Served(udp, Discovery([udp], bench.log, port), bench=bench) as served:
        asker.sendto(QUESTION, (GROUP, port))
        reply = asker.recv(1000)
        assert f"discovery {GROUP}:{port}" in served.ready
    head = bytes.fromhex((ANSWER % "24").replace(" ", ""))
    assert reply[: len(head)] == head
    at = len(head) + (-len(head) & 3)
    assert struct.unpack_from("<I", reply, at) == (1,)
    assert reply[at + 4 : at + 9] == b"\x01\x7f\x00\x00\x01"  # MEDIUM, 127.0.0.1
    assert struct.unpack_from("<H", reply, at + 10) == (udp.port,)
    assert not bench.log.counters


def test_locators_of_all_transports(asker: socket.socket) -> None:
    """UDP before TCP, IPv4 before IPv6; LARGE locators have 16 bytes and a port of 32 bits."""
    bench = Bench()
    tcp = Tcp(TCP4, "127.0.0.1", 0, bench.log)
    udp6, udp4 = Udp(UDP6, "::1", 0), Udp(UDP4, "127.0.0.1", 0)
    discovery = Discovery([tcp, udp6, udp4], bench.log, free_port())
    found = discovery.locators(parse_address("127.0.0.1"))
    assert [(x.kind, ipaddress.ip_address(x.address), x.port) for x in found] == [
        (1, ipaddress.ip_address("127.0.0.1"), udp4.port),
        (1, ipaddress.ip_address("127.0.0.1"), tcp.port),
        (2, ipaddress.ip_address("::1"), udp6.port),
    ]
    asker.sendto(QUESTION, (GROUP, discovery._port))
    wait_readable(discovery)
    discovery.pump(lambda *_: None)
    reply = asker.recv(1000)
    assert reply[-4:] == struct.pack("<I", udp6.port)
    assert bytes(15) + b"\x01" in reply
    for each in (discovery, tcp, udp4, udp6):
        each.close()


def wait_readable(discovery: Discovery) -> None:
    assert select.select([discovery.fileno()], [], [], 3)[0]


HOME = (
    OwnAddress(ipaddress.ip_address("127.0.0.1"), 1),
    OwnAddress(ipaddress.ip_address("192.0.2.5"), 1),
    OwnAddress(ipaddress.ip_address("198.51.100.5"), 1),
    OwnAddress(ipaddress.ip_address("::1"), 1),
    OwnAddress(ipaddress.ip_address("2001:db8::5"), 1),
)


@pytest.mark.parametrize(
    ("host", "who", "wanted"),
    [
        ("127.0.0.1", "192.0.2.9", []),
        ("127.0.0.1", "192.0.2.5", ["127.0.0.1"]),
        ("0.0.0.0", "203.0.113.9", ["192.0.2.5", "198.51.100.5"]),
        ("0.0.0.0", "192.0.2.5", ["192.0.2.5", "198.51.100.5", "127.0.0.1"]),
        ("::", "203.0.113.9", ["2001:db8::5"]),
    ],
)
def test_reports_by_audience(host: str, who: str, wanted: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Another machine has no use for the loopback address, and a loopback agent says nothing to it."""
    monkeypatch.setattr("microros_gen.agent.transport.discovery._facing", lambda _asker: None)
    bench = Bench()
    transport = Udp(UDP6 if ":" in host else UDP4, host, 0)
    discovery = Discovery([transport], bench.log, free_port(), lambda: HOME)
    found = discovery.locators(parse_address(who))
    assert [str(ipaddress.ip_address(x.address)) for x in found] == wanted
    discovery.close()
    transport.close()


def test_the_interface_of_the_requester_is_listed_first() -> None:
    bench = Bench()
    transport = Udp(UDP4, "0.0.0.0", 0)
    discovery = Discovery([transport], bench.log, free_port())
    for own in own_addresses():
        if own.address.version == 4:
            assert discovery.locators(own.address)[0].address == own.address.packed
    discovery.close()
    transport.close()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x80",
        bytes.fromhex("8000000000011000585243450100010fa1b2c3d48100fc01"),  # CREATE_CLIENT
        bytes.fromhex("81000000020108000009fffd03000000"),  # in a session
        bytes.fromhex("80000000020108000009fffd03"),  # cut off
        bytes.fromhex("80000000ff0108000009fffd03000000"),
    ],
)
def test_everything_else_is_counted_and_not_answered(data: bytes, asker: socket.socket) -> None:
    bench = Bench()
    udp = Udp(UDP4, "127.0.0.1", 0)
    discovery = Discovery([udp], bench.log, free_port())
    asker.sendto(data, (GROUP, discovery._port))
    wait_readable(discovery)
    discovery.pump(lambda *_: pytest.fail("a message was handed on"))
    assert bench.log.counters == {"discovery_input": 1}
    asker.settimeout(0.05)
    with pytest.raises(TimeoutError):
        asker.recv(100)
    discovery.close()
    udp.close()


def networked() -> str:
    """Return an address of this machine by which it is in a network."""
    for own in own_addresses():
        if own.address.version == 4 and not own.address.is_loopback:
            return str(own.address)
    pytest.skip("this machine has no network")


def test_on_loopback_a_client_that_asks_through_the_network_is_answered(asker: socket.socket) -> None:
    """As the public client does: its question leaves by the default route, not by the loopback interface."""
    bench = Bench()
    udp = Udp(UDP4, "127.0.0.1", 0)
    port = free_port()
    asker.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(networked()))
    with Served(udp, Discovery([udp], bench.log, port), bench=bench):
        asker.sendto(QUESTION, (GROUP, port))
        reply, _ = asker.recvfrom(1000)
    assert reply[-8:-2] == b"\x01\x7f\0\0\x01\0"
    assert struct.unpack("<H", reply[-2:]) == (udp.port,)


def test_on_loopback_other_machines_are_not_heard(asker: socket.socket) -> None:
    """Nor can they use up the answers of those that are on this machine. Here `asker` is another one."""
    bench = Bench()
    udp = Udp(UDP4, "127.0.0.1", 0)
    network = networked()
    interfaces = {str(own.address): own.interface for own in own_addresses()}
    elsewhere = [OwnAddress(ipaddress.ip_address("192.0.2.5"), interfaces[network])]
    discovery = Discovery([udp], bench.log, free_port(), lambda: elsewhere)
    asker.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(network))
    for data in (*[QUESTION] * (ANSWERS_PER_SECOND + 1), b"\x80"):
        asker.sendto(data, (GROUP, discovery._port))
        wait_readable(discovery)
        discovery.pump(lambda *_: None)
    assert not bench.log.counters
    asker.settimeout(0.05)
    with pytest.raises(TimeoutError):
        asker.recv(100)
    discovery.close()
    udp.close()


def test_answers_are_bounded(asker: socket.socket) -> None:
    bench = Bench()
    udp = Udp(UDP4, "127.0.0.1", 0)
    discovery = Discovery([udp], bench.log, free_port())
    discovery.tick(100.0)
    for _ in range(ANSWERS_PER_SECOND + 50):
        asker.sendto(QUESTION, (GROUP, discovery._port))
        discovery.pump(lambda *_: None)
    discovery.pump(lambda *_: None)
    assert bench.log.counters == {"discovery_flood": 50}
    discovery.tick(101.0)
    asker.sendto(QUESTION, (GROUP, discovery._port))
    wait_readable(discovery)
    discovery.pump(lambda *_: None)
    assert bench.log.counters == {"discovery_flood": 50}
    discovery.close()
    udp.close()


def test_two_agents_on_one_machine(asker: socket.socket) -> None:
    """Both answer: the client chooses."""
    bench = Bench()
    port = free_port()
    transports = [Udp(UDP4, "127.0.0.1", 0) for _ in range(2)]
    both = [Discovery([transport], bench.log, port) for transport in transports]
    asker.sendto(QUESTION, (GROUP, port))
    for discovery in both:
        wait_readable(discovery)
        discovery.pump(lambda *_: None)
    answered = {struct.unpack("<H", asker.recv(1000)[-2:])[0] for _ in both}
    assert answered == {transport.port for transport in transports}
    for discovery in both:
        discovery.close()
    for transport in transports:
        transport.close()


def test_serial_lines_cannot_be_discovered() -> None:
    with pytest.raises(UserError, match="needs a UDP or TCP transport"):
        Discovery([], Bench().log)
